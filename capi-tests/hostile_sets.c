/* Hostile input to sets given by coordinates, to sets made of others, and to the data they carry.
 */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

enum { NQ = 3, SLIDER = 0, WHEEL = 1, HINGE = 2 };

/* Spaces with coordinates of all kinds: a slider, a wheel and a hinge with limits; a ball joint.
 * And arguments of good sets of the first, with room behind them. */
typedef struct scene {
    fixture f;
    cstk_robot *robot;
    cstk_robot *turning_robot;
    cstk_space *space;
    cstk_space *turning;
    double low[NQ + 1];
    double high[NQ + 1];
    double normal[NQ + 1];
    double center[NQ + 1];
    cstk_pure_options options;
} scene;

static void scene_create(scene *s) {
    cstk_robot_builder *builder = NULL;
    const int32_t kinds[NQ] = {CSTK_JOINT_PRISMATIC, CSTK_JOINT_REVOLUTE, CSTK_JOINT_REVOLUTE};
    const cstk_link_def ball = link_of(CSTK_JOINT_SPHERICAL);
    memset(s, 0, sizeof *s);
    fixture_create(&s->f);
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < NQ; ++i) {
        cstk_link_def def = link_of(kinds[i]);
        def.body = s->f.body;
        if (i == HINGE) {
            def.lower = -1.0;
            def.upper = 1.0;
        }
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    CHECK_OK(cstk_robot_build(builder, &s->robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    s->turning_robot = make_robot(&ball);
    s->space = space_of(s->robot, NULL, 0);
    s->turning = space_of(s->turning_robot, NULL, 0);
    for (int i = 0; i < NQ; ++i) {
        s->low[i] = -0.5;
        s->high[i] = 0.5;
        s->normal[i] = i == WHEEL ? 0.0 : 1.0;
    }
    CHECK_OK(cstk_pure_options_default(&s->options, sizeof s->options));
}

static void scene_release(scene *s) {
    CHECK_OK(cstk_space_release(s->turning));
    CHECK_OK(cstk_space_release(s->space));
    CHECK_OK(cstk_robot_release(s->turning_robot));
    CHECK_OK(cstk_robot_release(s->robot));
    fixture_release(&s->f);
}

static int32_t nowhere(const double *q, size_t nq, int32_t *out, void *user) {
    (void)q, (void)nq, (void)user;
    *out = CSTK_CLASS_OUTSIDE;
    return CSTK_OK;
}

typedef enum kind { LIMITS, WORLD, BOX, HALF_SPACE, BALL, PREDICATE, KINDS } kind;

static cstk_status make(const scene *s, kind kind, const cstk_space *space, size_t nq,
                        const cstk_pure_options *options, cstk_cobject **out) {
    cstk_predicate predicate;
    switch (kind) {
    case LIMITS:
        return cstk_cobject_beyond_limits(space, options, out);
    case WORLD:
        return cstk_cobject_beyond_world(space, options, out);
    case BOX:
        return cstk_cobject_box(space, s->low, s->high, nq, options, out);
    case HALF_SPACE:
        return cstk_cobject_halfspace(space, s->normal, nq, 0.5, options, out);
    case BALL:
        return cstk_cobject_ball(space, s->center, nq, 0.5, options, out);
    default:
        CHECK_OK(cstk_predicate_default(&predicate, sizeof predicate));
        predicate.classify = nowhere;
        return cstk_cobject_predicate(space, &predicate, options, out);
    }
}

static cstk_cobject *make_set(const scene *s, kind kind) {
    cstk_cobject *out = NULL;
    CHECK_OK(make(s, kind, s->space, NQ, &s->options, &out));
    return out;
}

static void pure_sets(const scene *s) {
    const double values[] = {NAN, INFINITY, -INFINITY, -1e-9, 1e300};
    for (int kind = 0; kind < KINDS; ++kind) {
        cstk_cobject *out;
        EACH_BAD_HANDLE(&s->f, NOUN_SPACE, bad) {
            CHECK_REFUSED(out, make(s, kind, bad->handle, NQ, NULL, &out), bad->status, "space");
        }
        CHECK_FAILS(make(s, kind, s->space, NQ, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
        EACH_BAD_OPTIONS(s->options, bad) {
            CHECK_REFUSED(out, make(s, kind, s->space, NQ, bad->options, &out), bad->status,
                          "options");
        }
        for (int i = 0; i < 5; ++i) {
            const cstk_status status = i < 3 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT;
            cstk_pure_options options = s->options;
            options.scale = values[i];
            CHECK_REFUSED(out, make(s, kind, s->space, NQ, &options, &out), status, "scale");
            if (i < 4) {
                options = s->options;
                options.contact_epsilon = values[i];
                CHECK_REFUSED(out, make(s, kind, s->space, NQ, &options, &out), status,
                              "contact_epsilon");
            }
        }
        if (kind == BOX || kind == HALF_SPACE || kind == BALL) {
            const size_t counts[] = {
                0, 1, NQ - 1, NQ + 1, SIZE_MAX, SIZE_MAX / 8 + 2, (size_t)1 << 40, SIZE_MAX / 16};
            for (int i = 0; i < 8; ++i) {
                CHECK_REFUSED(out, make(s, kind, s->space, counts[i], NULL, &out), CSTK_ERROR_WRONG_SIZE,
                              kind == BOX          ? "low"
                              : kind == HALF_SPACE ? "normal"
                                                   : "center");
            }
        }
        /* Zero of either sign is none. */
        cstk_pure_options options = s->options;
        options.scale = -0.0;
        options.contact_epsilon = -0.0;
        CHECK_OK(make(s, kind, s->space, NQ, &options, &out));
        CHECK_OK(cstk_cobject_release(out));
    }
    fixture_unchanged(&s->f);
}

static void refuse_box(const cstk_space *space, const double *low, const double *high, size_t nq,
                       cstk_status status, const char *culprit) {
    cstk_cobject *out;
    CHECK_REFUSED(out, cstk_cobject_box(space, low, high, nq, NULL, &out), status, culprit);
}

static void boxes(const scene *s) {
    const struct {
        int coordinate;
        double low;
        double high;
        cstk_status status;
    } wrong[] = {
        {SLIDER, NAN, 1.0, CSTK_ERROR_NOT_FINITE},
        {HINGE, 0.0, NAN, CSTK_ERROR_NOT_FINITE},
        {WHEEL, NAN, NAN, CSTK_ERROR_NOT_FINITE},
        {SLIDER, 0.5, 0.4, CSTK_ERROR_INVALID_ARGUMENT},
        {WHEEL, 3.0, -3.0, CSTK_ERROR_INVALID_ARGUMENT},
        {SLIDER, INFINITY, INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
        {HINGE, -INFINITY, -INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
        {SLIDER, INFINITY, -INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
        {SLIDER, -1e300, 1.0, CSTK_ERROR_INVALID_ARGUMENT},
        {HINGE, 1.0, 1.7e308, CSTK_ERROR_INVALID_ARGUMENT},
        {WHEEL, -INFINITY, 1.0, CSTK_ERROR_INVALID_ARGUMENT},
        {WHEEL, 1.0, INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
    };
    refuse_box(s->space, NULL, s->high, NQ, CSTK_ERROR_NULL_ARGUMENT, "low");
    refuse_box(s->space, s->low, NULL, NQ, CSTK_ERROR_NULL_ARGUMENT, "high");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        double low[NQ] = {0.0, 0.0, 0.0};
        double high[NQ] = {1.0, 1.0, 1.0};
        low[wrong[i].coordinate] = wrong[i].low;
        high[wrong[i].coordinate] = wrong[i].high;
        refuse_box(s->space, low, high, NQ, wrong[i].status, "interval");
    }
    for (int i = 0; i < 4; ++i) {
        double low[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
        double high[4] = {INFINITY, INFINITY, INFINITY, INFINITY};
        high[i] = 1.0;
        refuse_box(s->turning, low, high, 4, CSTK_ERROR_INVALID_ARGUMENT, "quaternion");
        low[i] = -1.0;
        refuse_box(s->turning, low, high, 4, CSTK_ERROR_INVALID_ARGUMENT, "quaternion");
    }
    fixture_unchanged(&s->f);
}

static void refuse_half_space(const cstk_space *space, const double *normal, size_t nq,
                              double offset, cstk_status status, const char *culprit) {
    cstk_cobject *out;
    CHECK_REFUSED(out, cstk_cobject_halfspace(space, normal, nq, offset, NULL, &out), status,
                  culprit);
}

static void half_spaces(const scene *s) {
    const double none[4] = {0};
    refuse_half_space(s->space, NULL, NQ, 0.0, CSTK_ERROR_NULL_ARGUMENT, "normal");
    refuse_half_space(s->space, none, NQ, 1.0, CSTK_ERROR_DEGENERATE, "normal");
    refuse_half_space(s->turning, none, 4, 1.0, CSTK_ERROR_DEGENERATE, "normal");
    EACH_NOT_FINITE(i) {
        refuse_half_space(s->space, s->normal, NQ, not_finite[i], CSTK_ERROR_NOT_FINITE, "offset");
        for (int entry = 0; entry < NQ; ++entry) {
            double bad[NQ] = {1.0, 0.0, 1.0};
            bad[entry] = not_finite[i];
            refuse_half_space(s->space, bad, NQ, 0.0, CSTK_ERROR_NOT_FINITE, "normal");
        }
    }
    refuse_half_space(s->space, s->normal, NQ, -1e300, CSTK_ERROR_INVALID_ARGUMENT, "offset");
    const double huge[NQ] = {1.0, 0.0, 1e300};
    const double tiny[NQ] = {5e-324, 0.0, -5e-324};
    const double on_a_circle[NQ] = {1.0, 1e-9, 0.0};
    refuse_half_space(s->space, huge, NQ, 0.0, CSTK_ERROR_INVALID_ARGUMENT, "normal");
    refuse_half_space(s->space, tiny, NQ, 0.0, CSTK_ERROR_DEGENERATE, "normal");
    refuse_half_space(s->space, on_a_circle, NQ, 0.0, CSTK_ERROR_INVALID_ARGUMENT, "circle");
    for (int i = 0; i < 4; ++i) {
        double bad[4] = {0};
        bad[i] = 1.0;
        refuse_half_space(s->turning, bad, 4, 0.0, CSTK_ERROR_INVALID_ARGUMENT, "quaternion");
    }
    fixture_unchanged(&s->f);
}

static void refuse_ball(const cstk_space *space, const double *center, size_t nq, double radius,
                        cstk_status status, const char *culprit) {
    cstk_cobject *out;
    CHECK_REFUSED(out, cstk_cobject_ball(space, center, nq, radius, NULL, &out), status, culprit);
}

static void balls(const scene *s) {
    refuse_ball(s->space, NULL, NQ, 1.0, CSTK_ERROR_NULL_ARGUMENT, "center");
    EACH_NOT_FINITE(i) {
        refuse_ball(s->space, s->center, NQ, not_finite[i], CSTK_ERROR_NOT_FINITE, "radius");
        for (int entry = 0; entry < NQ; ++entry) {
            double bad[NQ] = {0};
            bad[entry] = not_finite[i];
            refuse_ball(s->space, bad, NQ, 1.0, CSTK_ERROR_NOT_FINITE, "center");
        }
    }
    const double far[NQ] = {0.0, 0.0, 1e300};
    const double not_unit[2][4] = {{0, 0, 0, 1.0001}, {0, 0, 0, 0}};
    refuse_ball(s->space, far, NQ, 1.0, CSTK_ERROR_INVALID_ARGUMENT, "center");
    refuse_ball(s->space, s->center, NQ, -1e-300, CSTK_ERROR_INVALID_ARGUMENT, "radius");
    refuse_ball(s->space, s->center, NQ, 1e300, CSTK_ERROR_INVALID_ARGUMENT, "radius");
    for (int i = 0; i < 2; ++i) {
        refuse_ball(s->turning, not_unit[i], 4, 1.0, CSTK_ERROR_NOT_A_ROTATION, "center");
    }
    fixture_unchanged(&s->f);
}

typedef cstk_status (*combine_fn)(const cstk_cobject *const *, size_t, cstk_cobject **);

static void combinations(const scene *s) {
    const combine_fn all[] = {cstk_cobject_union, cstk_cobject_intersection};
    const char *names[] = {"union", "intersection"};
    cstk_cobject *out;
    cstk_cobject *here = make_set(s, BALL);
    const cstk_cobject *elsewhere = s->f.cobject;
    for (int i = 0; i < 2; ++i) {
        EACH_BAD_HANDLE(&s->f, NOUN_COBJECT, bad) {
            const cstk_cobject *parts[2] = {here, bad->handle};
            CHECK_REFUSED(out, all[i](parts, 2, &out), bad->status, "parts[1]");
        }
        const cstk_cobject *parts[3] = {here, here, elsewhere};
        CHECK_REFUSED(out, all[i](NULL, 1, &out), CSTK_ERROR_NULL_ARGUMENT, "parts");
        CHECK_FAILS(all[i](parts, 1, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
        CHECK_REFUSED(out, all[i](parts, 0, &out), CSTK_ERROR_EMPTY, names[i]);
        CHECK_REFUSED(out, all[i](NULL, 0, &out), CSTK_ERROR_EMPTY, names[i]);
        CHECK_REFUSED(out, all[i](parts, SIZE_MAX, &out), CSTK_ERROR_WRONG_SIZE, "parts");
        CHECK_REFUSED(out, all[i](parts, SIZE_MAX / 8 + 2, &out), CSTK_ERROR_WRONG_SIZE, "parts");
        CHECK_REFUSED(out, all[i](parts, 3, &out), CSTK_ERROR_INVALID_ARGUMENT, "C-object 2");
    }
    EACH_BAD_HANDLE(&s->f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out, cstk_cobject_complement(bad->handle, &out), bad->status, "part");
        CHECK_REFUSED(out, cstk_cobject_difference(bad->handle, here, &out), bad->status, "of");
        CHECK_REFUSED(out, cstk_cobject_difference(here, bad->handle, &out), bad->status,
                      "without");
    }
    CHECK_FAILS(cstk_cobject_complement(here, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_cobject_difference(here, here, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_cobject_difference(here, elsewhere, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "space");
    CHECK_OK(cstk_cobject_release(here));
    fixture_unchanged(&s->f);
}

/* However small the scale, a configuration outside stays outside. */
static void small_scales(const scene *s) {
    const double scales[] = {1.0, 1e-200, 1e-300, 1e-310, 5e-324};
    const double q[NQ] = {0.7, 0.1, 0.1};
    for (int i = 0; i < 5; ++i) {
        cstk_class point_class;
        cstk_distance_result d;
        cstk_cobject *set = NULL;
        cstk_pure_options options = s->options;
        options.scale = scales[i];
        if (make(s, BALL, s->space, NQ, &options, &set) != CSTK_OK) {
            /* Refused: as good. */
            continue;
        }
        CHECK_OK(cstk_classify(s->f.query, set, q, NQ, &point_class));
        CHECK_OK(cstk_distance(s->f.query, set, q, NQ, INFINITY, &d));
        if (point_class != CSTK_CLASS_OUTSIDE || !(d.distance > 0.0)) {
            fprintf(stderr, "scale %g: class %d, distance %g\n", scales[i], (int)point_class,
                    d.distance);
            ++check_failures;
        }
        CHECK_OK(cstk_cobject_release(set));
    }
}

static void count(void *user) { ++*(int *)user; }

/* What was refused is not given back. */
static void data(const scene *s) {
    int destroyed = 0;
    cstk_cobject *out;
    struct {
        void *data;
        uint64_t number;
    } got;
    EACH_BAD_HANDLE(&s->f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out, cstk_cobject_with_data(bad->handle, &destroyed, count, &out),
                      bad->status, "cobject");
        CHECK_REFUSED(got, cstk_cobject_get_data(bad->handle, &got.data, &got.number), bad->status,
                      "cobject");
    }
    CHECK_FAILS(cstk_cobject_with_data(s->f.cobject, &destroyed, count, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "out");
    CHECK(destroyed == 0);
    CHECK_OK(cstk_cobject_get_data(s->f.cobject, NULL, NULL));
    cstk_space *space;
    EACH_BAD_HANDLE(&s->f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(space, cstk_cobject_get_space(bad->handle, &space), bad->status, "cobject");
    }
    CHECK_FAILS(cstk_cobject_get_space(s->f.cobject, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    size_t nq = 0;
    CHECK_OK(cstk_cobject_get_space(s->f.cobject, &space));
    CHECK_OK(cstk_space_get_size(space, &nq, NULL, NULL));
    CHECK(nq == FIXTURE_NQ);
    CHECK_OK(cstk_space_release(space));
    fixture_unchanged(&s->f);
}

static void shells(const scene *s) {
    const double bad_shells[] = {0.0, -0.0, -1.0, 1e-60, 1e60, INFINITY, -INFINITY, NAN};
    cstk_cobject *out = NULL;
    cstk_cobject *shelled = NULL;
    cstk_cobject *parts = NULL;
    void *data = NULL;
    int mark = 0;
    EACH_BAD_HANDLE(&s->f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out, cstk_cobject_with_shell(bad->handle, 0.1, &out), bad->status, "cobject");
    }
    for (size_t i = 0; i < sizeof bad_shells / sizeof bad_shells[0]; ++i) {
        const cstk_status status = isfinite(bad_shells[i]) ? CSTK_ERROR_INVALID_ARGUMENT : CSTK_ERROR_NOT_FINITE;
        CHECK_REFUSED(out, cstk_cobject_with_shell(s->f.cobject, bad_shells[i], &out), status, "shell");
    }
    CHECK_FAILS(cstk_cobject_with_shell(s->f.cobject, 0.1, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    /* What is combined has no shell of its own. */
    const cstk_cobject *one[1] = {s->f.cobject};
    CHECK_OK(cstk_cobject_union(one, 1, &parts));
    CHECK_REFUSED(out, cstk_cobject_with_shell(parts, 0.1, &out), CSTK_ERROR_UNSUPPORTED, "shell");
    CHECK_OK(cstk_cobject_release(parts));
    /* The data stay; a second shell takes the place of the first. */
    CHECK_OK(cstk_cobject_with_data(s->f.cobject, &mark, NULL, &parts));
    CHECK_OK(cstk_cobject_with_shell(parts, 0.1, &shelled));
    CHECK_OK(cstk_cobject_with_shell(shelled, 0.2, &out));
    CHECK_OK(cstk_cobject_get_data(out, &data, NULL));
    CHECK(data == &mark);
    CHECK_OK(cstk_cobject_release(out));
    CHECK_OK(cstk_cobject_release(shelled));
    CHECK_OK(cstk_cobject_release(parts));
    fixture_unchanged(&s->f);
}

static void known_classes(const scene *s) {
    cstk_cobject *ball = NULL;
    cstk_cobject *limits = NULL;
    cstk_cobject *elsewhere = NULL;
    cstk_cobject *out = NULL;
    const int32_t bad_classes[] = {CSTK_CLASS_CONTACT, -1, 3, INT32_MIN, INT32_MAX};
    CHECK_OK(cstk_cobject_ball(s->space, s->center, NQ, 0.5, NULL, &ball));
    CHECK_OK(cstk_cobject_beyond_limits(s->space, NULL, &limits));
    CHECK_OK(cstk_cobject_beyond_limits(s->turning, NULL, &elsewhere));
    EACH_BAD_HANDLE(&s->f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out, cstk_cobject_with_known(bad->handle, ball, CSTK_CLASS_OUTSIDE, &out), bad->status, "of");
        CHECK_REFUSED(out, cstk_cobject_with_known(limits, bad->handle, CSTK_CLASS_OUTSIDE, &out), bad->status,
                      "within");
    }
    for (size_t i = 0; i < sizeof bad_classes / sizeof bad_classes[0]; ++i) {
        CHECK_REFUSED(out, cstk_cobject_with_known(limits, ball, bad_classes[i], &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "known");
    }
    CHECK_FAILS(cstk_cobject_with_known(limits, ball, CSTK_CLASS_OUTSIDE, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_cobject_with_known(ball, limits, CSTK_CLASS_OUTSIDE, &out), CSTK_ERROR_UNSUPPORTED,
                  "within");
    CHECK_REFUSED(out, cstk_cobject_with_known(elsewhere, ball, CSTK_CLASS_OUTSIDE, &out),
                  CSTK_ERROR_INVALID_ARGUMENT, "within");
    CHECK_OK(cstk_cobject_with_known(limits, ball, CSTK_CLASS_INSIDE, &out));
    CHECK_OK(cstk_cobject_release(out));
    CHECK_OK(cstk_cobject_release(elsewhere));
    CHECK_OK(cstk_cobject_release(limits));
    CHECK_OK(cstk_cobject_release(ball));
    fixture_unchanged(&s->f);
}

int main(void) {
    static scene s;
    scene_create(&s);
    pure_sets(&s);
    boxes(&s);
    half_spaces(&s);
    balls(&s);
    small_scales(&s);
    combinations(&s);
    data(&s);
    shells(&s);
    known_classes(&s);
    scene_release(&s);
    return check_result();
}
