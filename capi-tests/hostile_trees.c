/* Hostile trees of sets, and hostile questions about them: nesting without end, sharing that would
 * double, units that cannot be compared, link poses without coordinates, ways that cannot be
 * proved. */
#include <math.h>

#include "check.h"
#include "cube.h"
#include "fixture.h"

enum { NQ = CUBE_NQ, LINKS = 3, DEEPEST = 256 };

/* Outside of all leaves of the cube, and near some. */
static const double q[NQ] = {1.0, 1.2, 1.2};

typedef union answer {
    cstk_class point_class;
    bool within;
    cstk_distance_result distance;
    cstk_witness_list list;
    cstk_pseudo_normal_result pseudo_normal;
    cstk_explanation explanation;
    struct {
        double reached[NQ];
        cstk_slide_result result;
    } slide;
} answer;

typedef struct question {
    cstk_query *query;
    const cstk_cobject *set;
    const double *at;
    size_t count;
} question;

typedef cstk_status (*ask_fn)(const question *, answer *);

static cstk_status classify(const question *a, answer *out) {
    return cstk_classify(a->query, a->set, a->at, a->count, &out->point_class);
}

static cstk_status explain(const question *a, answer *out) {
    return cstk_explain(a->query, a->set, a->at, a->count, 16, &out->explanation);
}

static cstk_status within(const question *a, answer *out) {
    return cstk_within(a->query, a->set, a->at, a->count, 0.1, &out->within);
}

static cstk_status distance(const question *a, answer *out) {
    return cstk_distance(a->query, a->set, a->at, a->count, INFINITY, &out->distance);
}

static cstk_status witnesses(const question *a, answer *out) {
    return cstk_witnesses(a->query, a->set, a->at, a->count, 10.0, 16, &out->list);
}

static cstk_status gradients(const question *a, answer *out) {
    return cstk_gradients(a->query, a->set, a->at, a->count, 10.0, 16, &out->list);
}

static cstk_status pseudo_normal(const question *a, answer *out) {
    return cstk_pseudo_normal(a->query, a->set, a->at, a->count, 10.0, 16, true,
                              &out->pseudo_normal);
}

static cstk_status slide(const question *a, answer *out) {
    const double step[NQ] = {0.01, 0.0, 0.0};
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = 0.1;
    return cstk_slide(a->query, a->set, a->at, a->count, step, NQ, &options, out->slide.reached,
                      &out->slide.result);
}

static const char *picture = "hostile_trees.glb";

static cstk_status show(const question *a, answer *out) {
    (void)out;
    return cstk_show(a->set, a->at, a->count, picture);
}

static cstk_status classify_at(const question *a, answer *out) {
    return cstk_classify_at_link_poses(a->query, a->set, a->at, a->count, &out->point_class);
}

static cstk_status within_at(const question *a, answer *out) {
    return cstk_within_at_link_poses(a->query, a->set, a->at, a->count, 0.1, &out->within);
}

static cstk_status distance_at(const question *a, answer *out) {
    return cstk_distance_at_link_poses(a->query, a->set, a->at, a->count, INFINITY, &out->distance);
}

static cstk_status witnesses_at(const question *a, answer *out) {
    return cstk_witnesses_at_link_poses(a->query, a->set, a->at, a->count, 10.0, 16, &out->list);
}

/* Those that only compare classes come first (pictures leave out what has no place in the world), then those that measure, then those at link poses. */
static const ask_fn forms[] = {classify,  explain,   show,          within,      distance,
                               witnesses, gradients, pseudo_normal, slide,       classify_at,
                               within_at, distance_at, witnesses_at};

enum { BY_CLASS = 3, SLIDE = 8, BY_POSES = 9, FORMS = sizeof forms / sizeof forms[0] };

/* Calls from `first` on up to `last` are refused. */
static void refuse(const question *a, int first, int last, cstk_status status,
                   const char *culprit) {
    for (int i = first; i < last; ++i) {
        answer out;
        const int before = check_failures;
        CHECK_REFUSED(out, forms[i](a, &out), status, culprit);
        if (check_failures > before) {
            fprintf(stderr, "  (form %d)\n", i);
        }
    }
    CHECK(remove(picture) != 0);
}

static void answers(const question *a, int first, int last) {
    for (int i = first; i < last; ++i) {
        answer out;
        CHECK_OK(forms[i](a, &out));
    }
    remove(picture);
}

static cstk_cobject *ball(const cube *c, double scale) {
    const double center[NQ] = {0.0, 0.0, 0.0};
    cstk_pure_options options;
    cstk_cobject *out = NULL;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    options.scale = scale;
    CHECK_OK(cstk_cobject_ball(c->space, center, NQ, 0.5, &options, &out));
    return out;
}

typedef cstk_status (*combine_fn)(const cstk_cobject *const *, size_t, cstk_cobject **);

static cstk_cobject *combine(combine_fn how, const cstk_cobject *a, const cstk_cobject *b) {
    const cstk_cobject *parts[2] = {a, b};
    cstk_cobject *out = NULL;
    CHECK_OK(how(parts, 2, &out));
    return out;
}

/* The set takes the place of its part. */
static void replace(cstk_cobject **set, cstk_cobject *by) {
    CHECK_OK(cstk_cobject_release(*set));
    *set = by;
}

/* Unions and intersections by turns count, also with complements between; the deepest set that
 * there may be is asked everything, and deeper ones are refused and change nothing. */
static void nesting(const cube *c, bool with_complements) {
    const cstk_cobject *leaf = c->leaves[BALL].set;
    const combine_fn hows[] = {cstk_cobject_union, cstk_cobject_intersection};
    cstk_cobject *out;
    cstk_cobject *set = ball(c, 1.0);
    for (int depth = 2; depth <= DEEPEST; ++depth) {
        if (with_complements && depth % 3 == 0) {
            CHECK_OK(cstk_cobject_complement(set, &out));
            replace(&set, out);
        } else {
            replace(&set, combine(hows[depth % 2], set, leaf));
        }
    }
    const question a = {c->query, set, q, NQ};
    for (int again = 0; again < 2; ++again) {
        answers(&a, 0, SLIDE);
        const cstk_cobject *parts[2] = {leaf, set};
        CHECK_REFUSED(out, hows[(DEEPEST + 1) % 2](parts, 2, &out), CSTK_ERROR_UNSUPPORTED, "256");
        CHECK_REFUSED(out, cstk_cobject_difference(leaf, set, &out), CSTK_ERROR_UNSUPPORTED, "256");
        CHECK_REFUSED(out, cstk_cobject_complement(set, &out), CSTK_ERROR_UNSUPPORTED, "256");
    }
    /* To carry data is no deeper. */
    CHECK_OK(cstk_cobject_with_data(set, NULL, NULL, &out));
    replace(&set, out);
    const question marked = {c->query, set, q, NQ};
    answers(&marked, 0, SLIDE);
    CHECK_OK(cstk_cobject_release(set));
}

/* Unions in unions count as one, and so do intersections in intersections; complements of
 * complements are the set itself. */
static void flat_nesting(const cube *c) {
    const combine_fn hows[] = {cstk_cobject_union, cstk_cobject_intersection};
    for (int i = 0; i < 3; ++i) {
        cstk_cobject *set = ball(c, 1.0);
        for (int n = 0; n < 2 * DEEPEST; ++n) {
            cstk_cobject *next = NULL;
            if (i == 2) {
                CHECK_OK(cstk_cobject_complement(set, &next));
            } else {
                cstk_cobject *leaf = ball(c, 1.0);
                next = combine(hows[i], set, leaf);
                CHECK_OK(cstk_cobject_release(leaf));
            }
            replace(&set, next);
        }
        const question a = {c->query, set, q, NQ};
        answers(&a, 0, SLIDE);
        CHECK_OK(cstk_cobject_release(set));
    }
}

static int32_t counted(const double *at, size_t nq, int32_t *out, void *user) {
    (void)at, (void)nq;
    ++*(int *)user;
    *out = CSTK_CLASS_CONTACT;
    return CSTK_OK;
}

static int32_t away(const double *at, size_t nq, double *out, void *user) {
    (void)at, (void)nq;
    ++*(int *)user;
    *out = 0.05;
    return CSTK_OK;
}

static int32_t gradient(const double *at, size_t nq, double *row, size_t nv, void *user) {
    (void)at, (void)nq, (void)nv;
    ++*(int *)user;
    row[0] = 1.0;
    row[1] = row[2] = 0.0;
    return CSTK_OK;
}

/* Each level holds the one below twice: 2^60 ways lead down, and 120 sets are asked. */
static void sharing(const cube *c) {
    int calls = 0;
    cstk_predicate predicate;
    cstk_cobject *set = NULL;
    CHECK_OK(cstk_predicate_default(&predicate, sizeof predicate));
    predicate.classify = counted;
    predicate.distance = away;
    predicate.gradient = gradient;
    predicate.user = &calls;
    CHECK_OK(cstk_cobject_predicate(c->space, &predicate, NULL, &set));
    cstk_cobject *bottom = set;
    CHECK_OK(cstk_cobject_retain(bottom));
    cstk_cobject *others[2] = {ball(c, 0.0), ball(c, 0.0)};
    for (int level = 0; level < 60; ++level) {
        cstk_cobject *halves[2];
        for (int i = 0; i < 2; ++i) {
            /* Neither is ever outside, so that the level below is looked at. */
            cstk_cobject *complement = NULL;
            CHECK_OK(cstk_cobject_complement(others[i], &complement));
            halves[i] = combine(cstk_cobject_intersection, set, complement);
            CHECK_OK(cstk_cobject_release(complement));
        }
        replace(&set, combine(cstk_cobject_union, halves[0], halves[1]));
        for (int i = 0; i < 2; ++i) {
            CHECK_OK(cstk_cobject_release(halves[i]));
        }
    }
    const question a = {c->query, set, q, NQ};
    for (int i = 0; i < SLIDE; ++i) {
        answer out;
        calls = 0;
        CHECK_OK(forms[i](&a, &out));
        CHECK(0 < calls && calls < 100);
        if (i == 0) {
            CHECK(out.point_class == CSTK_CLASS_CONTACT);
        }
    }
    remove(picture);
    CHECK_OK(cstk_cobject_release(set));
    CHECK_OK(cstk_cobject_release(bottom));
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_cobject_release(others[i]));
    }
}

/* Lengths and units of C-space stand in one tree, wherever: classes are told, distances are
 * refused. */
static void mixed_units(const cube *c) {
    const cstk_cobject *lengths[] = {c->leaves[OBSTACLE].set, c->leaves[WORLD].set,
                                     c->leaves[BOX].set};
    cstk_cobject *bare = ball(c, 0.0);
    uint64_t number = 0;
    char culprit[32];
    CHECK_OK(cstk_cobject_get_data(bare, NULL, &number));
    snprintf(culprit, sizeof culprit, "C-object %llu", (unsigned long long)number);
    for (int i = 0; i < 3; ++i) {
        cstk_cobject *mixed[5] = {NULL};
        mixed[0] = combine(cstk_cobject_union, lengths[i], bare);
        mixed[1] = combine(cstk_cobject_intersection, bare, lengths[i]);
        CHECK_OK(cstk_cobject_difference(bare, lengths[i], &mixed[2]));
        CHECK_OK(cstk_cobject_complement(mixed[0], &mixed[3]));
        mixed[4] = combine(cstk_cobject_union, mixed[3], c->leaves[POLE].set);
        for (int k = 0; k < 5; ++k) {
            const question a = {c->query, mixed[k], q, NQ};
            answers(&a, 0, BY_CLASS);
            refuse(&a, BY_CLASS, SLIDE, CSTK_ERROR_UNSUPPORTED, culprit);
            refuse(&a, BY_CLASS, SLIDE, CSTK_ERROR_UNSUPPORTED, "scale");
            refuse(&a, SLIDE, SLIDE + 1, CSTK_ERROR_UNSUPPORTED, k == 0 ? culprit : "slides");
        }
        for (int k = 0; k < 5; ++k) {
            CHECK_OK(cstk_cobject_release(mixed[k]));
        }
    }
    /* Each alone measures. */
    cstk_cobject *other = ball(c, 0.0);
    cstk_cobject *both = combine(cstk_cobject_union, bare, other);
    const question a = {c->query, both, q, NQ};
    answers(&a, 0, BY_POSES);
    CHECK_OK(cstk_cobject_release(both));
    CHECK_OK(cstk_cobject_release(other));
    CHECK_OK(cstk_cobject_release(bare));
}

/* Link poses do not tell coordinates: only the world box, which asks for none, answers. */
static void at_poses(const cube *c) {
    double poses[12 * LINKS];
    CHECK_OK(cstk_space_link_poses(c->space, q, NQ, poses));
    const char *names[LEAVES] = {[LIMITS] = "limits",
                                 [BALL] = "a ball",
                                 [BOX] = "a box",
                                 [HALF_SPACE] = "a half-space",
                                 [POLE] = "a predicate"};
    for (int leaf = 0; leaf < LEAVES; ++leaf) {
        const question a = {c->query, c->leaves[leaf].set, poses, LINKS};
        if (names[leaf] == NULL) {
            answers(&a, BY_POSES, FORMS);
            continue;
        }
        refuse(&a, BY_POSES, FORMS, CSTK_ERROR_UNSUPPORTED, names[leaf]);
        refuse(&a, BY_POSES, FORMS, CSTK_ERROR_UNSUPPORTED, "coordinates");
        cstk_cobject *both =
            combine(cstk_cobject_union, c->leaves[OBSTACLE].set, c->leaves[leaf].set);
        cstk_cobject *complement = NULL;
        CHECK_OK(cstk_cobject_complement(both, &complement));
        const question of_both = {c->query, both, poses, LINKS};
        const question of_complement = {c->query, complement, poses, LINKS};
        refuse(&of_both, BY_POSES, FORMS, CSTK_ERROR_UNSUPPORTED, names[leaf]);
        refuse(&of_complement, BY_POSES, FORMS, CSTK_ERROR_UNSUPPORTED, names[leaf]);
        CHECK_OK(cstk_cobject_release(complement));
        CHECK_OK(cstk_cobject_release(both));
    }
    cstk_cobject *both = combine(cstk_cobject_union, c->leaves[OBSTACLE].set, c->leaves[WORLD].set);
    const question a = {c->query, both, poses, LINKS};
    answers(&a, BY_POSES, FORMS);
    poses[3] = NAN;
    refuse(&a, BY_POSES, FORMS, CSTK_ERROR_NOT_FINITE, "link_poses[0]");
    CHECK_OK(cstk_cobject_release(both));
}

/* Whether poses alone are refused does not depend on the order of the parts, nor on what they say.
 */
static void poses_in_any_order(const cube *c) {
    double poses[12 * LINKS];
    const cstk_cobject *world = c->leaves[WORLD].set;
    const cstk_cobject *round = c->leaves[BALL].set;
    const combine_fn hows[] = {cstk_cobject_union, cstk_cobject_intersection};
    for (int outside = 0; outside < 2; ++outside) {
        CHECK_OK(cstk_space_link_poses(c->space, q, NQ, poses));
        poses[12 * CUBE_LINK + 3] += outside == 1 ? 100.0 : 0.0;
        for (int i = 0; i < 4; ++i) {
            cstk_cobject *set =
                combine(hows[i / 2], i % 2 == 0 ? world : round, i % 2 == 0 ? round : world);
            const question a = {c->query, set, poses, LINKS};
            refuse(&a, BY_POSES, FORMS, CSTK_ERROR_UNSUPPORTED, "a ball");
            CHECK_OK(cstk_cobject_release(set));
        }
    }
}

/* Slides need distances that prove ways free. */
static void slides(const cube *c) {
    const cstk_cobject *obstacle = c->leaves[OBSTACLE].set;
    const cstk_cobject *box = c->leaves[BOX].set;
    cstk_cobject *all[7] = {NULL};
    CHECK_OK(cstk_cobject_complement(box, &all[0]));
    CHECK_OK(cstk_cobject_complement(obstacle, &all[1]));
    CHECK_OK(cstk_cobject_difference(obstacle, box, &all[2]));
    all[3] = combine(cstk_cobject_intersection, obstacle, box);
    all[4] = combine(cstk_cobject_union, all[3], obstacle);
    all[5] = combine(cstk_cobject_union, c->leaves[POLE].set, obstacle);
    all[6] = c->leaves[POLE].set;
    for (int i = 0; i < 7; ++i) {
        const question a = {c->query, all[i], q, NQ};
        refuse(&a, SLIDE, SLIDE + 1, CSTK_ERROR_UNSUPPORTED, "slides");
    }
    for (int i = 0; i < 6; ++i) {
        CHECK_OK(cstk_cobject_release(all[i]));
    }
}

static void explanations(const cube *c, const fixture *f) {
    cstk_explanation out;
    const cstk_cobject *set = c->leaves[OBSTACLE].set;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out, cstk_explain(bad->handle, set, q, NQ, 16, &out), bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out, cstk_explain(c->query, bad->handle, q, NQ, 16, &out), bad->status,
                      "cobject");
    }
    CHECK_FAILS(cstk_explain(c->query, set, q, NQ, 16, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_explain(c->query, set, NULL, NQ, 16, &out), CSTK_ERROR_NULL_ARGUMENT, "q");
    const size_t counts[] = {0, 1, NQ - 1, SIZE_MAX, SIZE_MAX / 8 + 2};
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(out, cstk_explain(c->query, set, q, counts[i], 16, &out), CSTK_ERROR_WRONG_SIZE,
                      "");
    }
    for (int entry = 0; entry < NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[NQ] = {0.0, 0.0, 0.0};
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_explain(c->query, set, bad, NQ, 16, &out), CSTK_ERROR_NOT_FINITE,
                          "configuration");
        }
    }
    /* The largest count asks for all; with none, the verdicts stay. */
    const double inside[NQ] = {0.7, -0.3, 0.2};
    CHECK_OK(cstk_explain(c->query, set, inside, NQ, SIZE_MAX, &out));
    CHECK(out.point_class == CSTK_CLASS_INSIDE && out.list.witness_count == 1 && !out.list.truncated);
    CHECK_OK(cstk_explain(c->query, set, inside, NQ, 0, &out));
    CHECK(out.point_class == CSTK_CLASS_INSIDE && out.leaf_count == 1 && out.leaves[0].decisive);
    CHECK(out.list.witness_count == 0 && out.list.truncated && out.leaves[0].witness_count == 0);
}

int main(void) {
    cube c;
    fixture f;
    cube_create(&c);
    fixture_create(&f);
    nesting(&c, false);
    nesting(&c, true);
    flat_nesting(&c);
    sharing(&c);
    mixed_units(&c);
    at_poses(&c);
    poses_in_any_order(&c);
    slides(&c);
    explanations(&c, &f);
    fixture_unchanged(&f);
    fixture_release(&f);
    cube_release(&c);
    return check_result();
}
