/* What the primitives of a body are, one of every kind, and where their vertices are. */
#include <math.h>

#include "check.h"

enum { TAG = 1000, MAX_VERTICES = 8 };

static const double middle[3] = {1, 2, 3};
static const double end[3] = {4, 2, 3};
static const double square[12] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
static const double pyramid[15] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 1};
static const double pose[12] = {1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7};

typedef struct expected {
    cstk_primitive_kind kind;
    uint32_t vertices;
    uint32_t edges;
    uint32_t faces;
    double radius;
    /* Where the vertices are, in no order. */
    const double *xyz;
} expected;

static const expected table[] = {
    {CSTK_PRIMITIVE_POINT, 1, 0, 0, 0, middle},
    {CSTK_PRIMITIVE_SEGMENT, 2, 1, 0, 0, NULL},
    {CSTK_PRIMITIVE_POLYGON, 4, 4, 1, 0, square},
    {CSTK_PRIMITIVE_POLYHEDRON, 5, 8, 5, 0, pyramid},
    {CSTK_PRIMITIVE_SPHERE, 1, 0, 0, 0.25, middle},
    {CSTK_PRIMITIVE_POINT, 1, 0, 0, 0, middle},
    {CSTK_PRIMITIVE_CAPSULE, 2, 1, 0, 0.5, NULL},
    {CSTK_PRIMITIVE_ROUNDED_POLYGON, 4, 4, 1, 0.75, square},
    {CSTK_PRIMITIVE_ROUNDED_POLYHEDRON, 5, 8, 5, 0.125, pyramid},
    {CSTK_PRIMITIVE_POLYHEDRON, 8, 12, 6, 0, NULL},
    {CSTK_PRIMITIVE_CYLINDER, 0, 0, 0, 0, NULL},
    {CSTK_PRIMITIVE_CONE, 0, 0, 0, 0, NULL},
    {CSTK_PRIMITIVE_ELLIPSOID, 0, 0, 0, 0, NULL},
    {CSTK_PRIMITIVE_SUPPORT_FUNCTION, 0, 0, 0, 0, NULL},
};

enum { KINDS = sizeof table / sizeof table[0] };

/* The unit ball. */
static int32_t support(const double *direction, double *point, void *user) {
    (void)user;
    memcpy(point, direction, 3 * sizeof *point);
    return 0;
}

static cstk_body *build(void) {
    const double segment[6] = {middle[0], middle[1], middle[2], end[0], end[1], end[2]};
    const double half[3] = {1, 2, 3};
    cstk_body_builder *b = NULL;
    cstk_body *body = NULL;
    uint64_t tag = TAG;
    CHECK_OK(cstk_body_builder_create(3, &b));
    CHECK_OK(cstk_body_builder_add_polyhedron(b, middle, 1, tag++));
    CHECK_OK(cstk_body_builder_add_polyhedron(b, segment, 2, tag++));
    CHECK_OK(cstk_body_builder_add_polygon(b, square, 4, tag++));
    CHECK_OK(cstk_body_builder_add_polyhedron(b, pyramid, 5, tag++));
    CHECK_OK(cstk_body_builder_add_sphere(b, middle, 0.25, tag++));
    CHECK_OK(cstk_body_builder_add_sphere(b, middle, 0, tag++));
    CHECK_OK(cstk_body_builder_add_capsule(b, middle, end, 0.5, tag++));
    CHECK_OK(cstk_body_builder_add_rounded_polygon(b, square, 4, 0.75, tag++));
    CHECK_OK(cstk_body_builder_add_rounded_polyhedron(b, pyramid, 5, 0.125, tag++));
    CHECK_OK(cstk_body_builder_add_box(b, pose, half, tag++));
    CHECK_OK(cstk_body_builder_add_cylinder(b, pose, 1, 2, tag++));
    CHECK_OK(cstk_body_builder_add_cone(b, pose, 1, 2, tag++));
    CHECK_OK(cstk_body_builder_add_ellipsoid(b, pose, half, tag++));
    CHECK_OK(cstk_body_builder_add_support(b, support, NULL, NULL, tag++));
    CHECK_OK(cstk_body_build(b, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_builder_release(b));
    return body;
}

/* The vertices are read back one by one and all at once. */
static void check_vertices(const cstk_body *body, uint32_t index, const expected *e) {
    double all[3 * MAX_VERTICES];
    size_t count = 0;
    CHECK_OK(cstk_body_get_feature_vertices(body, index, CSTK_FEATURE_INTERIOR, 0, MAX_VERTICES, all, &count));
    CHECK(count == e->vertices);
    for (uint32_t v = 0; v < e->vertices; ++v) {
        double xyz[3];
        CHECK_OK(cstk_body_get_feature_vertices(body, index, CSTK_FEATURE_VERTEX, v, 1, xyz, &count));
        CHECK(count == 1 && memcmp(xyz, all + 3 * v, sizeof xyz) == 0);
        int found = 0;
        for (uint32_t i = 0; e->xyz != NULL && i < e->vertices; ++i) {
            const double *given = e->xyz + 3 * i;
            found += fabs(given[0] - xyz[0]) + fabs(given[1] - xyz[1]) + fabs(given[2] - xyz[2]) <
                     1e-14;
        }
        CHECK(e->xyz == NULL || found == 1);
    }
    CHECK_STATUS(
        cstk_body_get_feature_vertices(body, index, CSTK_FEATURE_FACE, e->faces, 0, NULL, &count),
        CSTK_ERROR_NOT_FOUND);
}

int main(void) {
    cstk_body *body = build();
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    CHECK(statistics.primitive_count == KINDS);
    for (uint32_t i = 0; i < KINDS; ++i) {
        const expected *e = &table[i];
        cstk_primitive p;
        CHECK_OK(cstk_body_get_primitive(body, i, &p));
        CHECK(p.kind == e->kind && p.radius == e->radius && p.tag == TAG + i);
        CHECK(p.vertex_count == e->vertices && p.edge_count == e->edges &&
              p.face_count == e->faces);
        if (e->vertices > 0) {
            check_vertices(body, i, e);
        }
    }
    CHECK_OK(cstk_body_release(body));
    return check_result();
}
