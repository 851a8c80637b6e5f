/* Clouds of points through the C interface: what they take, their features and tags, their nodes as several threads first
 * look at them, and files.
 */
#include <math.h>
#include <pthread.h>
#include <stdio.h>

#include "bodies.h"
#include "check.h"
#include "fixture.h"

enum { POINTS = 3000, LOOKERS = 4 };

static const double RADIUS = 0.01;

/* Points on a wavy sheet, and some again. */
static double *sheet(void) {
    double *xyz = malloc(3 * POINTS * sizeof *xyz);
    CHECK(xyz != NULL);
    for (int i = 0; i < POINTS; ++i) {
        const int k = i % 50 == 49 ? i - 1 : i;
        const double x = 0.04 * (k % 50), y = 0.04 * (k / 50);
        const double point[3] = {x, y, 5.0 + 0.2 * sin(3.0 * x) * cos(2.0 * y)};
        memcpy(xyz + 3 * i, point, sizeof point);
    }
    return xyz;
}

static cstk_body *cloud_of(const double *xyz, const cstk_hierarchy_options *options) {
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_points(builder, xyz, POINTS, RADIUS));
    cstk_body *body = build_body(builder, options);
    CHECK_OK(cstk_body_builder_release(builder));
    return body;
}

static uint64_t memory_of(const cstk_body *body) {
    cstk_hierarchy_statistics s;
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
    CHECK(s.leaf_count == POINTS && s.node_count == 2 * POINTS - 1 && s.piece_count == 0);
    CHECK(s.depth <= 2 * log2(POINTS));
    return s.memory_bytes;
}

static void *look(void *given) {
    tree *seen = malloc(sizeof *seen);
    CHECK(seen != NULL);
    *seen = read_tree(given);
    return seen;
}

/* Little memory until somebody looks at nodes; all who look at once see the same. */
static void nodes(const double *xyz) {
    cstk_body *body = cloud_of(xyz, NULL);
    cstk_body_statistics s;
    CHECK_OK(cstk_body_get_statistics(body, &s));
    CHECK(s.primitive_count == POINTS && s.piece_count == POINTS && s.node_count == 2 * POINTS - 1);
    CHECK(close_to(s.low[0], -RADIUS, 1e-15) && close_to(s.high[0], 0.04 * 48 + RADIUS, 1e-15));
    CHECK(memory_of(body) < 100 * POINTS);
    cstk_hierarchy_node node;
    CHECK_FAILS(cstk_body_get_node(body, 2 * POINTS - 1, &node), CSTK_ERROR_NOT_FOUND, "5999");
    CHECK(memory_of(body) < 100 * POINTS);
    pthread_t threads[LOOKERS];
    tree *seen[LOOKERS];
    for (int i = 0; i < LOOKERS; ++i) {
        CHECK(pthread_create(&threads[i], NULL, look, body) == 0);
    }
    for (int i = 0; i < LOOKERS; ++i) {
        void *found = NULL;
        CHECK(pthread_join(threads[i], &found) == 0);
        seen[i] = found;
    }
    for (int i = 0; i < LOOKERS; ++i) {
        CHECK(same_trees(seen[0], seen[i]));
    }
    CHECK(memory_of(body) > 300 * POINTS);
    /* Each leaf bounds its point. */
    for (size_t i = 0; i < seen[0]->count; ++i) {
        if (is_leaf(seen[0], i)) {
            const cstk_hierarchy_node *leaf = &seen[0]->nodes[i];
            const double off = apart(leaf->center, xyz + 3 * leaf->primitive);
            CHECK(off < 1e-12 && leaf->radius >= RADIUS && leaf->radius < 2 * RADIUS);
        }
    }
    uint32_t cover[10];
    size_t count = 0;
    CHECK_OK(cstk_body_get_cover_nodes(body, 10, cover, &count));
    CHECK(count == 10);
    cstk_level_statistics level;
    CHECK_OK(cstk_body_get_level_statistics(body, 3, &level));
    CHECK(level.node_count == 8 && level.volume > 0);
    cstk_mesh *mesh = NULL;
    CHECK_OK(cstk_mesh_create_from_nodes(body, cover, count, &mesh));
    CHECK_OK(cstk_mesh_release(mesh));
    for (int i = 0; i < LOOKERS; ++i) {
        free_tree(seen[i]);
        free(seen[i]);
    }
    CHECK_OK(cstk_body_release(body));
}

/* A cloud answers the same however it is built, and after it was in a file. */
static void answers(const double *xyz) {
    cstk_hierarchy_options basic = options_of(CSTK_GROUPING_BASIC, CSTK_WRAPPER_ALIGNED_BOX);
    cstk_hierarchy_options spheres = options_of(CSTK_GROUPING_TOP_DOWN, CSTK_WRAPPER_TIGHT_SPHERE);
    cstk_body *bodies[4] = {cloud_of(xyz, NULL), cloud_of(xyz, &basic), cloud_of(xyz, &spheres),
                            NULL};
    const char *file = "clouds_test.cstk";
    CHECK_OK(cstk_body_save(bodies[0], file));
    CHECK_OK(cstk_body_load(file, &bodies[3]));
    CHECK(remove(file) == 0);
    for (uint32_t i = 0; i < POINTS; i += 77) {
        for (int k = 0; k < 4; ++k) {
            double point[3];
            size_t count = 0;
            CHECK_OK(cstk_body_get_feature_vertices(bodies[k], i, CSTK_FEATURE_VERTEX, 0, 1, point, &count));
            CHECK(count == 1 && apart(point, xyz + 3 * i) < 1e-14);
            CHECK_FAILS(cstk_body_get_feature_vertices(bodies[k], i, CSTK_FEATURE_FACE, 0, 1, point, &count),
                        CSTK_ERROR_NOT_FOUND, "primitive");
        }
    }
    double point[3];
    size_t count = 0;
    CHECK_FAILS(
        cstk_body_get_feature_vertices(bodies[0], POINTS, CSTK_FEATURE_VERTEX, 0, 1, point, &count),
        CSTK_ERROR_NOT_FOUND, "3000");
    cstk_body *box = make_box(0.1, 0.2, 0.15);
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    for (int i = 0; i < 100; ++i) {
        double pose[12];
        random_pose(i, 2.0, pose);
        pose[11] += 5.0;
        cstk_distance_result found[4];
        for (int k = 0; k < 4; ++k) {
            memset(&found[k], 0, sizeof found[k]);
            CHECK_OK(cstk_pair_distance(query, box, pose, bodies[k], identity_pose, INFINITY,
                                        &found[k]));
            CHECK(found[k].distance == found[0].distance);
            CHECK(found[k].witness.s_tag == found[0].witness.s_tag);
            CHECK(found[k].witness.s_tag == found[k].witness.s_primitive);
        }
    }
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_body_release(box));
    for (int k = 0; k < 4; ++k) {
        CHECK_OK(cstk_body_release(bodies[k]));
    }
}

int main(void) {
    double *xyz = sheet();
    nodes(xyz);
    answers(xyz);
    free(xyz);
    return check_result();
}
