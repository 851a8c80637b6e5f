/* Hierarchies of every grouping and wrapper: trees over all primitives, wrappers that hold what is
 * below them, levels and covers, statistics recomputed from the nodes; the same answers from any
 * tree. */
#include <math.h>

#include "bodies.h"
#include "check.h"
#include "fixture.h"
#include "hierarchy_checks.h"

/* A body to ask distances of, and every way to build it. */
static void same_answers(const cstk_body *one, const cstk_body *other, const cstk_body *probe) {
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    for (int i = 0; i < 12; ++i) {
        double pose[12];
        cstk_distance_result d[2];
        bool within[2];
        random_pose(i, 8.0, pose);
        pose[3] += 100.0;
        pose[7] -= 50.0;
        pose[11] += 20.0;
        const cstk_body *bodies[2] = {one, other};
        for (int k = 0; k < 2; ++k) {
            CHECK_OK(
                cstk_pair_distance(query, bodies[k], identity_pose, probe, pose, INFINITY, &d[k]));
            CHECK_OK(
                cstk_pair_within(query, bodies[k], identity_pose, probe, pose, 0.5, &within[k]));
        }
        CHECK(d[0].kind == CSTK_DISTANCE_EXACT && d[1].kind == CSTK_DISTANCE_EXACT && within[0] == within[1]);
        CHECK(within[0] == (d[0].distance <= 0.5));
        CHECK(memcmp(&d[0].distance, &d[1].distance, sizeof(double)) == 0);
        CHECK(memcmp(&d[0].lower, &d[1].lower, sizeof(double)) == 0);
        CHECK(memcmp(&d[0].upper, &d[1].upper, sizeof(double)) == 0);
        CHECK(memcmp(d[0].r_point, d[1].r_point, sizeof d[0].r_point) == 0);
        CHECK(memcmp(d[0].s_point, d[1].s_point, sizeof d[0].s_point) == 0);
        CHECK(d[0].witness.r_primitive == d[1].witness.r_primitive);
        CHECK(d[0].witness.s_primitive == d[1].witness.s_primitive);
        CHECK(d[0].witness.r_tag == d[1].witness.r_tag);
    }
    CHECK_OK(cstk_query_release(query));
}

/* Every grouping with every kind of wrapper, and then some options that change trees. */
static void every_kind(void) {
    cstk_body_builder *builder = mixed_builder();
    cstk_body_builder *rings = torus_builder(6, 4);
    cstk_body *first = build_body(builder, NULL);
    cstk_body *probe = build_body(rings, NULL);
    for (int32_t grouping = 0; grouping < GROUPINGS; ++grouping) {
        for (int32_t wrapper = 0; wrapper < WRAPPERS; ++wrapper) {
            cstk_hierarchy_options options = options_of(grouping, wrapper);
            cstk_body *body = build_body(builder, &options);
            check_body(body, &options);
            same_answers(first, body, probe);
            CHECK_OK(cstk_body_release(body));
            options.aspect_limit = 3.0;
            options.pieces = CSTK_PIECES_PATCHES;
            body = build_body(builder, &options);
            check_body(body, &options);
            same_answers(first, body, probe);
            CHECK_OK(cstk_body_release(body));
        }
    }
    for (int i = 0; i < 7; ++i) {
        cstk_hierarchy_options options = default_options();
        *(i < 3   ? &options.cost_diameter
          : i < 5 ? &options.diameter_limit
                  : &options.gap_limit) = i % 2 ? 0.1 : 4.0;
        options.hull_vertex_limit = i < 4 ? 8 : 1000;
        options.pieces = i % 3;
        cstk_body *body = build_body(builder, &options);
        check_body(body, &options);
        same_answers(first, body, probe);
        CHECK_OK(cstk_body_release(body));
    }
    CHECK_OK(cstk_body_release(first));
    CHECK_OK(cstk_body_release(probe));
    CHECK_OK(cstk_body_builder_release(rings));
    CHECK_OK(cstk_body_builder_release(builder));
}

/* Bodies of one leaf, of the same primitive many times, of the plane, of the largest coordinates.
 */
static void odd_bodies(void) {
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const double huge[12] = {-1e50, -1e50, 1e50, 1e50,  -1e50, 1e50,
                             1e50,  1e50,  1e50, -1e50, 1e50,  1e50};
    const double tiny[12] = {0, 0, 0, 1e-49, 0, 0, 1e-49, 1e-49, 0, 0, 1e-49, 0};
    for (int kind = 0; kind < 5; ++kind) {
        const double *points = kind < 3 ? square : kind == 3 ? huge : tiny;
        cstk_body_builder *builder = NULL;
        CHECK_OK(cstk_body_builder_create(kind == 2 ? 2 : 3, &builder));
        for (int i = 0; i < (kind == 0 ? 1 : 20); ++i) {
            CHECK_OK(cstk_body_builder_add_polyhedron(builder, points, kind == 1 ? 1 : 4, 7));
        }
        for (int32_t k = 0; k < GROUPINGS * WRAPPERS; ++k) {
            cstk_hierarchy_options options = options_of(k / WRAPPERS, k % WRAPPERS);
            options.cost_diameter = k % 2 ? 16.0 : 1.0;
            cstk_body *body = build_body(builder, &options);
            cstk_hierarchy_statistics s;
            tree t = read_tree(body);
            CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
            CHECK(t.count == (kind == 0 ? 1 : 39) && s.node_count == t.count);
            CHECK(isfinite(s.expected_cost) && s.expected_cost > 0.0);
            CHECK(isfinite(s.balance) && s.balance >= 1.0 && isfinite(s.fill) && s.fill >= 0.0);
            check_levels(body, &t, s.depth);
            check_covers(body, &t);
            free_tree(&t);
            CHECK_OK(cstk_body_release(body));
        }
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

int main(void) {
    every_kind();
    odd_bodies();
    return check_result();
}
