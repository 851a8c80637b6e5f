#include "workcell_report.h"

#include <math.h>
#include <stdio.h>

enum { MAX_PAIRS = 32, MAX_NAME = 64 };

const char *class_name(cstk_class where) {
    return where == CSTK_CLASS_INSIDE ? "INSIDE" : where == CSTK_CLASS_CONTACT ? "CONTACT" : "OUTSIDE";
}

/* The arm that a link of the space belongs to is asked for its name. */
static void link_name(const cell *c, uint32_t link, char name[MAX_NAME]) {
    int arm = arm_of(c, link);
    check(cstk_robot_get_link_name(c->arms[arm], link - c->first[arm].link, name, MAX_NAME, NULL));
}

static const char *object_name(const cell *c, uint64_t id) {
    for (int i = 0; i < OBJECTS; ++i) {
        if (c->ids[i] == id) {
            return object_names[i];
        }
    }
    return "an unknown s-object";
}

/* Joint i of an arm moves its link i + 1: the base is fixed. */
static void print_joint_beyond(const cell *c, const double q[NQ]) {
    bool within;
    uint32_t i;
    check(cstk_space_within_limits(c->space, q, NQ, &within, &i));
    if (!within) {
        int arm = i < c->first[RIGHT].coordinate ? LEFT : RIGHT;
        char name[MAX_NAME];
        check(cstk_robot_get_joint_name(c->arms[arm], i - c->first[arm].coordinate + SHOULDER, name,
                                    MAX_NAME, NULL));
        printf("%s at %.3f", name, q[i]);
    } else {
        printf("the nearest joint limit");
    }
}

static void print_pair(const cell *c, const double q[NQ], const cstk_witness *w) {
    char r[MAX_NAME], s[MAX_NAME];
    if (w->r_link == CSTK_NONE) { /* a pure set: here, that of the joint limits */
        print_joint_beyond(c, q);
        return;
    }
    link_name(c, w->r_link, r);
    if (w->s_link != CSTK_NONE) {
        link_name(c, w->s_link, s);
    }
    printf("%s and %s", r, w->s_link != CSTK_NONE ? s : object_name(c, w->s_object));
}

/* Several primitives of the same two things may meet; they are printed once. */
static bool same_pair(const cstk_witness *a, const cstk_witness *b) {
    return a->r_link == b->r_link && a->s_link == b->s_link && a->s_object == b->s_object;
}

/* The leaves that the class rests on. Returns whether they are the expected ones. */
static bool print_reasons(const cell *c, const double q[NQ], const cstk_explanation *why,
                          const expectation *expected) {
    bool good = true;
    for (size_t i = 0; i < why->leaf_count; ++i) {
        const cstk_verdict *leaf = &why->leaves[i];
        bool wanted = leaf->data == expected->reasons[0] || leaf->data == expected->reasons[1];
        good = good && leaf->decisive == wanted;
        if (!leaf->decisive) {
            continue;
        }
        printf("    %s:", (const char *)leaf->data);
        const cstk_witness *pairs = why->list.witnesses + leaf->first_witness;
        for (uint32_t k = 0; k < leaf->witness_count; ++k) {
            if (k == 0 || !same_pair(&pairs[k], &pairs[k - 1])) {
                printf(k == 0 ? " " : ", ");
                print_pair(c, q, &pairs[k]);
            }
        }
        printf("\n");
    }
    if (why->list.truncated) {
        printf("    and more pairs\n");
    }
    return good;
}

bool report(const cell *c, cstk_query *query, const cstk_cobject *set, const char *what,
            const double q[NQ], const expectation *expected) {
    cstk_distance_result d;
    check(cstk_distance(query, set, q, NQ, INFINITY, &d));
    cstk_explanation why;
    check(cstk_explain(query, set, q, NQ, MAX_PAIRS, &why));

    printf("%s: %s, distance %.4f", what, class_name(why.point_class), d.distance);
    if (d.has_witness) {
        printf(", ");
        print_pair(c, q, &d.witness);
    }
    printf("\n");
    bool good =
        why.point_class == expected->where && (d.distance == 0) == (expected->where == CSTK_CLASS_INSIDE);
    if (why.point_class != CSTK_CLASS_OUTSIDE) { /* there, it rests on all of them */
        good = print_reasons(c, q, &why, expected) && good;
    }
    if (!good) {
        printf("    THIS WAS TO BE %s", class_name(expected->where));
        for (int i = 0; i < MAX_REASONS && expected->reasons[i] != NULL; ++i) {
            printf("%s%s", i == 0 ? ": " : ", ", expected->reasons[i]);
        }
        printf("\n");
    }
    return good;
}
