/* Hostile predicates: structures that are none, and functions that fail, write what is no number or
 * no class, contradict themselves, or call back. */
#include <float.h>
#include <math.h>

#include "check.h"
#include "fixture.h"

enum { NQ = FIXTURE_NQ };

static const double unwritten = -12345.0;

/* What the functions are to do; they make a ball about the origin. */
typedef struct trick {
    double radius;
    int32_t class_status;
    int32_t distance_status;
    int32_t gradient_status;
    /* What they write instead of what is right, if anything. */
    const int32_t *written_class;
    const double *written_distance;
    const double *written_gradient;
    bool leaves_unwritten;
    /* Called from within the class function, if anything. */
    void (*call)(struct trick *);
    const struct scene *scene;
    cstk_status answered;
    int destroyed;
} trick;

static double away(const trick *t, const double *q) {
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) - t->radius;
}

static int32_t class_of(const double *q, size_t nq, int32_t *out, void *user) {
    trick *t = user;
    CHECK(nq == NQ && isfinite(q[0]) && isfinite(q[NQ - 1]));
    if (t->call != NULL) {
        t->call(t);
    }
    if (!t->leaves_unwritten) {
        *out = t->written_class != NULL ? *t->written_class
               : away(t, q) <= 0.0      ? CSTK_CLASS_INSIDE
                                        : CSTK_CLASS_OUTSIDE;
    }
    return t->class_status;
}

static int32_t distance_of(const double *q, size_t nq, double *out, void *user) {
    const trick *t = user;
    CHECK(nq == NQ);
    if (!t->leaves_unwritten) {
        *out = t->written_distance != NULL ? *t->written_distance : away(t, q);
    }
    return t->distance_status;
}

static int32_t gradient_of(const double *q, size_t nq, double *row, size_t nv, void *user) {
    const trick *t = user;
    CHECK(nq == NQ && nv == NQ);
    for (size_t i = 0; i < nv && !t->leaves_unwritten; ++i) {
        row[i] = q[i] / (away(t, q) + t->radius);
        if (t->written_gradient != NULL && t->written_gradient[i] != unwritten) {
            row[i] = t->written_gradient[i];
        }
    }
    return t->gradient_status;
}

static void destroy(void *user) { ++((trick *)user)->destroyed; }

static cstk_predicate good_predicate(trick *t) {
    cstk_predicate predicate;
    CHECK_OK(cstk_predicate_default(&predicate, sizeof predicate));
    predicate.classify = class_of;
    predicate.distance = distance_of;
    predicate.gradient = gradient_of;
    predicate.user = t;
    predicate.destroy = destroy;
    predicate.knows_depth = 1;
    return predicate;
}

/* The predicate alone, its complement, and in trees with the fixture's arm and its obstacle. */
enum { ALONE, COMPLEMENT, UNION, INTERSECTION, DIFFERENCE, SETS };

typedef struct scene {
    const fixture *f;
    cstk_cobject *sets[SETS];
    cstk_query *query;
    double q[NQ];
} scene;

static void scene_create(const fixture *f, const cstk_predicate *predicate, scene *s) {
    cstk_pure_options options;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    options.scale = 0.5;
    s->f = f;
    CHECK_OK(cstk_cobject_predicate(f->space, predicate, &options, &s->sets[ALONE]));
    const cstk_cobject *parts[2] = {s->sets[ALONE], f->cobject};
    CHECK_OK(cstk_cobject_complement(s->sets[ALONE], &s->sets[COMPLEMENT]));
    CHECK_OK(cstk_cobject_union(parts, 2, &s->sets[UNION]));
    CHECK_OK(cstk_cobject_intersection(parts, 2, &s->sets[INTERSECTION]));
    CHECK_OK(cstk_cobject_difference(s->sets[ALONE], f->cobject, &s->sets[DIFFERENCE]));
    CHECK_OK(cstk_query_create(&s->query));
    memcpy(s->q, f->q, sizeof s->q);
}

static void scene_release(const scene *s) {
    CHECK_OK(cstk_query_release(s->query));
    for (int i = 0; i < SETS; ++i) {
        CHECK_OK(cstk_cobject_release(s->sets[i]));
    }
}

typedef union answer {
    cstk_class point_class;
    bool within;
    cstk_distance_result distance;
    cstk_witness_list list;
    cstk_pseudo_normal_result pseudo_normal;
    cstk_explanation explanation;
} answer;

typedef cstk_status (*ask_fn)(const scene *, const cstk_cobject *, answer *);

static cstk_status classify(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_classify(s->query, set, s->q, NQ, &out->point_class);
}

static cstk_status explain(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_explain(s->query, set, s->q, NQ, 16, &out->explanation);
}

static cstk_status within(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_within(s->query, set, s->q, NQ, 0.001, &out->within);
}

static cstk_status distance(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_distance(s->query, set, s->q, NQ, INFINITY, &out->distance);
}

static cstk_status witnesses(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_witnesses(s->query, set, s->q, NQ, 10.0, 16, &out->list);
}

static cstk_status gradients(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_gradients(s->query, set, s->q, NQ, 10.0, 16, &out->list);
}

static cstk_status pseudo_normal(const scene *s, const cstk_cobject *set, answer *out) {
    return cstk_pseudo_normal(s->query, set, s->q, NQ, 10.0, 16, true, &out->pseudo_normal);
}

static const char *picture = "hostile_predicate.glb";

static cstk_status show(const scene *s, const cstk_cobject *set, answer *out) {
    (void)out;
    return cstk_show(set, s->q, NQ, picture);
}

/* Those that ask for the class, the distance, and the gradient. */
enum { ASKS_CLASS = 1, ASKS_DISTANCE = 2, ASKS_GRADIENT = 4 };

static const struct {
    const char *name;
    ask_fn ask;
    int asks;
} forms[] = {
    {"classify", classify, ASKS_CLASS},
    {"explain", explain, ASKS_CLASS},
    {"within", within, ASKS_CLASS | ASKS_DISTANCE},
    {"distance", distance, ASKS_CLASS | ASKS_DISTANCE},
    {"witnesses", witnesses, ASKS_CLASS | ASKS_DISTANCE},
    {"gradients", gradients, ASKS_CLASS | ASKS_DISTANCE | ASKS_GRADIENT},
    {"pseudo_normal", pseudo_normal, ASKS_CLASS | ASKS_DISTANCE | ASKS_GRADIENT},
    {"show", show, ASKS_CLASS | ASKS_DISTANCE},
};

enum { FORMS = sizeof forms / sizeof forms[0] };

/* All calls that ask one of these functions are refused, for all sets. */
static void refuse(const scene *s, int asks, cstk_status status, const char *culprit) {
    for (int i = 0; i < FORMS; ++i) {
        for (int k = 0; k < SETS && (forms[i].asks & asks) != 0; ++k) {
            answer out;
            const int before = check_failures;
            CHECK_REFUSED(out, forms[i].ask(s, s->sets[k], &out), status, culprit);
            if (check_failures > before) {
                fprintf(stderr, "  (cstk_%s, set %d)\n", forms[i].name, k);
            }
        }
    }
    if (remove(picture) == 0) {
        fprintf(stderr, "cstk_show failed, but wrote a file\n");
        ++check_failures;
    }
}

/* All answer; the distance is that before to the last bit. */
static void answers(const scene *s, double expected) {
    answer out;
    for (int i = 0; i < FORMS; ++i) {
        for (int k = 0; k < SETS; ++k) {
            CHECK_OK(forms[i].ask(s, s->sets[k], &out));
        }
    }
    CHECK(remove(picture) == 0);
    CHECK_OK(distance(s, s->sets[ALONE], &out));
    CHECK(memcmp(&out.distance.distance, &expected, sizeof expected) == 0);
}

static double distance_now(const scene *s) {
    answer out;
    CHECK_OK(distance(s, s->sets[ALONE], &out));
    CHECK(out.distance.kind == CSTK_DISTANCE_EXACT);
    return out.distance.distance;
}

static void refuse_predicate(const fixture *f, const cstk_predicate *predicate, cstk_status status,
                             const char *culprit) {
    cstk_cobject *out;
    CHECK_REFUSED(out, cstk_cobject_predicate(f->space, predicate, NULL, &out), status, culprit);
}

/* What is refused is not given back. */
static void bad_predicates(const fixture *f) {
    trick t = {0};
    cstk_cobject *out;
    cstk_pure_options options;
    const cstk_predicate good = good_predicate(&t);
    cstk_predicate predicate = good;
    refuse_predicate(f, NULL, CSTK_ERROR_NULL_ARGUMENT, "predicate");
    EACH_BAD_OPTIONS(good, bad) { refuse_predicate(f, bad->options, bad->status, "predicate"); }
    predicate.classify = NULL;
    refuse_predicate(f, &predicate, CSTK_ERROR_NULL_ARGUMENT, "classify");
    const uint32_t flags[] = {2, UINT32_MAX};
    for (int i = 0; i < 2; ++i) {
        predicate = good;
        predicate.distance_is_bound = flags[i];
        refuse_predicate(f, &predicate, CSTK_ERROR_INVALID_ARGUMENT, "distance_is_bound");
        predicate = good;
        predicate.knows_depth = flags[i];
        refuse_predicate(f, &predicate, CSTK_ERROR_INVALID_ARGUMENT, "knows_depth");
    }
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_cobject_predicate(bad->handle, &good, NULL, &out), bad->status,
                      "space");
    }
    CHECK_FAILS(cstk_cobject_predicate(f->space, &good, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    options.scale = NAN;
    CHECK_REFUSED(out, cstk_cobject_predicate(f->space, &good, &options, &out), CSTK_ERROR_NOT_FINITE,
                  "scale");
    options.cookie = 0;
    CHECK_REFUSED(out, cstk_cobject_predicate(f->space, &good, &options, &out),
                  CSTK_ERROR_NOT_INITIALISED, "options");
    CHECK(t.destroyed == 0);
    fixture_unchanged(f);
}

static void bad_statuses(const scene *s, trick *t) {
    const int32_t statuses[] = {1, CSTK_ERROR_NOT_FINITE, CSTK_ERROR_CALLBACK_FAILED, -1, INT32_MIN};
    for (int i = 0; i < 5; ++i) {
        char returned[32];
        snprintf(returned, sizeof returned, "returned %d", (int)statuses[i]);
        t->class_status = statuses[i];
        refuse(s, ASKS_CLASS, CSTK_ERROR_CALLBACK_FAILED, returned);
        refuse(s, ASKS_CLASS, CSTK_ERROR_CALLBACK_FAILED, "predicate's class");
        t->class_status = CSTK_OK;
        t->distance_status = statuses[i];
        refuse(s, ASKS_DISTANCE, CSTK_ERROR_CALLBACK_FAILED, returned);
        refuse(s, ASKS_DISTANCE, CSTK_ERROR_CALLBACK_FAILED, "predicate's distance");
        t->distance_status = CSTK_OK;
        t->gradient_status = statuses[i];
        refuse(s, ASKS_GRADIENT, CSTK_ERROR_CALLBACK_FAILED, returned);
        refuse(s, ASKS_GRADIENT, CSTK_ERROR_CALLBACK_FAILED, "predicate's gradient");
        t->gradient_status = CSTK_OK;
    }
}

static void bad_numbers(const scene *s, trick *t) {
    const int32_t classes[] = {-1, CSTK_CLASS_INSIDE + 1, INT32_MIN, INT32_MAX};
    for (int i = 0; i < 4; ++i) {
        t->written_class = &classes[i];
        refuse(s, ASKS_CLASS, CSTK_ERROR_CALLBACK_FAILED, "class");
    }
    t->written_class = NULL;
    EACH_NOT_FINITE(i) {
        t->written_distance = &not_finite[i];
        refuse(s, ASKS_DISTANCE, CSTK_ERROR_CALLBACK_FAILED, "distance");
    }
    t->written_distance = NULL;
    const double numbers[] = {NAN, INFINITY, -INFINITY, 1e300, -DBL_MAX};
    for (int entry = 0; entry < NQ; ++entry) {
        for (int i = 0; i < 5; ++i) {
            double row[NQ] = {unwritten, unwritten, unwritten};
            row[entry] = numbers[i];
            t->written_gradient = row;
            refuse(s, ASKS_GRADIENT, CSTK_ERROR_CALLBACK_FAILED, "gradient");
        }
    }
    t->written_gradient = NULL;
    t->leaves_unwritten = true;
    refuse(s, ASKS_CLASS, CSTK_ERROR_CALLBACK_FAILED, "predicate");
    t->leaves_unwritten = false;
}

/* A distance that the class denies. */
static void contradictions(const scene *s, trick *t) {
    const struct {
        int32_t point_class;
        double distance;
    } wrong[] = {{CSTK_CLASS_INSIDE, 1e-300}, {CSTK_CLASS_INSIDE, 1.0},    {CSTK_CLASS_CONTACT, 0.0},
                 {CSTK_CLASS_CONTACT, -1e-9}, {CSTK_CLASS_OUTSIDE, -1.0},  {CSTK_CLASS_OUTSIDE, 0.0},
                 {CSTK_CLASS_OUTSIDE, -0.0},  {CSTK_CLASS_CONTACT, -1e300}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        t->written_class = &wrong[i].point_class;
        t->written_distance = &wrong[i].distance;
        refuse(s, ASKS_DISTANCE, CSTK_ERROR_CALLBACK_FAILED, "C-object");
    }
    t->written_class = NULL;
    t->written_distance = NULL;
}

static void bad_functions(const fixture *f, double radius) {
    trick t = {0};
    scene s;
    t.radius = radius;
    cstk_predicate predicate = good_predicate(&t);
    scene_create(f, &predicate, &s);
    /* It was copied. */
    memset(&predicate, CHECK_SENTINEL, sizeof predicate);
    const double expected = distance_now(&s);
    CHECK((expected == 0.0) == (away(&t, s.q) <= 0.0));
    answers(&s, expected);
    bad_statuses(&s, &t);
    answers(&s, expected);
    bad_numbers(&s, &t);
    answers(&s, expected);
    contradictions(&s, &t);
    answers(&s, expected);
    scene_release(&s);
    CHECK(t.destroyed == 1);
    fixture_unchanged(f);
}

/* Gradients that nobody knows are refused within epsilon, and not missed beyond. */
static void no_gradient(const fixture *f) {
    trick t = {0};
    scene s;
    answer out;
    t.radius = 0.1;
    cstk_predicate predicate = good_predicate(&t);
    predicate.gradient = NULL;
    scene_create(f, &predicate, &s);
    const double expected = distance_now(&s);
    CHECK(expected > 0.1);
    refuse(&s, ASKS_GRADIENT, CSTK_ERROR_UNSUPPORTED, "gradient");
    for (int k = ALONE; k < SETS; ++k) {
        CHECK_OK(witnesses(&s, s.sets[k], &out));
        if (k != COMPLEMENT) {
            CHECK_OK(cstk_gradients(s.query, s.sets[k], s.q, NQ, 0.1, 16, &out.list));
        }
    }
    scene_release(&s);
    CHECK(t.destroyed == 1);
}

static void ask_same_query(trick *t) {
    const scene *s = t->scene;
    void (*call)(trick *) = t->call;
    /* Else a call that is not refused would never end. */
    t->call = NULL;
    for (int i = 0; i < FORMS; ++i) {
        if (forms[i].ask != show) {
            answer out;
            CHECK_REFUSED(out, forms[i].ask(s, s->f->cobject, &out), CSTK_ERROR_BUSY, "query");
            CHECK_REFUSED(out, forms[i].ask(s, s->sets[UNION], &out), CSTK_ERROR_BUSY, "query");
        }
    }
    t->answered = CSTK_ERROR_BUSY;
    t->call = call;
}

static void ask_other_query(trick *t) {
    cstk_query *other = NULL;
    cstk_class answered;
    void (*call)(trick *) = t->call;
    t->call = NULL;
    CHECK_OK(cstk_query_create(&other));
    t->answered = cstk_classify(other, t->scene->sets[UNION], t->scene->q, NQ, &answered);
    CHECK_OK(cstk_query_release(other));
    t->call = call;
}

/* The query that asks is busy for the function, and answers as ever. */
static void calls_back(const fixture *f) {
    trick t = {0};
    scene s;
    t.radius = 0.1;
    const cstk_predicate predicate = good_predicate(&t);
    scene_create(f, &predicate, &s);
    const double expected = distance_now(&s);
    t.scene = &s;
    for (int i = 0; i < FORMS; ++i) {
        answer out;
        /* Pictures are made in a context of their own. */
        t.call = forms[i].ask == show ? NULL : ask_same_query;
        for (int k = 0; k < SETS; ++k) {
            t.answered = CSTK_OK;
            CHECK_OK(forms[i].ask(&s, s.sets[k], &out));
            CHECK((t.answered == CSTK_ERROR_BUSY) == (t.call != NULL));
            /* It hands on what it was answered. */
            t.class_status = t.answered;
            CHECK_STATUS(forms[i].ask(&s, s.sets[k], &out),
                         t.call != NULL ? CSTK_ERROR_CALLBACK_FAILED : CSTK_OK);
            t.class_status = CSTK_OK;
        }
    }
    CHECK(remove(picture) == 0);
    t.call = ask_other_query;
    answers(&s, expected);
    CHECK(t.answered == CSTK_OK);
    t.call = NULL;
    answers(&s, expected);
    scene_release(&s);
    CHECK(t.destroyed == 1);
    fixture_unchanged(f);
}

/* A distance that the scale takes out of what a double holds. */
static void scaled_away(const fixture *f) {
    trick t = {0};
    const double distances[] = {DBL_MAX, 5e-324};
    const double scales[] = {2.0, 0.1};
    t.radius = 0.1;
    for (int i = 0; i < 2; ++i) {
        cstk_pure_options options;
        cstk_distance_result d;
        cstk_cobject *set = NULL;
        const cstk_predicate predicate = good_predicate(&t);
        CHECK_OK(cstk_pure_options_default(&options, sizeof options));
        options.scale = scales[i];
        CHECK_OK(cstk_cobject_predicate(f->space, &predicate, &options, &set));
        t.written_distance = &distances[i];
        const cstk_status status = cstk_distance(f->query, set, f->q, NQ, INFINITY, &d);
        if (status == CSTK_OK && (d.kind == CSTK_DISTANCE_EMPTY || d.distance == 0.0)) {
            fprintf(stderr, "distance %g, scale %g: kind %d, %g\n", distances[i], scales[i],
                    (int)d.kind, d.distance);
            ++check_failures;
        }
        t.written_distance = NULL;
        CHECK_OK(cstk_cobject_release(set));
    }
}

static cstk_cobject *dropped;

static void drop(trick *t) {
    t->call = NULL;
    CHECK_OK(cstk_cobject_release(dropped));
}

/* The function drops the last reference to its own set: the query ends well, and the set goes when
 * it is over. */
static void released_meanwhile(const fixture *f) {
    for (int i = 0; i < FORMS; ++i) {
        trick t = {0};
        scene s;
        answer out;
        t.radius = 0.1;
        const cstk_predicate predicate = good_predicate(&t);
        CHECK_OK(cstk_cobject_predicate(f->space, &predicate, NULL, &dropped));
        s.query = f->query;
        memcpy(s.q, f->q, sizeof s.q);
        t.call = drop;
        CHECK_OK(forms[i].ask(&s, dropped, &out));
        CHECK(t.destroyed == 1);
    }
    remove(picture);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    bad_predicates(&f);
    bad_functions(&f, 0.1);
    bad_functions(&f, 2.0);
    no_gradient(&f);
    calls_back(&f);
    scaled_away(&f);
    released_meanwhile(&f);
    fixture_release(&f);
    return check_result();
}
