/* Hostile input to spaces, and to what they compute of configurations. */
#include <math.h>

#include "check.h"
#include "fixture.h"

enum { FREE_NQ = 7, FREE_NV = 6 };

/* The space of one link that moves freely: its configuration holds a quaternion, and its lengths
 * have no bounds. */
static cstk_space *make_free_space(void) {
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *made = NULL;
    cstk_space *space = NULL;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = CSTK_JOINT_FREE;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &made));
    const cstk_robot *robot = made;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, NULL, &space));
    CHECK_OK(cstk_robot_release(made));
    CHECK_OK(cstk_robot_builder_release(builder));
    return space;
}

static void create_ranges(const fixture *f) {
    cstk_space *out;
    const cstk_robot *robot = f->robot;
    const cstk_range circle = {CSTK_RANGE_CIRCLE, 0, 0, 0};
    const struct {
        cstk_range range;
        cstk_status status;
    } wrong[] = {
        {{-1, 0, 0, 1}, CSTK_INVALID_ARGUMENT},
        {{CSTK_RANGE_QUATERNION + 1, 0, 0, 1}, CSTK_INVALID_ARGUMENT},
        {{INT32_MIN, 0, 0, 1}, CSTK_INVALID_ARGUMENT},
        {{INT32_MAX, 0, 0, 1}, CSTK_INVALID_ARGUMENT},
        {{CSTK_RANGE_QUATERNION, 0, 0, 1}, CSTK_INVALID_ARGUMENT},
        {{CSTK_RANGE_INTERVAL, 0, NAN, 1}, CSTK_NOT_FINITE},
        {{CSTK_RANGE_INTERVAL, 0, 0, NAN}, CSTK_NOT_FINITE},
        {{CSTK_RANGE_INTERVAL, 0, 1, 0}, CSTK_INVALID_ARGUMENT},
        {{CSTK_RANGE_INTERVAL, 0, INFINITY, INFINITY}, CSTK_INVALID_ARGUMENT},
        {{CSTK_RANGE_INTERVAL, 0, -INFINITY, -INFINITY}, CSTK_INVALID_ARGUMENT},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        const cstk_range ranges[FIXTURE_NQ] = {circle, wrong[i].range, circle};
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, ranges, FIXTURE_NQ, NULL, &out),
                      wrong[i].status, "range");
        CHECK(strstr(cstk_last_error_message(), "1") != NULL);
    }
    const cstk_range ranges[FIXTURE_NQ + 1] = {circle, circle, circle, circle};
    CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, FIXTURE_NQ, NULL, &out),
                  CSTK_NULL_ARGUMENT, "ranges");
    const size_t counts[] = {1, FIXTURE_NQ - 1, FIXTURE_NQ + 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, ranges, counts[i], NULL, &out),
                      CSTK_WRONG_SIZE, "ranges");
    }
    fixture_unchanged(f);
}

/* Ranges that the joint of the coordinate does not allow. */
static void create_ranges_of_joints(const fixture *f) {
    cstk_space *out;
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *made = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = CSTK_JOINT_PRISMATIC;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.joint = CSTK_JOINT_REVOLUTE;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    /* Half a turn of this one, where the last makes a whole one. */
    def.coordinate = 1;
    def.multiplier = 0.5;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.coordinate = -1;
    def.joint = CSTK_JOINT_SPHERICAL;
    /* A turn by three angles has no multiple. */
    CHECK_FAILS(cstk_robot_builder_add_link(builder, &def, NULL), CSTK_INVALID_ARGUMENT,
                "multiplier");
    def.multiplier = 1.0;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &made));
    const cstk_robot *robot = made;
    const cstk_range interval = {CSTK_RANGE_INTERVAL, 0, -1, 1};
    const cstk_range circle = {CSTK_RANGE_CIRCLE, 0, 0, 0};
    const struct {
        int coordinate;
        cstk_range range;
        const char *culprit;
    } wrong[] = {
        {0, circle, "range 0"},   {1, circle, "range 1"}, {2, circle, "range 2"},
        {2, interval, "range 2"}, {5, circle, "range 5"}, {5, interval, "range 5"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_range ranges[6];
        for (int k = 0; k < 6; ++k) {
            ranges[k] = (cstk_range){CSTK_RANGE_DEFAULT, 0, 0, 0};
        }
        ranges[wrong[i].coordinate] = wrong[i].range;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, ranges, 6, NULL, &out),
                      CSTK_INVALID_ARGUMENT, wrong[i].culprit);
    }
    CHECK_OK(cstk_robot_release(made));
    CHECK_OK(cstk_robot_builder_release(builder));
    fixture_unchanged(f);
}

static void create(const fixture *f) {
    cstk_space *out;
    const cstk_robot *robot = f->robot;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        const cstk_robot *robots[2] = {robot, bad->handle};
        CHECK_REFUSED(out, cstk_space_create(robots, 2, NULL, 0, NULL, &out), bad->status,
                      "robots[1]");
    }
    CHECK_REFUSED(out, cstk_space_create(NULL, 1, NULL, 0, NULL, &out), CSTK_NULL_ARGUMENT,
                  "robots");
    CHECK_FAILS(cstk_space_create(&robot, 1, NULL, 0, NULL, NULL), CSTK_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_space_create(&robot, 0, NULL, 0, NULL, &out), CSTK_EMPTY, "robot");
    CHECK_REFUSED(out, cstk_space_create(NULL, 0, NULL, 0, NULL, &out), CSTK_EMPTY, "robot");
    CHECK_REFUSED(out, cstk_space_create(&robot, SIZE_MAX, NULL, 0, NULL, &out), CSTK_WRONG_SIZE,
                  "robots");
    for (int entry = 0; entry < 6; ++entry) {
        double box[6] = {-1, -1, -1, 1, 1, 1};
        box[entry] = NAN;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, 0, box, &out), CSTK_NOT_FINITE,
                      "box");
        box[entry] = entry < 3 ? 2.0 : -2.0;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, 0, box, &out), CSTK_INVALID_ARGUMENT,
                      "box");
        /* An end at infinity is none, but on the wrong side it shuts everything out. */
        box[entry] = entry < 3 ? INFINITY : -INFINITY;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, 0, box, &out), CSTK_INVALID_ARGUMENT,
                      "box");
    }
    fixture_unchanged(f);
}

/* A robot of the plane does not fit a spatial one. */
static void two_dimensions(const fixture *f) {
    cstk_space *out;
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *planar = NULL;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    CHECK_OK(cstk_robot_builder_create(2, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &planar));
    const cstk_robot *robots[2] = {f->robot, planar};
    CHECK_REFUSED(out, cstk_space_create(robots, 2, NULL, 0, NULL, &out), CSTK_INVALID_ARGUMENT,
                  "robots");
    CHECK_OK(cstk_robot_release(planar));
    CHECK_OK(cstk_robot_builder_release(builder));
}

static void references(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_FAILS(cstk_space_retain(bad->handle), bad->status, "space");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_space_release(bad->handle), bad->status, "space");
        }
    }
    fixture_unchanged(f);
}

static void sizes(const fixture *f) {
    size_t out[3];
    cstk_space_offset offset;
    cstk_range range;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_space_size(bad->handle, &out[0], &out[1], &out[2]), bad->status,
                      "space");
        CHECK_REFUSED(offset, cstk_space_get_offset(bad->handle, 0, &offset), bad->status, "space");
        CHECK_REFUSED(range, cstk_space_get_range(bad->handle, 0, &range), bad->status, "space");
    }
    CHECK_OK(cstk_space_size(f->space, NULL, NULL, NULL));
    CHECK_FAILS(cstk_space_get_offset(f->space, 0, NULL), CSTK_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_space_get_range(f->space, 0, NULL), CSTK_NULL_ARGUMENT, "out");
    const size_t robots[] = {1, (size_t)UINT32_MAX + 1, SIZE_MAX};
    const size_t coordinates[] = {FIXTURE_NQ, (size_t)UINT32_MAX + 1, SIZE_MAX};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(offset, cstk_space_get_offset(f->space, robots[i], &offset), CSTK_NOT_FOUND,
                      "robot");
        CHECK_REFUSED(range, cstk_space_get_range(f->space, coordinates[i], &range), CSTK_NOT_FOUND,
                      "coordinate");
    }
    fixture_unchanged(f);
}

/* A function of one configuration, or of two of which one is hostile. */
typedef struct question {
    const cstk_space *space;
    const double *q;
    size_t nq;
    /* The other configuration, and a velocity. */
    const double *other;
    const double *v;
    size_t nv;
} question;

/* Room for the output of any function. */
typedef struct answer {
    double numbers[12 * FIXTURE_LINKS];
    bool holds;
    uint32_t first;
} answer;

typedef cstk_status (*ask_fn)(const question *, answer *);

static cstk_status contains(const question *a, answer *out) {
    return cstk_space_contains(a->space, a->q, a->nq, out ? &out->holds : NULL);
}

static cstk_status within_limits(const question *a, answer *out) {
    return cstk_space_within_limits(a->space, a->q, a->nq, out ? &out->holds : NULL,
                                    out ? &out->first : NULL);
}

static cstk_status within_world(const question *a, answer *out) {
    return cstk_space_within_world(a->space, a->q, a->nq, out ? &out->holds : NULL,
                                   out ? &out->first : NULL);
}

static cstk_status link_poses(const question *a, answer *out) {
    return cstk_space_link_poses(a->space, a->q, a->nq, out ? out->numbers : NULL);
}

static cstk_status jacobian(const question *a, answer *out) {
    const double point[3] = {0.1, 0.2, 0.3};
    return cstk_space_jacobian(a->space, a->q, a->nq, 0, point, out ? out->numbers : NULL);
}

static cstk_status step(const question *a, answer *out) {
    return cstk_space_step(a->space, a->q, a->nq, a->v, a->nv, out ? out->numbers : NULL);
}

static cstk_status difference_from(const question *a, answer *out) {
    return cstk_space_difference(a->space, a->q, a->other, a->nq, out ? out->numbers : NULL);
}

static cstk_status difference_to(const question *a, answer *out) {
    return cstk_space_difference(a->space, a->other, a->q, a->nq, out ? out->numbers : NULL);
}

static cstk_status interpolate_from(const question *a, answer *out) {
    return cstk_space_interpolate(a->space, a->q, a->other, a->nq, 0.5, out ? out->numbers : NULL);
}

static cstk_status interpolate_to(const question *a, answer *out) {
    return cstk_space_interpolate(a->space, a->other, a->q, a->nq, 0.5, out ? out->numbers : NULL);
}

static cstk_status distance_from(const question *a, answer *out) {
    return cstk_space_distance(a->space, a->q, a->other, a->nq, NULL, out ? out->numbers : NULL);
}

static cstk_status distance_to(const question *a, answer *out) {
    return cstk_space_distance(a->space, a->other, a->q, a->nq, NULL, out ? out->numbers : NULL);
}

static cstk_status clamp(const question *a, answer *out) {
    return cstk_space_clamp(a->space, a->q, a->nq, out ? out->numbers : NULL);
}

static cstk_status wrap(const question *a, answer *out) {
    return cstk_space_wrap(a->space, a->q, a->nq, out ? out->numbers : NULL);
}

typedef struct form {
    const char *name;
    ask_fn ask;
    /* What messages call a configuration that is NULL, one that holds bad numbers, and the output.
     */
    const char *null;
    const char *bad;
    const char *output;
} form;

static const form forms[] = {
    {"contains", contains, "q is NULL", "configuration entr", "out"},
    {"within_limits", within_limits, "q is NULL", "configuration entr", "out"},
    {"within_world", within_world, "q is NULL", "configuration entr", "out"},
    {"link_poses", link_poses, "q is NULL", "configuration entr", "poses"},
    {"jacobian", jacobian, "q is NULL", "configuration entr", "jacobian"},
    {"step", step, "q is NULL", "configuration entr", "out"},
    {"difference", difference_from, "q0 is NULL", "q0: configuration entr", "v"},
    {"difference", difference_to, "q1 is NULL", "q1: configuration entr", "v"},
    {"interpolate", interpolate_from, "q0 is NULL", "q0: configuration entr", "out"},
    {"interpolate", interpolate_to, "q1 is NULL", "q1: configuration entr", "out"},
    {"distance", distance_from, "q0 is NULL", "q0: configuration entr", "out"},
    {"distance", distance_to, "q1 is NULL", "q1: configuration entr", "out"},
    {"clamp", clamp, "q is NULL", "configuration entr", "out"},
    {"wrap", wrap, "q is NULL", "configuration entr", "out"},
};

static void refuse(const form *of, const question *a, cstk_status status, const char *culprit) {
    answer out;
    const int before = check_failures;
    CHECK_REFUSED(out, of->ask(a, &out), status, culprit);
    if (check_failures > before) {
        fprintf(stderr, "  (cstk_space_%s)\n", of->name);
    }
}

static const double still[FREE_NV] = {0};

static void configurations(const fixture *f, const form *of) {
    const question good = {f->space, f->q, FIXTURE_NQ, f->q, still, FIXTURE_NQ};
    question a = good;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        a.space = bad->handle;
        refuse(of, &a, bad->status, "space");
    }
    CHECK_FAILS(of->ask(&good, NULL), CSTK_NULL_ARGUMENT, of->output);
    a = good;
    a.q = NULL;
    refuse(of, &a, CSTK_NULL_ARGUMENT, of->null);
    a = good;
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX, SIZE_MAX / 8 + 2};
    for (int i = 0; i < 5; ++i) {
        a.nq = counts[i];
        refuse(of, &a, CSTK_WRONG_SIZE, "");
    }
    a = good;
    double q[FIXTURE_NQ];
    a.q = q;
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            memcpy(q, f->q, sizeof q);
            q[entry] = not_finite[i];
            refuse(of, &a, CSTK_NOT_FINITE, of->bad);
        }
        q[entry] = entry == 1 ? -1e51 : 1e300;
        refuse(of, &a, CSTK_INVALID_ARGUMENT, of->bad);
    }
    fixture_unchanged(f);
}

static void quaternions(const fixture *f, const form *of) {
    const double neutral[FREE_NQ] = {0, 0, 0, 0, 0, 0, 1};
    const double wrong[][FREE_NQ] = {
        {0, 0, 0, 0, 0, 0, 0},
        {0, 0, 0, 0, 0, 0, 1.00001},
        {0, 0, 0, 0, 0, 0, 0.99999},
        {0, 0, 0, 0.5, 0.5, 0.5, 0.6},
        /* The square of the norm is 0, and infinite. */
        {0, 0, 0, 1e-200, 0, 0, 0},
        {1, 2, 3, 0, 0, 0, 1e50},
    };
    cstk_space *space = make_free_space();
    question a = {space, NULL, FREE_NQ, neutral, still, FREE_NV};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        a.q = wrong[i];
        refuse(of, &a, CSTK_NOT_A_ROTATION, of->bad);
        CHECK(strstr(cstk_last_error_message(), "3 to 6") != NULL);
    }
    CHECK_OK(cstk_space_release(space));
    fixture_unchanged(f);
}

static void step_velocities(const fixture *f) {
    double out[FIXTURE_NQ];
    const cstk_space *s = f->space;
    const double *q = f->q;
    const size_t n = FIXTURE_NQ;
    CHECK_REFUSED(out, cstk_space_step(s, q, n, NULL, n, out), CSTK_NULL_ARGUMENT, "v is NULL");
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_space_step(s, q, n, still, counts[i], out), CSTK_WRONG_SIZE, "v");
    }
    CHECK_REFUSED(out, cstk_space_step(s, q, n, still, n + 1, out), CSTK_WRONG_SIZE, "velocity");
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        double v[FIXTURE_NQ] = {0};
        EACH_NOT_FINITE(i) {
            v[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_space_step(s, q, n, v, n, out), CSTK_NOT_FINITE,
                          "velocity entry");
        }
        v[entry] = entry == 1 ? -1e51 : 1e300;
        CHECK_REFUSED(out, cstk_space_step(s, q, n, v, n, out), CSTK_INVALID_ARGUMENT,
                      "velocity entry");
    }
    fixture_unchanged(f);
}

/* Parameters so large that the way to them overflows. */
static void interpolate_parameters(const fixture *f) {
    double out[FREE_NQ];
    const double neutral[FREE_NQ] = {0, 0, 0, 0, 0, 0, 1};
    const double there[FREE_NQ] = {1e50, 2, 3, 0.6, 0, 0, 0.8};
    const double far[] = {1e55, -1e200, 1e300, -1.7e308};
    cstk_space *space = make_free_space();
    EACH_NOT_FINITE(i) {
        CHECK_REFUSED(out,
                      cstk_space_interpolate(space, neutral, there, FREE_NQ, not_finite[i], out),
                      CSTK_NOT_FINITE, "t 0");
    }
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_space_interpolate(space, neutral, there, FREE_NQ, far[i], out),
                      CSTK_INVALID_ARGUMENT, "t");
    }
    CHECK_OK(cstk_space_release(space));
    fixture_unchanged(f);
}

static void distance_weights(const fixture *f) {
    double out;
    const double far[FIXTURE_NQ] = {3, 2, 1};
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        double weights[FIXTURE_NQ] = {1, 1, 1};
        EACH_NOT_FINITE(i) {
            weights[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_space_distance(f->space, f->q, far, FIXTURE_NQ, weights, &out),
                          CSTK_NOT_FINITE, "weight");
        }
        weights[entry] = -1e-300;
        CHECK_REFUSED(out, cstk_space_distance(f->space, f->q, far, FIXTURE_NQ, weights, &out),
                      CSTK_INVALID_ARGUMENT, "weight");
        weights[entry] = 1.7e308;
        CHECK_REFUSED(out, cstk_space_distance(f->space, f->q, far, FIXTURE_NQ, weights, &out),
                      CSTK_INVALID_ARGUMENT, "weight");
    }
    fixture_unchanged(f);
}

static void jacobian_points(const fixture *f) {
    double out[6 * FIXTURE_NQ];
    const cstk_space *s = f->space;
    const double good[3] = {0.1, 0.2, 0.3};
    CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, 1, NULL, out), CSTK_NULL_ARGUMENT,
                  "point");
    const uint32_t links[] = {FIXTURE_LINKS, CSTK_NONE};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, links[i], good, out),
                      CSTK_NOT_FOUND, "link");
    }
    for (int entry = 0; entry < 3; ++entry) {
        double point[3] = {0.1, 0.2, 0.3};
        EACH_NOT_FINITE(i) {
            point[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, 1, point, out),
                          CSTK_NOT_FINITE, "point");
        }
        point[entry] = 1.7e308;
        CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, 1, point, out),
                      CSTK_INVALID_ARGUMENT, "point");
    }
    fixture_unchanged(f);
}

static void neutral(const fixture *f) {
    double out[FIXTURE_NQ];
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_space_neutral(bad->handle, out), bad->status, "space");
    }
    CHECK_FAILS(cstk_space_neutral(f->space, NULL), CSTK_NULL_ARGUMENT, "q");
    fixture_unchanged(f);
}

static void sample(const fixture *f) {
    double out[FREE_NQ];
    uint64_t state = 7;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_space_sample(bad->handle, &state, out), bad->status, "space");
    }
    CHECK_REFUSED(out, cstk_space_sample(f->space, NULL, out), CSTK_NULL_ARGUMENT, "state");
    CHECK_FAILS(cstk_space_sample(f->space, &state, NULL), CSTK_NULL_ARGUMENT, "q");
    cstk_space *space = make_free_space();
    CHECK_REFUSED(out, cstk_space_sample(space, &state, out), CSTK_UNSUPPORTED, "coordinate 0");
    CHECK_OK(cstk_space_release(space));
    /* A call that fails does not advance the stream. */
    CHECK(state == 7);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    create_ranges(&f);
    create_ranges_of_joints(&f);
    create(&f);
    two_dimensions(&f);
    references(&f);
    sizes(&f);
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        configurations(&f, &forms[i]);
        quaternions(&f, &forms[i]);
    }
    step_velocities(&f);
    interpolate_parameters(&f);
    distance_weights(&f);
    jacobian_points(&f);
    neutral(&f);
    sample(&f);
    fixture_release(&f);
    return check_result();
}
