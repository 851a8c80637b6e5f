/* Data that C-objects carry: handed back with answers, given back once and not too early; and the
 * numbers by which leaves are named. */
#include <math.h>

#include "check.h"
#include "cube.h"
#include "fixture.h"

enum { NQ = CUBE_NQ };

static const double origin[NQ] = {0.0, 0.0, 0.0};

static void count(void *user) { ++*(int *)user; }

static void *data_of(const cstk_cobject *set) {
    void *data = &data;
    CHECK_OK(cstk_cobject_get_data(set, &data, NULL));
    return data;
}

static uint64_t number_of(const cstk_cobject *set) {
    uint64_t number = 0;
    CHECK_OK(cstk_cobject_get_data(set, NULL, &number));
    CHECK(number != 0);
    return number;
}

static cstk_cobject *with_data(const cstk_cobject *set, void *data, cstk_destroy_fn destroy) {
    cstk_cobject *out = NULL;
    CHECK_OK(cstk_cobject_with_data(set, data, destroy, &out));
    CHECK(out != set && data_of(out) == data && number_of(out) != number_of(set));
    return out;
}

static cstk_cobject *ball(const cube *c) {
    cstk_cobject *out = NULL;
    cstk_pure_options options;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    options.scale = 1.0;
    CHECK_OK(cstk_cobject_ball(c->space, origin, NQ, 0.5, &options, &out));
    return out;
}

/* The one leaf of the set names itself so, in all answers. */
static void expect_leaf(const cube *c, const cstk_cobject *set, uint64_t number, void *data) {
    const double q[NQ] = {1.1, 1.2, 1.3};
    cstk_distance_result d;
    cstk_witness_list list;
    cstk_explanation why;
    CHECK_OK(cstk_distance(c->query, set, q, NQ, INFINITY, &d));
    CHECK(d.has_witness && d.witness.cobject == number && d.witness.cobject_data == data);
    CHECK_OK(cstk_witnesses(c->query, set, q, NQ, 100.0, 16, &list));
    CHECK(list.witness_count > 0);
    for (size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness *w = &list.witnesses[i];
        CHECK(w->cobject == number && w->cobject_data == data && w->r_object == 0);
    }
    CHECK_OK(cstk_explain(c->query, set, q, NQ, 16, &why));
    CHECK(why.leaf_count == 1);
    CHECK(why.leaves[0].cobject == number && why.leaves[0].data == data);
}

/* Leaves hand their data back, and sets made of others those of their leaves. */
static void handed_back(const cube *c) {
    int marks[3] = {0};
    cstk_cobject *round = ball(c);
    const cstk_cobject *plain[2] = {round, c->leaves[GROWN_OBSTACLE].set};
    for (int i = 0; i < 2; ++i) {
        cstk_cobject *whole = NULL;
        CHECK(data_of(plain[i]) == NULL);
        expect_leaf(c, plain[i], number_of(plain[i]), NULL);
        cstk_cobject *marked = with_data(plain[i], &marks[0], NULL);
        expect_leaf(c, marked, number_of(marked), &marks[0]);
        /* The one it was made of stays as it is. */
        expect_leaf(c, plain[i], number_of(plain[i]), NULL);
        cstk_cobject *other = with_data(marked, &marks[1], NULL);
        expect_leaf(c, other, number_of(other), &marks[1]);
        expect_leaf(c, marked, number_of(marked), &marks[0]);
        cstk_cobject *none = with_data(marked, NULL, NULL);
        expect_leaf(c, none, number_of(none), NULL);
        /* A set made of others is no leaf: its own data come from nowhere but itself. */
        const cstk_cobject *part = other;
        CHECK_OK(cstk_cobject_union(&part, 1, &whole));
        CHECK(data_of(whole) == NULL && number_of(whole) != number_of(other));
        expect_leaf(c, whole, number_of(other), &marks[1]);
        cstk_cobject *marked_whole = with_data(whole, &marks[2], NULL);
        expect_leaf(c, marked_whole, number_of(other), &marks[1]);
        cstk_cobject *all[] = {marked, other, none, whole, marked_whole};
        for (int k = 0; k < 5; ++k) {
            CHECK_OK(cstk_cobject_release(all[k]));
        }
    }
    CHECK_OK(cstk_cobject_release(round));
}

/* Pairs of bodies are of no C-object. */
static void of_bodies(const cube *c) {
    double there[12];
    cstk_distance_result d;
    translation(3.0, 0.0, 0.0, there);
    CHECK_OK(cstk_pair_distance(c->query, c->body, identity_pose, c->body, there, INFINITY, &d));
    CHECK(d.has_witness && d.witness.cobject == 0 && d.witness.cobject_data == NULL);
    CHECK(d.witness.r_data == NULL && d.witness.s_data == NULL && d.witness.r_object == 0);
}

enum { MARKED, COMPLEMENT, SAME, INTERSECTION, UNION, HOLDERS };

/* Data are given back once, with the last of the sets that have the leaf, whichever that is. */
static void destroyed_last(const cube *c, const cstk_cobject *plain) {
    for (int last = 0; last < HOLDERS; ++last) {
        int destroyed = 0;
        cstk_distance_result d;
        cstk_cobject *all[HOLDERS];
        all[MARKED] = with_data(plain, &destroyed, count);
        CHECK_OK(cstk_cobject_complement(all[MARKED], &all[COMPLEMENT]));
        CHECK_OK(cstk_cobject_complement(all[COMPLEMENT], &all[SAME]));
        const cstk_cobject *parts[2] = {all[MARKED], c->leaves[GROWN_OBSTACLE].set};
        CHECK_OK(cstk_cobject_intersection(parts, 2, &all[INTERSECTION]));
        CHECK_OK(cstk_cobject_union(parts, 2, &all[UNION]));
        CHECK_OK(cstk_cobject_retain(all[last]));
        for (int i = 1; i <= HOLDERS; ++i) {
            CHECK_OK(cstk_cobject_release(all[(last + i) % HOLDERS]));
            CHECK(destroyed == 0);
        }
        CHECK_OK(cstk_distance(c->query, all[last], origin, NQ, INFINITY, &d));
        CHECK_OK(cstk_cobject_release(all[last]));
        CHECK(destroyed == 1);
        CHECK_FAILS(cstk_cobject_release(all[last]), CSTK_ERROR_WRONG_HANDLE, "cobject");
        CHECK(destroyed == 1);
    }
}

/* Each call that attached data gives its own back, also where the address is NULL. */
static int nulls_destroyed;

static void count_null(void *user) {
    CHECK(user == NULL);
    ++nulls_destroyed;
}

static void destroyed_each(const cube *c) {
    int counts[2] = {0};
    cstk_cobject *plain = c->leaves[GROWN_OBSTACLE].set;
    cstk_cobject *first = with_data(plain, &counts[0], count);
    cstk_cobject *second = with_data(first, &counts[1], count);
    cstk_cobject *again = with_data(first, &counts[0], count);
    cstk_cobject *null = with_data(plain, NULL, count_null);
    CHECK_OK(cstk_cobject_release(first));
    CHECK(counts[0] == 1 && counts[1] == 0);
    CHECK_OK(cstk_cobject_release(second));
    CHECK(counts[0] == 1 && counts[1] == 1);
    CHECK_OK(cstk_cobject_release(again));
    CHECK(counts[0] == 2 && counts[1] == 1);
    CHECK(nulls_destroyed == 0);
    CHECK_OK(cstk_cobject_release(null));
    CHECK(nulls_destroyed == 1);
}

/* A query keeps nothing: data go with the last set, whatever was asked about it. */
static void not_kept_by_queries(const cube *c) {
    int destroyed = 0;
    cstk_explanation why;
    cstk_cobject *marked = with_data(c->leaves[OBSTACLE].set, &destroyed, count);
    CHECK_OK(cstk_explain(c->query, marked, origin, NQ, 16, &why));
    CHECK(why.leaf_count == 1 && why.leaves[0].data == &destroyed);
    CHECK_OK(cstk_cobject_release(marked));
    CHECK(destroyed == 1 && why.leaves[0].data == &destroyed);
}

typedef struct keeper {
    cstk_cobject *kept;
    int destroyed;
} keeper;

static void let_go(void *user) {
    keeper *k = user;
    CHECK_OK(cstk_cobject_release(k->kept));
    ++k->destroyed;
}

static int32_t nowhere(const double *q, size_t nq, int32_t *out, void *user) {
    (void)q, (void)nq, (void)user;
    *out = CSTK_CLASS_OUTSIDE;
    return CSTK_OK;
}

/* Data may hold objects of the library, and release them when they go: here one set holds the next,
 * and the last is a predicate with data of its own. */
static void destroy_calls_back(const cube *c) {
    enum { CHAIN = 5 };
    int destroyed = 0;
    keeper keepers[CHAIN];
    cstk_predicate predicate;
    cstk_cobject *held = NULL;
    CHECK_OK(cstk_predicate_default(&predicate, sizeof predicate));
    predicate.classify = nowhere;
    predicate.user = &destroyed;
    predicate.destroy = count;
    CHECK_OK(cstk_cobject_predicate(c->space, &predicate, NULL, &held));
    for (int i = 0; i < CHAIN; ++i) {
        keepers[i] = (keeper){held, 0};
        held = with_data(c->leaves[i].set, &keepers[i], let_go);
    }
    CHECK(destroyed == 0);
    CHECK_OK(cstk_cobject_release(held));
    for (int i = 0; i < CHAIN; ++i) {
        CHECK(keepers[i].destroyed == 1);
    }
    CHECK(destroyed == 1);
}

int main(void) {
    cube c;
    cube_create(&c);
    handed_back(&c);
    of_bodies(&c);
    cstk_cobject *round = ball(&c);
    destroyed_last(&c, round);
    destroyed_last(&c, c.leaves[OBSTACLE].set);
    CHECK_OK(cstk_cobject_release(round));
    destroyed_each(&c);
    not_kept_by_queries(&c);
    destroy_calls_back(&c);
    cube_release(&c);
    return check_result();
}
