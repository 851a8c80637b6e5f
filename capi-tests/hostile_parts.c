/* Hostile input to bodies that are put together of others, and to bodies with moved vertices. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

static cstk_body *square_body(uint32_t dimension) {
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_builder_create(dimension, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 7));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_builder_release(builder));
    return body;
}

static void handles(const fixture *f) {
    cstk_body_part part;
    cstk_body *body;
    size_t count;
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_body(bad->handle, f->body, NULL, 0), bad->status, "builder");
    }
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_FAILS(cstk_body_builder_add_body(f->body_builder, bad->handle, NULL, 0), bad->status,
                    "body");
        CHECK_REFUSED(part, cstk_body_get_part(bad->handle, 0, &part), bad->status, "body");
        CHECK_REFUSED(count, cstk_body_get_vertices(bad->handle, 0, NULL, &count), bad->status, "body");
        CHECK_REFUSED(body, cstk_body_refit(bad->handle, square, 4, &body), bad->status, "body");
    }
    CHECK_FAILS(cstk_body_get_part(f->body, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(part, cstk_body_get_part(f->body, 0, &part), CSTK_ERROR_NOT_FOUND, "part 0");
    CHECK_REFUSED(part, cstk_body_get_part(f->body, UINT32_MAX, &part), CSTK_ERROR_NOT_FOUND, "part");
    CHECK_FAILS(cstk_body_get_vertices(f->body, 0, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "count");
    CHECK_REFUSED(count, cstk_body_get_vertices(f->body, 1, NULL, &count), CSTK_ERROR_NULL_ARGUMENT,
                  "xyz");
    fixture_unchanged(f);
}

static void poses(const fixture *f) {
    EACH_BAD_POSE(bad) {
        CHECK_FAILS(cstk_body_builder_add_body(f->body_builder, f->body, bad->pose, 0), bad->status,
                    "pose");
    }
    cstk_body_builder *planar = NULL;
    cstk_body *flat = square_body(2);
    CHECK_OK(cstk_body_builder_create(2, &planar));
    CHECK_FAILS(cstk_body_builder_add_body(planar, f->body, NULL, 0), CSTK_ERROR_INVALID_ARGUMENT,
                "dimension");
    CHECK_FAILS(cstk_body_builder_add_body(f->body_builder, flat, NULL, 0),
                CSTK_ERROR_INVALID_ARGUMENT, "dimension");
    double up[12];
    translation(0, 0, 1, up);
    CHECK_FAILS(cstk_body_builder_add_body(planar, flat, up, 0), CSTK_ERROR_INVALID_ARGUMENT, "plane");
    CHECK_OK(cstk_body_release(flat));
    CHECK_OK(cstk_body_builder_release(planar));
    fixture_unchanged(f);
}

/* A square twice, far apart, and one added by itself: each answers by its part, also after the parts are released. */
static void parts(void) {
    cstk_body_builder *builder = NULL;
    cstk_body *flat = square_body(3);
    cstk_body *whole = NULL;
    cstk_query *query = NULL;
    double pose[12];
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_body(builder, flat, NULL, 41));
    CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 9));
    translation(10, 0, 0, pose);
    CHECK_OK(cstk_body_builder_add_body(builder, flat, pose, 42));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &whole));
    CHECK_OK(cstk_body_builder_release(builder));
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_get_statistics(whole, &statistics));
    CHECK(statistics.primitive_count == 3 && statistics.part_count == 2);
    cstk_body_part part;
    CHECK_OK(cstk_body_get_part(whole, 1, &part));
    CHECK(part.tag == 42 && part.first_primitive == 2 && part.primitive_count == 1);
    CHECK(part.pose[3] == 10 && part.pose[0] == 1);
    CHECK_REFUSED(part, cstk_body_get_part(whole, 2, &part), CSTK_ERROR_NOT_FOUND, "part 2");
    CHECK_OK(cstk_query_create(&query));
    double away[12];
    translation(10, 0, 2, away);
    cstk_distance_result found;
    CHECK_OK(cstk_pair_distance(query, whole, identity_pose, flat, away, INFINITY, &found));
    CHECK(fabs(found.distance - 2) < 1e-14);
    CHECK(found.witness.r_part == 1 && found.witness.s_part == CSTK_NONE);
    CHECK(found.witness.r_primitive == 2 && found.witness.r_tag == 7);
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_body_release(flat));
    CHECK_OK(cstk_body_release(whole));
}

static void refits(const fixture *f) {
    cstk_body *flat = square_body(3);
    cstk_body *planar = square_body(2);
    cstk_body *out;
    double xyz[12];
    size_t count = 0;
    CHECK_OK(cstk_body_get_vertices(flat, 4, xyz, &count));
    CHECK(count == 4 && memcmp(xyz, square, sizeof xyz) == 0);
    CHECK_FAILS(cstk_body_refit(flat, square, 4, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_body_refit(flat, NULL, 4, &out), CSTK_ERROR_NULL_ARGUMENT, "xyz");
    const size_t wrong[] = {0, 3, 5};
    for (int i = 0; i < 3; ++i) {
        double many[15] = {0};
        CHECK_REFUSED(out, cstk_body_refit(flat, many, wrong[i], &out), CSTK_ERROR_WRONG_SIZE,
                      "4 vertices");
    }
    CHECK_REFUSED(out, cstk_body_refit(flat, square, SIZE_MAX, &out), CSTK_ERROR_WRONG_SIZE, "xyz");
    for (int entry = 0; entry < 12; ++entry) {
        EACH_NOT_FINITE(i) {
            memcpy(xyz, square, sizeof xyz);
            xyz[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_body_refit(flat, xyz, 4, &out), CSTK_ERROR_NOT_FINITE,
                          "primitive 0");
        }
    }
    memcpy(xyz, square, sizeof xyz);
    xyz[8] = 0.1;
    CHECK_REFUSED(out, cstk_body_refit(flat, xyz, 4, &out), CSTK_ERROR_NOT_PLANAR, "primitive 0");
    CHECK_REFUSED(out, cstk_body_refit(planar, xyz, 4, &out), CSTK_ERROR_NOT_PLANAR, "vertex 2");
    memcpy(xyz, square, sizeof xyz);
    xyz[6] = 0.4;
    xyz[7] = 0.4;
    CHECK_REFUSED(out, cstk_body_refit(flat, xyz, 4, &out), CSTK_ERROR_NOT_CONVEX, "vertex 2");
    memset(xyz, 0, sizeof xyz);
    CHECK_REFUSED(out, cstk_body_refit(flat, xyz, 4, &out), CSTK_ERROR_DEGENERATE, "primitive 0");
    memcpy(xyz, square, sizeof xyz);
    xyz[3] = 1e200;
    CHECK_REFUSED(out, cstk_body_refit(flat, xyz, 4, &out), CSTK_ERROR_INVALID_ARGUMENT, "large");
    /* The fixture's body is a box, a polyhedron. */
    double corners[24];
    CHECK_OK(cstk_body_get_vertices(f->body, 8, corners, &count));
    CHECK(count == 8);
    for (int k = 0; k < 3; ++k) {
        double moved[24];
        memcpy(moved, corners, sizeof moved);
        moved[3 + k] *= 1.5;
        const cstk_status status = cstk_body_refit(f->body, moved, 8, &out);
        CHECK(status == CSTK_ERROR_NOT_PLANAR || status == CSTK_ERROR_NOT_CONVEX);
        for (int i = 0; i < 8; ++i) {
            moved[3 * i + k] = 0;
        }
        CHECK_REFUSED(out, cstk_body_refit(f->body, moved, 8, &out), CSTK_ERROR_DEGENERATE,
                      "primitive 0");
        for (int i = 0; i < 8; ++i) {
            moved[3 * i + k] = -corners[3 * i + k];
        }
        CHECK_REFUSED(out, cstk_body_refit(f->body, moved, 8, &out), CSTK_ERROR_NOT_CONVEX,
                      "primitive 0");
    }
    for (int i = 0; i < 24; ++i) {
        corners[i] = 2 * corners[i] + 1;
    }
    cstk_body *larger = NULL;
    CHECK_OK(cstk_body_refit(f->body, corners, 8, &larger));
    CHECK_OK(cstk_body_release(larger));
    CHECK_OK(cstk_body_release(flat));
    CHECK_OK(cstk_body_release(planar));
    fixture_unchanged(f);
}

/* The faces of a solid may move, but not apart. */
static void solids(void) {
    static const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    cstk_body_builder *builder = NULL;
    cstk_body *solid = NULL;
    cstk_body *out;
    double all[36];
    size_t count = 0;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_mesh(builder, xyz, 4, NULL, 4, faces, 12, NULL, NULL));
    CHECK_OK(cstk_body_builder_set_solid(builder, true));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &solid));
    CHECK_OK(cstk_body_builder_release(builder));
    CHECK_OK(cstk_body_get_vertices(solid, 12, all, &count));
    CHECK(count == 12);
    all[0] -= 0.1;
    CHECK_REFUSED(out, cstk_body_refit(solid, all, 12, &out), CSTK_ERROR_NOT_CLOSED, "primitive");
    CHECK_OK(cstk_body_release(solid));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    handles(&f);
    poses(&f);
    parts();
    refits(&f);
    solids();
    fixture_release(&f);
    return check_result();
}
