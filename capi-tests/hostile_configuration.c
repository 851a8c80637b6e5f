/* Hostile input to what spaces compute of configurations. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

/* The space of one link that moves freely: its configuration holds a quaternion, and its lengths
 * have no bounds. */
static cstk_space *make_free_space(void) {
    const cstk_link_def def = link_of(CSTK_JOINT_FREE);
    cstk_robot *robot = make_robot(&def);
    cstk_space *space = space_of(robot, NULL, 0);
    CHECK_OK(cstk_robot_release(robot));
    return space;
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

static cstk_status distances_from(const question *a, answer *out) {
    return cstk_space_distances(a->space, a->q, a->other, 1, a->nq, NULL, out ? out->numbers : NULL);
}

static cstk_status distances_to(const question *a, answer *out) {
    return cstk_space_distances(a->space, a->other, a->q, 1, a->nq, NULL, out ? out->numbers : NULL);
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
    {"distances", distances_from, "q is NULL", "configuration entr", "distances"},
    {"distances", distances_to, "others is NULL", "others[0]: configuration entr", "distances"},
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
    CHECK_FAILS(of->ask(&good, NULL), CSTK_ERROR_NULL_ARGUMENT, of->output);
    a = good;
    a.q = NULL;
    refuse(of, &a, CSTK_ERROR_NULL_ARGUMENT, of->null);
    a = good;
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX, SIZE_MAX / 8 + 2};
    for (int i = 0; i < 5; ++i) {
        a.nq = counts[i];
        refuse(of, &a, CSTK_ERROR_WRONG_SIZE, "");
    }
    a = good;
    double q[FIXTURE_NQ];
    a.q = q;
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            memcpy(q, f->q, sizeof q);
            q[entry] = not_finite[i];
            refuse(of, &a, CSTK_ERROR_NOT_FINITE, of->bad);
        }
        q[entry] = entry == 1 ? -1e51 : 1e300;
        refuse(of, &a, CSTK_ERROR_INVALID_ARGUMENT, of->bad);
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
        refuse(of, &a, CSTK_ERROR_NOT_A_ROTATION, of->bad);
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
    CHECK_REFUSED(out, cstk_space_step(s, q, n, NULL, n, out), CSTK_ERROR_NULL_ARGUMENT, "v is NULL");
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_space_step(s, q, n, still, counts[i], out), CSTK_ERROR_WRONG_SIZE, "v");
    }
    CHECK_REFUSED(out, cstk_space_step(s, q, n, still, n + 1, out), CSTK_ERROR_WRONG_SIZE, "velocity");
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        double v[FIXTURE_NQ] = {0};
        EACH_NOT_FINITE(i) {
            v[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_space_step(s, q, n, v, n, out), CSTK_ERROR_NOT_FINITE,
                          "velocity entry");
        }
        v[entry] = entry == 1 ? -1e51 : 1e300;
        CHECK_REFUSED(out, cstk_space_step(s, q, n, v, n, out), CSTK_ERROR_INVALID_ARGUMENT,
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
                      CSTK_ERROR_NOT_FINITE, "t 0");
    }
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_space_interpolate(space, neutral, there, FREE_NQ, far[i], out),
                      CSTK_ERROR_INVALID_ARGUMENT, "t");
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
                          CSTK_ERROR_NOT_FINITE, "weight");
        }
        weights[entry] = -1e-300;
        CHECK_REFUSED(out, cstk_space_distance(f->space, f->q, far, FIXTURE_NQ, weights, &out),
                      CSTK_ERROR_INVALID_ARGUMENT, "weight");
        weights[entry] = 1.7e308;
        CHECK_REFUSED(out, cstk_space_distance(f->space, f->q, far, FIXTURE_NQ, weights, &out),
                      CSTK_ERROR_INVALID_ARGUMENT, "weight");
    }
    fixture_unchanged(f);
}

static void distances_of_many(const fixture *f) {
    double out[2];
    const double nan = strtod("nan", NULL);
    double others[2 * FIXTURE_NQ] = {0};
    others[FIXTURE_NQ] = nan;
    CHECK_REFUSED(out, cstk_space_distances(f->space, f->q, others, 2, FIXTURE_NQ, NULL, out),
                  CSTK_ERROR_NOT_FINITE, "others[1]: configuration entry 0");
    const size_t counts[] = {SIZE_MAX, SIZE_MAX / 8, SIZE_MAX / FIXTURE_NQ + 2};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out, cstk_space_distances(f->space, f->q, others, counts[i], FIXTURE_NQ, NULL, out),
                      CSTK_ERROR_WRONG_SIZE, "others cannot have");
    }
    const double weights[FIXTURE_NQ] = {1, -1, 1};
    CHECK_REFUSED(out, cstk_space_distances(f->space, f->q, f->q, 1, FIXTURE_NQ, weights, out),
                  CSTK_ERROR_INVALID_ARGUMENT, "weight 1 is negative");
    CHECK_OK(cstk_space_distances(f->space, f->q, NULL, 0, FIXTURE_NQ, NULL, NULL));
    fixture_unchanged(f);
}

static void jacobian_points(const fixture *f) {
    double out[6 * FIXTURE_NQ];
    const cstk_space *s = f->space;
    const double good[3] = {0.1, 0.2, 0.3};
    CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, 1, NULL, out), CSTK_ERROR_NULL_ARGUMENT,
                  "point");
    const uint32_t links[] = {FIXTURE_LINKS, CSTK_NONE};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, links[i], good, out),
                      CSTK_ERROR_NOT_FOUND, "link");
    }
    for (int entry = 0; entry < 3; ++entry) {
        double point[3] = {0.1, 0.2, 0.3};
        EACH_NOT_FINITE(i) {
            point[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, 1, point, out),
                          CSTK_ERROR_NOT_FINITE, "point");
        }
        point[entry] = 1.7e308;
        CHECK_REFUSED(out, cstk_space_jacobian(s, f->q, FIXTURE_NQ, 1, point, out),
                      CSTK_ERROR_INVALID_ARGUMENT, "point");
    }
    fixture_unchanged(f);
}

static void neutral(const fixture *f) {
    double out[FIXTURE_NQ];
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_space_get_neutral(bad->handle, out), bad->status, "space");
    }
    CHECK_FAILS(cstk_space_get_neutral(f->space, NULL), CSTK_ERROR_NULL_ARGUMENT, "q");
    fixture_unchanged(f);
}

static void sample(const fixture *f) {
    double out[FREE_NQ];
    uint64_t state = 7;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_space_sample(bad->handle, &state, out), bad->status, "space");
    }
    CHECK_REFUSED(out, cstk_space_sample(f->space, NULL, out), CSTK_ERROR_NULL_ARGUMENT, "state");
    CHECK_FAILS(cstk_space_sample(f->space, &state, NULL), CSTK_ERROR_NULL_ARGUMENT, "q");
    cstk_space *space = make_free_space();
    CHECK_REFUSED(out, cstk_space_sample(space, &state, out), CSTK_ERROR_UNSUPPORTED, "coordinate 0");
    CHECK_OK(cstk_space_release(space));
    /* A call that fails does not advance the stream. */
    CHECK(state == 7);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        configurations(&f, &forms[i]);
        quaternions(&f, &forms[i]);
    }
    step_velocities(&f);
    interpolate_parameters(&f);
    distance_weights(&f);
    distances_of_many(&f);
    jacobian_points(&f);
    neutral(&f);
    sample(&f);
    fixture_release(&f);
    return check_result();
}
