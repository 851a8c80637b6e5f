/* A cube that only shifts, so that lengths in C-space are lengths in the world; and a set of every
 * kind with its closed form.
 */
#ifndef CSTK_TESTS_CUBE_H
#define CSTK_TESTS_CUBE_H

#include <cstk.h>

enum { CUBE_NQ = 3, CUBE_LINK = 2 };

enum {
    OBSTACLE,
    GROWN_OBSTACLE,
    LIMITS,
    WORLD,
    BALL,
    BOX,
    HALF_SPACE,
    POLE, /* a predicate: an upright cylinder */
    LEAVES
};

typedef struct leaf {
    cstk_cobject *set;
    uint64_t number;
    /* What it hands back; NULL of every other one. */
    void *data;
} leaf;

typedef struct cube {
    cstk_body *body;
    cstk_body *obstacle_body;
    cstk_robot *robot;
    cstk_space *space;
    cstk_environment *environments[2];
    uint64_t objects[2];
    cstk_query *query;
    leaf leaves[LEAVES];
} cube;

void cube_create(cube *c);
void cube_release(const cube *c);

/* The distance, where it is positive; inside, minus the depth where that is known, and otherwise at
 * most 0. */
double leaf_distance(int leaf, const double *q);

/* Its derivative along one coordinate by central differences; false where it has a kink. */
bool leaf_slope(int leaf, const double *q, int k, double *out);

cstk_class leaf_class(int leaf, const double *q);

/* Whether it is a pure set. */
bool leaf_is_pure(int leaf);

/* Whether the distance from its complement is known inside. */
bool leaf_knows_depth(int leaf);

#endif
