/* Sets by functions of the caller: one that imitates a ball is answered alike, whatever of it is
 * known; functions that ask the library themselves; and several threads that ask one set. */
#include <math.h>
#include <pthread.h>

#include "check.h"
#include "cube.h"
#include "robots.h"

enum { NQ = CUBE_NQ };

/* A ball by functions, and a count of the calls that gave it back. */
typedef struct sphere {
    double center[NQ];
    double radius;
    double epsilon;
    int destroyed;
} sphere;

static const sphere any_sphere = {{0.3, -0.2, 0.1}, 0.9, 0.2, 0};

static int32_t sphere_distance(const double *q, size_t nq, double *out, void *user) {
    const sphere *r = user;
    CHECK(nq == NQ);
    const double offset[3] = {q[0] - r->center[0], q[1] - r->center[1], q[2] - r->center[2]};
    *out = length_of(offset, 3) - r->radius;
    return CSTK_OK;
}

static int32_t sphere_class(const double *q, size_t nq, int32_t *out, void *user) {
    const sphere *r = user;
    double away;
    CHECK(sphere_distance(q, nq, &away, user) == CSTK_OK);
    *out = away <= 0.0 ? CSTK_CLASS_INSIDE : away <= r->epsilon ? CSTK_CLASS_CONTACT : CSTK_CLASS_OUTSIDE;
    return CSTK_OK;
}

static int32_t sphere_gradient(const double *q, size_t nq, double *row, size_t nv, void *user) {
    const sphere *r = user;
    double away;
    CHECK(nv == NQ && sphere_distance(q, nq, &away, user) == CSTK_OK);
    for (int i = 0; i < NQ; ++i) {
        row[i] = (q[i] - r->center[i]) / (away + r->radius);
    }
    return CSTK_OK;
}

static void sphere_destroy(void *user) { ++((sphere *)user)->destroyed; }

static cstk_predicate predicate_of(sphere *r) {
    cstk_predicate p;
    CHECK_OK(cstk_predicate_default(&p, sizeof p));
    p.classify = sphere_class;
    p.distance = sphere_distance;
    p.gradient = sphere_gradient;
    p.user = r;
    p.destroy = sphere_destroy;
    p.knows_depth = 1;
    return p;
}

static cstk_pure_options options_of(const sphere *r, double scale) {
    cstk_pure_options options;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    options.contact_epsilon = r->epsilon;
    options.scale = scale;
    return options;
}

static uint64_t random_state = 5;

static void random_configuration(double q[NQ]) {
    for (int i = 0; i < NQ; ++i) {
        random_state = random_state * 6364136223846793005u + 1442695040888963407u;
        q[i] = 1.7 * ((double)(random_state >> 11) / 4503599627370496.0 - 1.0);
    }
}

static bool close(double a, double b) { return a == b || fabs(a - b) < 1e-14; }

static void same_answers(const cube *c, const cstk_cobject *a, const cstk_cobject *b,
                         const double *q) {
    const cstk_cobject *sets[2] = {a, b};
    cstk_pseudo_normal_result found[2];
    double rows[2][NQ];
    bool within[2];
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_pseudo_normal(c->query, sets[i], q, NQ, 100.0, 16, false, &found[i]));
        CHECK(found[i].list.contact_count == 1 && found[i].list.nv == NQ);
        memcpy(rows[i], found[i].list.gradients, sizeof rows[i]);
        CHECK(found[i].list.contacts[0].mode == CSTK_MODE_PURE_SET);
        CHECK_OK(cstk_within(c->query, sets[i], q, NQ, 0.5, &within[i]));
    }
    CHECK(found[0].point_class == found[1].point_class && within[0] == within[1]);
    CHECK(found[0].distance.kind == found[1].distance.kind);
    CHECK(close(found[0].distance.distance, found[1].distance.distance));
    CHECK(close(found[0].distance.contact.clearance, found[1].distance.contact.clearance));
    CHECK(near(rows[0], rows[1], NQ, 1e-14));
}

/* All that is known of a ball is known of its imitation. */
static void imitate(const cube *c, double scale) {
    sphere r = any_sphere;
    cstk_cobject *sets[4];
    cstk_predicate p = predicate_of(&r);
    const cstk_pure_options options = options_of(&r, scale);
    CHECK_OK(cstk_cobject_ball(c->space, r.center, NQ, r.radius, &options, &sets[0]));
    CHECK_OK(cstk_cobject_predicate(c->space, &p, &options, &sets[1]));
    /* It was copied. */
    memset(&p, CHECK_SENTINEL, sizeof p);
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_cobject_complement(sets[i], &sets[2 + i]));
    }
    for (int i = 0; i < 200; ++i) {
        double q[NQ];
        random_configuration(q);
        same_answers(c, sets[0], sets[1], q);
        same_answers(c, sets[2], sets[3], q);
    }
    CHECK_OK(cstk_cobject_release(sets[1]));
    CHECK(r.destroyed == 0);
    CHECK_OK(cstk_cobject_release(sets[3]));
    CHECK(r.destroyed == 1);
    CHECK_OK(cstk_cobject_release(sets[0]));
    CHECK_OK(cstk_cobject_release(sets[2]));
}

/* What is to be said of a set at one configuration. */
typedef struct expected {
    cstk_distance_kind kind;
    double distance;
    double upper;
    size_t witnesses;
    size_t contacts;
} expected;

static void expect(const cube *c, const cstk_cobject *set, const double *q, expected e) {
    cstk_distance_result d;
    cstk_witness_list list;
    bool within = false;
    CHECK_OK(cstk_distance(c->query, set, q, NQ, INFINITY, &d));
    CHECK(d.kind == e.kind && close(d.distance, e.distance) && close(d.upper, e.upper));
    CHECK(close(d.lower, e.distance) && d.lower <= d.distance && d.has_witness);
    CHECK(d.has_contact == (e.contacts > 0));
    CHECK_OK(cstk_witnesses(c->query, set, q, NQ, 100.0, 16, &list));
    CHECK(list.witness_count == e.witnesses && list.contact_count == e.contacts);
    CHECK(e.witnesses == 0 || list.witnesses[0].overlapping == (e.contacts == 0));
    for (int i = 0; i < 2; ++i) {
        const double threshold = i == 0 ? 0.9 * e.distance : 1.1 * e.distance;
        CHECK_OK(cstk_within(c->query, set, q, NQ, threshold, &within));
        CHECK(within == (i == 1 || e.distance == 0.0));
    }
}

/* Less is known, and less is said; never more. */
static void less_known(const cube *c) {
    sphere r = any_sphere;
    const cstk_pure_options options = options_of(&r, 2.0);
    for (int part = 0; part < 3; ++part) {
        cstk_cobject *set = NULL;
        cstk_cobject *complement = NULL;
        cstk_predicate p = predicate_of(&r);
        if (part == 0) {
            p.distance_is_bound = 1;
        } else if (part == 1) {
            p.knows_depth = 0;
        } else {
            p.distance = NULL;
        }
        CHECK_OK(cstk_cobject_predicate(c->space, &p, &options, &set));
        CHECK_OK(cstk_cobject_complement(set, &complement));
        for (int i = 0; i < 100; ++i) {
            double q[NQ];
            double away;
            random_configuration(q);
            CHECK(sphere_distance(q, NQ, &away, &r) == CSTK_OK);
            away *= options.scale;
            const bool inside = away <= 0.0;
            /* Where only the class is known, contact is neither in nor out. */
            const bool is_doubtful = part == 2 && away <= options.scale * r.epsilon;
            const expected here = {CSTK_DISTANCE_EXACT, 0.0, 0.0, 1, part == 0};
            const expected is_known = {CSTK_DISTANCE_EXACT, fabs(away), fabs(away), 1, 1};
            const expected is_bound = {CSTK_DISTANCE_LOWER_BOUND, fabs(away), INFINITY, 1, 1};
            const expected unknown = {CSTK_DISTANCE_LOWER_BOUND, 0.0, INFINITY, 0, 0};
            const expected far[3] = {is_bound, is_known, unknown};
            const expected deep[3] = {is_known, unknown, unknown};
            expect(c, set, q, inside ? here : far[part]);
            /* Deep in the complement is as far from the set, where that is known. */
            const expected beyond = {CSTK_DISTANCE_EXACT, 0.0, 0.0, 1, part == 1};
            expect(c, complement, q, inside || is_doubtful ? deep[part] : beyond);
        }
        CHECK_OK(cstk_cobject_release(set));
        CHECK_OK(cstk_cobject_release(complement));
        CHECK(r.destroyed == part + 1);
    }
}

/* What the functions say of classes holds, whatever the contact epsilon. */
static void own_contact(const cube *c) {
    sphere r = any_sphere;
    cstk_class point_class;
    cstk_explanation why;
    cstk_cobject *set = NULL;
    cstk_predicate p = predicate_of(&r);
    const double q[NQ] = {r.center[0] + r.radius + 0.1, r.center[1], r.center[2]};
    CHECK_OK(cstk_cobject_predicate(c->space, &p, NULL, &set));
    CHECK_OK(cstk_classify(c->query, set, q, NQ, &point_class));
    CHECK_OK(cstk_explain(c->query, set, q, NQ, 16, &why));
    CHECK(point_class == CSTK_CLASS_CONTACT && why.point_class == CSTK_CLASS_CONTACT && why.leaf_count == 1);
    CHECK(why.leaves[0].leaf_class == CSTK_CLASS_CONTACT && why.leaves[0].decisive);
    CHECK_OK(cstk_cobject_release(set));
}

/* Asks another set of the library, in a context of its own. */
static int32_t ask_library(const double *q, size_t nq, int32_t *out, void *user) {
    const cube *c = user;
    cstk_query *query = NULL;
    cstk_class answered;
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_classify(query, c->leaves[OBSTACLE].set, q, nq, &answered));
    CHECK_OK(cstk_query_release(query));
    *out = answered;
    return CSTK_OK;
}

static void asks_the_library(cube *c) {
    cstk_predicate p;
    cstk_cobject *set = NULL;
    CHECK_OK(cstk_predicate_default(&p, sizeof p));
    p.classify = ask_library;
    p.user = c;
    CHECK_OK(cstk_cobject_predicate(c->space, &p, NULL, &set));
    for (int i = 0; i < 50; ++i) {
        double q[NQ];
        cstk_class point_class;
        random_configuration(q);
        CHECK_OK(cstk_classify(c->query, set, q, NQ, &point_class));
        CHECK(point_class == leaf_class(OBSTACLE, q));
    }
    CHECK_OK(cstk_cobject_release(set));
}

enum { THREADS = 2, QUERIES = 300 };

typedef struct shared {
    cube *c;
    cstk_cobject *set;
    double q[QUERIES][NQ];
    double numbers[QUERIES][2 + NQ];
} shared;

typedef struct worker {
    pthread_t thread;
    const shared *s;
    int number;
    int failures;
} worker;

static void ask(const shared *s, cstk_query *query, int i, double numbers[2 + NQ]) {
    cstk_pseudo_normal_result all;
    CHECK_OK(cstk_pseudo_normal(query, s->set, s->q[i], NQ, 100.0, 16, false, &all));
    CHECK(all.list.contact_count > 0);
    numbers[0] = (double)all.point_class;
    numbers[1] = all.distance.distance;
    memcpy(&numbers[2], all.list.gradients, NQ * sizeof(double));
}

/* Asks from the other end than the other, and drops a reference. */
static void *compare(void *user) {
    worker *w = user;
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    for (int n = 0; n < QUERIES; ++n) {
        double numbers[2 + NQ];
        const int i = w->number == 0 ? n : QUERIES - 1 - n;
        ask(w->s, query, i, numbers);
        w->failures += memcmp(numbers, w->s->numbers[i], sizeof numbers) != 0;
    }
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_cobject_release(w->s->set));
    return NULL;
}

/* Two threads ask a union with a predicate, and whichever is the last gives its data back. */
static void two_threads(cube *c) {
    static shared s;
    sphere r = any_sphere;
    worker workers[THREADS];
    cstk_cobject *set = NULL;
    const cstk_predicate p = predicate_of(&r);
    const cstk_pure_options options = options_of(&r, 1.0);
    memset(workers, 0, sizeof workers);
    s.c = c;
    CHECK_OK(cstk_cobject_predicate(c->space, &p, &options, &set));
    const cstk_cobject *parts[2] = {set, c->leaves[OBSTACLE].set};
    CHECK_OK(cstk_cobject_union(parts, 2, &s.set));
    CHECK_OK(cstk_cobject_release(set));
    for (int i = 0; i < QUERIES; ++i) {
        random_configuration(s.q[i]);
        ask(&s, c->query, i, s.numbers[i]);
    }
    CHECK_OK(cstk_cobject_retain(s.set));
    for (int i = 0; i < THREADS; ++i) {
        workers[i].s = &s;
        workers[i].number = i;
        CHECK(pthread_create(&workers[i].thread, NULL, compare, &workers[i]) == 0);
    }
    for (int i = 0; i < THREADS; ++i) {
        CHECK(pthread_join(workers[i].thread, NULL) == 0);
        CHECK(workers[i].failures == 0);
    }
    CHECK(r.destroyed == 1);
}

int main(void) {
    cube c;
    cube_create(&c);
    imitate(&c, 0.0);
    imitate(&c, 2.5);
    less_known(&c);
    own_contact(&c);
    asks_the_library(&c);
    two_threads(&c);
    cube_release(&c);
    return check_result();
}
