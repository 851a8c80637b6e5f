/* Curved surfaces and solids, with bad handles, numbers and boundaries. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void add_bezier_patch(const fixture *f) {
    const double sheet[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5};
    const double weights[4] = {1, 1, 1, 2};
    const double spoilt[4] = {1, 1, 0, 2};
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_bezier_patch(bad->handle, 1, 1, sheet, weights, 4, 0.01, 0), bad->status,
                    "builder");
    }
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    cstk_body_statistics s;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 1, NULL, NULL, 4, 0.01, 0),
                CSTK_ERROR_NULL_ARGUMENT, "xyz");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 1, sheet, NULL, 3, 0.01, 0), CSTK_ERROR_WRONG_SIZE,
                "patch (primitive 0)");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, UINT32_MAX, 1, sheet, NULL, 4, 0.01, 0),
                CSTK_ERROR_INVALID_ARGUMENT, "degree_u");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 0, sheet, NULL, 4, 0.01, 0),
                CSTK_ERROR_INVALID_ARGUMENT, "degree_v");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 1, sheet, spoilt, 4, 0.01, 0),
                CSTK_ERROR_INVALID_ARGUMENT, "weight 2");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 1, sheet, NULL, 4, 0, 0),
                CSTK_ERROR_INVALID_ARGUMENT, "tolerance");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 1, sheet, NULL, 4, NAN, 0), CSTK_ERROR_NOT_FINITE,
                "tolerance");
    CHECK_FAILS(cstk_body_builder_add_bezier_patch(builder, 1, 1, sheet, NULL, 4, 1e-300, 0), CSTK_ERROR_LIMIT,
                "tolerance");
    CHECK_FAILS(cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "primitive");
    CHECK_OK(cstk_body_builder_add_bezier_patch(builder, 1, 1, sheet, weights, 4, 0.01, 3));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &s));
    CHECK(s.primitive_count > 2 && s.deviation > 0 && s.deviation <= 0.01 && s.high[2] == 0.5);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    fixture_unchanged(f);
}

static void add_nurbs_surface(const fixture *f) {
    /* 3 x 2 control points, two spans in u. */
    const double sheet[18] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5, 2, 0, 0, 2, 1, 0};
    const double weights[6] = {1, 1, 1, 2, 1, 1};
    const double spoilt[6] = {1, 1, 1, 2, -1, 1};
    const double u[5] = {0, 0, 1, 2, 2}, v[4] = {0, 0, 1, 1};
    const double falling[5] = {0, 0, 1, 0.5, 2}, unknown[4] = {0, 0, NAN, 1}, empty[4] = {0, 1, 1, 2};
    const double torn[6] = {0, 0, 1, 1, 2, 2};
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_nurbs_surface(bad->handle, 1, 1, u, 5, v, 4, sheet, 6, weights, 0.01, 0),
                    bad->status, "builder");
    }
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    cstk_body_statistics s;
    CHECK_OK(cstk_body_builder_create(3, &builder));
#define FAILS(degree_u, degree_v, u, nu, v, nv, xyz, count, weights, tolerance, status, culprit)                            \
    CHECK_FAILS(cstk_body_builder_add_nurbs_surface(builder, degree_u, degree_v, u, nu, v, nv, xyz, count, weights,    \
                                                    tolerance, 0),                                                     \
                status, culprit)
    FAILS(1, 1, NULL, 5, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_NULL_ARGUMENT, "knots_u");
    FAILS(1, 1, u, 5, NULL, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_NULL_ARGUMENT, "knots_v");
    FAILS(1, 1, u, 5, v, 4, NULL, 6, NULL, 0.01, CSTK_ERROR_NULL_ARGUMENT, "control_points");
    FAILS(1, 1, u, SIZE_MAX, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "knots_u");
    FAILS(1, 1, u, 5, v, SIZE_MAX / 4, sheet, 6, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "knots_v");
    FAILS(1, 1, u, 5, v, 4, sheet, SIZE_MAX / 2, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "control_points");
    FAILS(1, 1, NULL, 0, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "knots_u");
    FAILS(1, 1, u, 3, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "knots_u");
    FAILS(1, 1, u, 5, v, 4, sheet, 5, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "surface (primitive 0)");
    FAILS(1, 1, u, 5, v, 4, NULL, 0, NULL, 0.01, CSTK_ERROR_WRONG_SIZE, "control points");
    FAILS(0, 1, u, 5, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "degree_u");
    FAILS(1, UINT32_MAX, u, 5, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "degree_v");
    FAILS(1, 1, falling, 5, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "knots_u: knot 3");
    FAILS(1, 1, u, 5, unknown, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_NOT_FINITE, "knots_v: knot 2");
    FAILS(1, 1, u, 5, empty, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "knots_v: knots 1 and 2");
    FAILS(1, 1, torn, 6, v, 4, sheet, 6, NULL, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "knots_u: knots 2 to 3");
    FAILS(1, 1, u, 5, v, 4, sheet, 6, spoilt, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "weight 4");
    FAILS(1, 1, u, 5, v, 4, sheet, 6, NULL, 0, CSTK_ERROR_INVALID_ARGUMENT, "tolerance");
    FAILS(1, 1, u, 5, v, 4, sheet, 6, NULL, NAN, CSTK_ERROR_NOT_FINITE, "tolerance");
    FAILS(1, 1, u, 5, v, 4, sheet, 6, NULL, 1e-300, CSTK_ERROR_LIMIT, "tolerance");
#undef FAILS
    CHECK_FAILS(cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "primitive");
    CHECK_OK(cstk_body_builder_add_nurbs_surface(builder, 1, 1, u, 5, v, 4, sheet, 6, weights, 0.01, 3));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &s));
    CHECK(s.primitive_count > 4 && s.deviation > 0 && s.deviation <= 0.01 && s.high[0] == 2 && s.high[2] == 0.5);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    fixture_unchanged(f);
}

static void set_solid(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_set_solid(bad->handle, true), bad->status, "builder");
    }
    /* A tetrahedron without its last face, then with it. */
    const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    cstk_body_builder *builder = NULL;
    cstk_body *out;
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_mesh(builder, corners, 4, NULL, 3, faces, 9, NULL, NULL));
    CHECK_OK(cstk_body_builder_set_solid(builder, true));
    CHECK_REFUSED(out, cstk_body_build(builder, NULL, never_called, NULL, &out), CSTK_ERROR_NOT_CLOSED,
                  "3 edges are open: the edge from (0, 1, 0) to (1, 0, 0) of primitive 0 (tag 0)");
    CHECK_OK(cstk_body_builder_add_mesh(builder, corners, 4, NULL, 1, faces + 9, 3, NULL, NULL));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    cstk_body_statistics s;
    CHECK_OK(cstk_body_get_statistics(body, &s));
    CHECK(s.solid && s.piece_count == 1 && s.primitive_count == 4);
    CHECK_OK(cstk_body_release(body));
    /* As a surface it may be anything. */
    CHECK_OK(cstk_body_builder_add_mesh(builder, corners, 4, NULL, 1, faces, 3, NULL, NULL));
    CHECK_REFUSED(out, cstk_body_build(builder, NULL, never_called, NULL, &out), CSTK_ERROR_NOT_CLOSED,
                  "primitive 4 (tag 0)");
    CHECK_OK(cstk_body_builder_set_solid(builder, false));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &s));
    CHECK(!s.solid && s.piece_count == 1 && s.primitive_count == 5);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    fixture_unchanged(f);
}

/* A cube in a cube: inside, and said to be. */
static void solid_around(const fixture *f) {
    const uint32_t faces[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    const uint32_t sizes[6] = {4, 4, 4, 4, 4, 4};
    const double pose[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const double halves[2] = {0.2, 1.0};
    cstk_body *cubes[2];
    for (int k = 0; k < 2; ++k) {
        cstk_body_builder *builder = NULL;
        double corners[24];
        for (int i = 0; i < 24; ++i) {
            corners[i] = (i / 3) >> (i % 3) & 1 ? halves[k] : -halves[k];
        }
        CHECK_OK(cstk_body_builder_create(3, &builder));
        CHECK_OK(cstk_body_builder_add_mesh(builder, corners, 8, sizes, 6, faces, 24, NULL, NULL));
        CHECK_OK(cstk_body_builder_set_solid(builder, k == 1));
        CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &cubes[k]));
        CHECK_OK(cstk_body_builder_release(builder));
    }
    cstk_query *query = NULL;
    cstk_distance_result d;
    cstk_witness_list list;
    cstk_penetration_list penetrations;
    bool within = false;
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_pair_distance(query, cubes[0], pose, cubes[1], pose, INFINITY, &d));
    CHECK(d.kind == CSTK_DISTANCE_EXACT && d.distance == 0 && d.lower == 0 && !d.has_contact);
    CHECK(d.has_witness && d.witness.contained && d.witness.overlapping);
    CHECK(memcmp(d.r_point, d.s_point, sizeof d.r_point) == 0 && fabs(d.r_point[0]) == 0.2);
    CHECK_OK(cstk_pair_within(query, cubes[1], pose, cubes[0], pose, 0, &within));
    CHECK(within);
    CHECK_OK(cstk_pair_witnesses(query, cubes[0], pose, cubes[1], pose, 0.5, 99, &list));
    CHECK(list.witness_count == 1 && list.witnesses[0].contained && list.contact_count == 0);
    CHECK_OK(cstk_pair_penetration(query, cubes[0], pose, cubes[1], pose, 99, &penetrations));
    CHECK(penetrations.count == 0);
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_body_release(cubes[0]));
    CHECK_OK(cstk_body_release(cubes[1]));
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    add_bezier_patch(&f);
    add_nurbs_surface(&f);
    set_solid(&f);
    solid_around(&f);
    fixture_release(&f);
    return check_result();
}
