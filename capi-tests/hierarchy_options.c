/* Options that give primitives more leaves, or join several to one piece: slender ones under a
 * limit of aspect, convex pieces. */
#include <math.h>

#include "bodies.h"
#include "check.h"
#include "fixture.h"
#include "hierarchy_checks.h"

enum { PLANKS = 6 };

/* Planks of 40 by 1/2, side by side along x or y. */
static cstk_body_builder *plank_builder(int along) {
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    for (int i = 0; i < PLANKS; ++i) {
        double xyz[12];
        for (int k = 0; k < 4; ++k) {
            xyz[3 * k + along] = k == 1 || k == 2 ? 20.0 : -20.0;
            xyz[3 * k + 1 - along] = i - 3.0 + (k >= 2 ? 0.5 : 0.0);
            xyz[3 * k + 2] = 0.0;
        }
        CHECK_OK(cstk_body_builder_add_polygon(builder, xyz, 4, (uint64_t)i));
    }
    return builder;
}

/* Every plank of one body crosses every plank of the other at a distance of 1. */
static void witnesses(const cstk_body *a, const cstk_body *b, size_t max_count) {
    double above[12];
    int met[PLANKS][PLANKS] = {{0}};
    cstk_witness_list list;
    cstk_query *query = NULL;
    translation(0, 0, 1, above);
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_pair_witnesses(query, a, identity_pose, b, above, 1.25, max_count, &list));
    const size_t all = PLANKS * PLANKS;
    CHECK(list.witness_count == (max_count < all ? max_count : all));
    CHECK(list.truncated == (max_count < all));
    for (size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness *w = &list.witnesses[i];
        CHECK(w->r_primitive < PLANKS && w->s_primitive < PLANKS);
        CHECK(w->r_tag == w->r_primitive && w->s_tag == w->s_primitive);
        CHECK(met[w->r_primitive][w->s_primitive]++ == 0);
        CHECK(fabs(w->distance - 1.0) < 1e-13 && w->contact_count == 4);
    }
    CHECK_OK(cstk_pair_witnesses(query, a, identity_pose, b, above, 0.75, max_count, &list));
    CHECK(list.witness_count == 0);
    CHECK_OK(cstk_query_release(query));
}

/* How far a point lies outside a node's wrapper or sphere, as far as that can be seen in some
 * directions. */
static double outside(const tree *t, size_t node, const double *point) {
    const cstk_hierarchy_node *n = &t->nodes[node];
    double out = apart(point, n->center) - n->radius;
    for (int k = 0; k < DIRECTIONS; ++k) {
        const double *along = direction(k);
        const double own = reach(&t->corners[3 * t->first[node]], n->corner_count, along);
        out = larger(out, dot(point, along) - own - n->excess);
    }
    return out;
}

/* Every point of a slender primitive lies in the wrapper of one of its leaves, all of which are
 * shorter than it. */
static void check_slabs(const cstk_body *body, uint32_t plank) {
    tree t = read_tree(body);
    double xyz[3 * 64];
    CHECK(primitive_vertices(body, plank, xyz) == 4);
    for (int k = 0; k <= 60; ++k) {
        const double u = k / 60.0;
        const double v = (k % 7) / 6.0;
        double point[3];
        double least = INFINITY;
        for (int axis = 0; axis < 3; ++axis) {
            point[axis] = xyz[axis] + u * (xyz[3 + axis] - xyz[axis]);
            point[axis] += v * (xyz[9 + axis] - xyz[axis]);
        }
        for (size_t i = 0; i < t.count; ++i) {
            if (is_leaf(&t, i) && t.nodes[i].primitive == plank) {
                CHECK(t.nodes[i].radius < 4.0);
                least = smaller(least, outside(&t, i, point));
            }
        }
        CHECK(least <= 1e-12);
    }
    free_tree(&t);
}

static void slender(void) {
    const double limits[] = {0.0, 1.5, 2.0, 10.0, 79.0, 1e300};
    cstk_body_builder *builders[2] = {plank_builder(0), plank_builder(1)};
    for (int32_t k = 0; k < GROUPINGS * WRAPPERS; ++k) {
        /* Every wrapper of the first grouping, the first wrapper of every other. */
        for (int i = 0; i < 6 && (k < WRAPPERS || k % WRAPPERS == 0); ++i) {
            cstk_hierarchy_options options = options_of(k / WRAPPERS, k % WRAPPERS);
            cstk_hierarchy_statistics s;
            cstk_body *bodies[2];
            options.aspect_limit = limits[i];
            for (int side = 0; side < 2; ++side) {
                bodies[side] = build_body(builders[side], &options);
            }
            CHECK_OK(cstk_body_get_hierarchy_statistics(bodies[0], &s));
            /* Their length is 80 times their width. */
            const int cut = limits[i] > 0.0 && limits[i] < 80.0;
            if (cut ? s.leaf_count <= PLANKS : s.leaf_count != PLANKS) {
                fprintf(stderr, "aspect_limit %g: %d planks of aspect 80 have %d leaves\n",
                        limits[i], PLANKS, (int)s.leaf_count);
                ++check_failures;
            }
            witnesses(bodies[0], bodies[1], SIZE_MAX);
            witnesses(bodies[0], bodies[1], 10);
            if (cut && s.leaf_count > PLANKS && k < WRAPPERS) {
                check_slabs(bodies[0], (uint32_t)i);
                check_body(bodies[0], &options);
            }
            CHECK_OK(cstk_body_release(bodies[0]));
            CHECK_OK(cstk_body_release(bodies[1]));
        }
    }
    CHECK_OK(cstk_body_builder_release(builders[0]));
    CHECK_OK(cstk_body_builder_release(builders[1]));
}

/* A square cut into sixteen, and the six faces of a cube: convex pieces of the body. */
static void pieces(void) {
    for (int32_t kind = CSTK_PIECES_OFF; kind <= CSTK_PIECES_PATCHES; ++kind) {
        cstk_body_builder *builder = NULL;
        cstk_hierarchy_options options = default_options();
        cstk_hierarchy_statistics s;
        CHECK_OK(cstk_body_builder_create(3, &builder));
        for (int i = 0; i < 16; ++i) {
            const double x = i % 4;
            const double y = i / 4;
            const double cell[12] = {x, y, 0, x + 1, y, 0, x + 1, y + 1, 0, x, y + 1, 0};
            CHECK_OK(cstk_body_builder_add_polygon(builder, cell, 4, 0));
        }
        options.pieces = kind;
        cstk_body *body = build_body(builder, &options);
        check_body(body, &options);
        CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
        if ((s.piece_count > 0) != (kind != CSTK_PIECES_OFF)) {
            fprintf(stderr, "pieces %d: %d pieces of a square cut into sixteen\n", (int)kind,
                    (int)s.piece_count);
            ++check_failures;
        }
        CHECK_OK(cstk_body_release(body));
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

int main(void) {
    slender();
    pieces();
    return check_result();
}
