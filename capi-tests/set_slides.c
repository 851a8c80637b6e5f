/* Slides along unions of pure sets and induced ones: closed forms for a plane, and ways that keep
 * clear of all parts. */
#include <math.h>

#include "check.h"
#include "cube.h"
#include "robots.h"

enum { NQ = CUBE_NQ };

static cstk_slide_options options_with(double max_shell) {
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = max_shell;
    options.desired_distance = 0.1 * max_shell;
    return options;
}

/* Along a plane at the desired distance only the part of a step is left that does not lead into it.
 */
static void along_a_plane(const cube *c) {
    const double normal[NQ] = {1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0};
    const cstk_slide_options options = options_with(0.5);
    double q[NQ];
    double reached[NQ];
    double expected[NQ];
    cstk_slide_result result;
    for (int i = 0; i < NQ; ++i) {
        q[i] = (-0.4 + options.desired_distance) * normal[i];
    }
    CHECK(fabs(leaf_distance(HALF_SPACE, q) - options.desired_distance) < 1e-14);
    const double steps[3][NQ] = {{-0.03, 0.0, 0.0}, {0.0, 0.02, -0.01}, {0.01, 0.0, 0.0}};
    for (int i = 0; i < 3; ++i) {
        double into = 0.0;
        for (int k = 0; k < NQ; ++k) {
            into += normal[k] * steps[i][k];
        }
        for (int k = 0; k < NQ; ++k) {
            expected[k] = q[k] + steps[i][k] - fmin(0.0, into) * normal[k];
        }
        CHECK_OK(cstk_slide(c->query, c->leaves[HALF_SPACE].set, q, NQ, steps[i], NQ, &options,
                            reached, &result));
        CHECK(result.outcome == CSTK_SLIDE_MOVED && near(reached, expected, NQ, 1e-6));
        CHECK(fabs(result.distance_before - 0.05) < 1e-14);
        CHECK(fabs(result.distance_after - leaf_distance(HALF_SPACE, reached)) < 1e-14);
    }
    const double straight[NQ] = {-0.1 * normal[0], -0.1 * normal[1], -0.1 * normal[2]};
    CHECK_OK(cstk_slide(c->query, c->leaves[HALF_SPACE].set, q, NQ, straight, NQ, &options, reached,
                        &result));
    CHECK(result.outcome == CSTK_SLIDE_BLOCKED && near(reached, q, NQ, 0.0));
    for (int k = 0; k < NQ; ++k) {
        q[k] -= 0.2 * normal[k];
    }
    CHECK_OK(cstk_slide(c->query, c->leaves[HALF_SPACE].set, q, NQ, straight, NQ, &options, reached,
                        &result));
    CHECK(result.outcome == CSTK_SLIDE_INSIDE && near(reached, q, NQ, 0.0));
}

static const int parts[] = {OBSTACLE, GROWN_OBSTACLE, LIMITS, WORLD, BALL, BOX, HALF_SPACE};

enum { PARTS = sizeof parts / sizeof parts[0] };

/* The distance of the union. */
static double clearance(const double *q) {
    double least = INFINITY;
    for (int i = 0; i < PARTS; ++i) {
        least = fmin(least, leaf_distance(parts[i], q));
    }
    return least;
}

/* Steps all over, from where the cube is free: the ways, which are straight, keep clear of all
 * parts. */
static void among_all(const cube *c) {
    const cstk_slide_options options = options_with(0.2);
    const cstk_cobject *sets[PARTS];
    cstk_cobject *all = NULL;
    double q[NQ] = {1.0, 1.2, 1.2};
    int moved = 0;
    int near_contact = 0;
    uint64_t state = 11;
    for (int i = 0; i < PARTS; ++i) {
        sets[i] = c->leaves[parts[i]].set;
    }
    CHECK_OK(cstk_cobject_union(sets, PARTS, &all));
    CHECK(clearance(q) > 0.0);
    for (int n = 0; n < 400; ++n) {
        double step[NQ];
        double reached[NQ];
        cstk_slide_result result;
        for (int k = 0; k < NQ; ++k) {
            /* The direction changes now and then. */
            state = n % 8 == 0 ? state * 6364136223846793005u + 1442695040888963407u : state;
            step[k] = 0.1 * ((double)((state >> (11 + 16 * k)) % 4096) / 2048.0 - 1.0);
        }
        CHECK_OK(cstk_slide(c->query, all, q, NQ, step, NQ, &options, reached, &result));
        CHECK(result.outcome != CSTK_SLIDE_INSIDE);
        CHECK(fabs(result.distance_before - clearance(q)) < 1e-13);
        CHECK(fabs(result.distance_after - clearance(reached)) < 1e-13);
        for (int i = 1; i <= 20; ++i) {
            double at[NQ];
            for (int k = 0; k < NQ; ++k) {
                at[k] = q[k] + (reached[k] - q[k]) * i / 20.0;
            }
            CHECK(clearance(at) > 0.0);
        }
        moved += result.outcome == CSTK_SLIDE_MOVED;
        near_contact += result.contact_count > 0;
        memcpy(q, reached, sizeof q);
    }
    CHECK(moved > 100 && near_contact > 100);
    CHECK_OK(cstk_cobject_release(all));
}

int main(void) {
    cube c;
    cube_create(&c);
    along_a_plane(&c);
    among_all(&c);
    cube_release(&c);
    return check_result();
}
