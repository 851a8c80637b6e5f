/* Hostile input to bodies and their builders. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

static void builder_create(const fixture *f) {
    cstk_body_builder *out;
    const uint32_t wrong[] = {0, 1, 4, UINT32_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_REFUSED(out, cstk_body_builder_create(wrong[i], &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "dimension");
    }
    CHECK_FAILS(cstk_body_builder_create(3, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

static void references(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_retain(bad->handle), bad->status, "builder");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_body_builder_release(bad->handle), bad->status, "builder");
        }
    }
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_FAILS(cstk_body_retain(bad->handle), bad->status, "body");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_body_release(bad->handle), bad->status, "body");
        }
    }
    fixture_unchanged(f);
}

typedef struct bad_points {
    double xyz[15];
    size_t count;
    cstk_status polygon;
    const char *culprit;
} bad_points;

static const bad_points polygons[] = {
    {{0}, 0, CSTK_ERROR_EMPTY, "polygon"},
    {{1, 2, 3}, 1, CSTK_ERROR_DEGENERATE, "polygon"},
    {{0, 0, 0, 1, 0, 0}, 2, CSTK_ERROR_DEGENERATE, "polygon"},
    {{1, 1, 1, 1, 1, 1, 1, 1, 1}, 3, CSTK_ERROR_DEGENERATE, "polygon"},
    {{0, 0, 0, 1, 0, 0, 2, 0, 0}, 3, CSTK_ERROR_DEGENERATE, "area"},
    {{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0}, 4, CSTK_ERROR_DEGENERATE, "vertices 1 and 2"},
    {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0}, 5, CSTK_ERROR_DEGENERATE, "vertices 4 and 0"},
    {{0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0}, 4, CSTK_ERROR_NOT_PLANAR, "vertex"},
    {{0, 0, 0, 2, 0, 0, 0.5, 0.5, 0, 0, 2, 0}, 4, CSTK_ERROR_NOT_CONVEX, "vertex 2"},
    {{0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0}, 4, CSTK_ERROR_NOT_CONVEX, "polygon"},
    /* A star of five points winds twice. */
    {{1, 0, 0, -0.809, 0.588, 0, 0.309, -0.951, 0, 0.309, 0.951, 0, -0.809, -0.588, 0},
     5,
     CSTK_ERROR_NOT_CONVEX,
     "polygon"},
    {{0, 0, 0, 1e200, 0, 0, 0, 1e200, 0}, 3, CSTK_ERROR_INVALID_ARGUMENT, "coordinate"},
};

static void add_polygon(const fixture *f) {
    cstk_body_builder *builder = f->body_builder;
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_polygon(bad->handle, square, 4, 0), bad->status,
                    "builder");
    }
    CHECK_FAILS(cstk_body_builder_add_polygon(builder, NULL, 4, 0), CSTK_ERROR_NULL_ARGUMENT, "xyz");
    CHECK_FAILS(cstk_body_builder_add_polygon(builder, square, SIZE_MAX, 0), CSTK_ERROR_WRONG_SIZE,
                "xyz");
    CHECK_FAILS(cstk_body_builder_add_polygon(builder, square, SIZE_MAX / 24 + 1, 0),
                CSTK_ERROR_WRONG_SIZE, "xyz");
    for (size_t i = 0; i < sizeof polygons / sizeof polygons[0]; ++i) {
        const bad_points *bad = &polygons[i];
        CHECK_FAILS(cstk_body_builder_add_polygon(builder, bad->xyz, bad->count, 0), bad->polygon,
                    bad->culprit);
    }
    for (int entry = 0; entry < 12; ++entry) {
        EACH_NOT_FINITE(i) {
            double xyz[12];
            memcpy(xyz, square, sizeof xyz);
            xyz[entry] = not_finite[i];
            CHECK_FAILS(cstk_body_builder_add_polygon(builder, xyz, 4, 0), CSTK_ERROR_NOT_FINITE,
                        "vertex");
        }
    }
    fixture_unchanged(f);
}

static void add_polyhedron(const fixture *f) {
    cstk_body_builder *builder = f->body_builder;
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_polyhedron(bad->handle, square, 4, 0), bad->status,
                    "builder");
    }
    CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, NULL, 4, 0), CSTK_ERROR_NULL_ARGUMENT, "xyz");
    CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, square, 0, 0), CSTK_ERROR_EMPTY, "polyhedron");
    CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, square, SIZE_MAX, 0), CSTK_ERROR_WRONG_SIZE,
                "xyz");
    const double huge[12] = {0, 0, 0, 1e200, 0, 0, 0, 1e200, 0, 0, 0, 1e200};
    CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, huge, 4, 0), CSTK_ERROR_INVALID_ARGUMENT,
                "polyhedron");
    for (int entry = 0; entry < 12; ++entry) {
        EACH_NOT_FINITE(i) {
            double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
            xyz[entry] = not_finite[i];
            CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, xyz, 4, 0), CSTK_ERROR_NOT_FINITE,
                        "polyhedron");
        }
    }
    fixture_unchanged(f);
}

/* In the plane all z are 0. */
static void planar_builder(const fixture *f) {
    cstk_body_builder *builder = NULL;
    cstk_body *body;
    double raised[12];
    const uint32_t face[4] = {0, 1, 2, 3};
    const uint32_t size = 4;
    memcpy(raised, square, sizeof raised);
    raised[8] = 1e-9;
    CHECK_OK(cstk_body_builder_create(2, &builder));
    CHECK_FAILS(cstk_body_builder_add_polygon(builder, raised, 4, 0), CSTK_ERROR_NOT_PLANAR, "vertex 2");
    CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, raised, 4, 0), CSTK_ERROR_NOT_PLANAR,
                "vertex 2");
    CHECK_FAILS(cstk_body_builder_add_mesh(builder, raised, 4, &size, 1, face, 4, NULL, NULL),
                CSTK_ERROR_NOT_PLANAR, "vertex 2");
    raised[8] = NAN;
    CHECK_FAILS(cstk_body_builder_add_polygon(builder, raised, 4, 0), CSTK_ERROR_NOT_FINITE, "vertex 2");
    CHECK_REFUSED(body, cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "body");
    CHECK_OK(cstk_body_builder_release(builder));
    fixture_unchanged(f);
}

static void add_mesh_arguments(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const uint32_t sizes[2] = {3, 3};
    const uint32_t too_long[2] = {3, 4};
    const uint32_t too_short[2] = {3, 2};
    const uint32_t huge[2] = {3, UINT32_MAX};
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_mesh(bad->handle, square, 4, sizes, 2, indices, 6, NULL,
                                               NULL),
                    bad->status, "builder");
    }
    CHECK_FAILS(cstk_body_builder_add_mesh(b, NULL, 4, sizes, 2, indices, 6, NULL, NULL),
                CSTK_ERROR_NULL_ARGUMENT, "vertices");
    CHECK_FAILS(cstk_body_builder_add_mesh(b, square, 4, sizes, 2, NULL, 6, NULL, NULL),
                CSTK_ERROR_NULL_ARGUMENT, "indices");
    const struct {
        size_t vertices;
        const uint32_t *sizes;
        size_t faces;
        size_t indices;
        const char *culprit;
    } wrong[] = {
        {4, sizes, 2, 5, "face 1"},          {4, sizes, 1, 6, "indices"},
        {4, too_long, 2, 6, "face 1"},       {4, too_short, 2, 6, "indices"},
        {4, huge, 2, 6, "face 1"},           {4, NULL, 2, 5, "face 1"},
        {4, NULL, 1, 6, "indices"},          {4, NULL, 7, 6, "face 2"},
        {SIZE_MAX, sizes, 2, 6, "vertices"}, {4, sizes, SIZE_MAX, 6, "face_sizes"},
        {4, sizes, 2, SIZE_MAX, "indices"},  {4, NULL, 2, SIZE_MAX, "indices"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_FAILS(cstk_body_builder_add_mesh(b, square, wrong[i].vertices, wrong[i].sizes,
                                               wrong[i].faces, indices, wrong[i].indices, NULL,
                                               NULL),
                    CSTK_ERROR_WRONG_SIZE, wrong[i].culprit);
    }
    fixture_unchanged(f);
}

/* Counts that agree with each other but not with any memory: refused before room is made for them.
 */
static void add_mesh_huge_counts(const fixture *f) {
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const size_t faces[] = {SIZE_MAX, SIZE_MAX / 3, SIZE_MAX / 8};
    for (int i = 0; i < 3; ++i) {
        CHECK_FAILS(cstk_body_builder_add_mesh(f->body_builder, square, 4, NULL, faces[i], indices,
                                               SIZE_MAX, NULL, NULL),
                    CSTK_ERROR_WRONG_SIZE, "ind");
    }
    fixture_unchanged(f);
}

static void add_mesh_geometry(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    const uint32_t beyond[6] = {0, 1, 2, 0, 2, 4};
    const uint32_t largest[3] = {0, 1, UINT32_MAX};
    const uint32_t good[3] = {0, 1, 2};
    CHECK_FAILS(cstk_body_builder_add_mesh(b, square, 4, NULL, 2, beyond, 6, NULL, NULL),
                CSTK_ERROR_NOT_FOUND, "face 1");
    CHECK_FAILS(cstk_body_builder_add_mesh(b, square, 4, NULL, 1, largest, 3, NULL, NULL),
                CSTK_ERROR_NOT_FOUND, "face 0");
    CHECK_FAILS(cstk_body_builder_add_mesh(b, NULL, 0, NULL, 1, good, 3, NULL, NULL),
                CSTK_ERROR_NOT_FOUND, "face 0");
    for (int entry = 0; entry < 9; ++entry) {
        EACH_NOT_FINITE(i) {
            double xyz[12];
            memcpy(xyz, square, sizeof xyz);
            xyz[entry] = not_finite[i];
            CHECK_FAILS(cstk_body_builder_add_mesh(b, xyz, 4, NULL, 1, good, 3, NULL, NULL),
                        CSTK_ERROR_NOT_FINITE, "face 0");
        }
    }
    /* The second face crosses itself: the first is not kept either. */
    const double outline[12] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 3, 0};
    const uint32_t crossing[7] = {0, 1, 2, 0, 2, 1, 3};
    const uint32_t sizes[2] = {3, 4};
    CHECK_FAILS(cstk_body_builder_add_mesh(b, outline, 4, sizes, 2, crossing, 7, NULL, NULL),
                CSTK_ERROR_NOT_CONVEX, "face 1");
    fixture_unchanged(f);
}

/* A bow tie crosses itself too, though the areas of its halves cancel. */
static void bow_tie(void) {
    const uint32_t face[4] = {0, 2, 1, 3};
    const uint32_t size = 4;
    cstk_body_builder *builder = NULL;
    cstk_body *body;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_FAILS(cstk_body_builder_add_mesh(builder, square, 4, &size, 1, face, 4, NULL, NULL),
                CSTK_ERROR_NOT_CONVEX, "face 0");
    CHECK_REFUSED(body, cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "body");
    CHECK_OK(cstk_body_builder_release(builder));
}

static void add_mesh_file(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_mesh_file(bad->handle, "missing.obj", NULL, NULL),
                    bad->status, "builder");
    }
    cstk_body_builder *b = f->body_builder;
    CHECK_FAILS(cstk_body_builder_add_mesh_file(b, NULL, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_body_builder_add_mesh_file(b, "", NULL, NULL), CSTK_ERROR_UNSUPPORTED, "obj");
    CHECK_FAILS(cstk_body_builder_add_mesh_file(b, "missing.xyz", NULL, NULL), CSTK_ERROR_UNSUPPORTED,
                "missing.xyz");
    CHECK_FAILS(cstk_body_builder_add_mesh_file(b, "missing.obj", NULL, NULL), CSTK_ERROR_IO,
                "missing.obj");
    CHECK_FAILS(cstk_body_builder_add_mesh_file(b, "missing \xff.stl", NULL, NULL), CSTK_ERROR_IO,
                "missing");
    fixture_unchanged(f);
}

/* Poses and scales of meshes, from arrays and from files. */
static void place_mesh(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    const uint32_t face[3] = {0, 1, 2};
    EACH_BAD_POSE(bad) {
        CHECK_FAILS(cstk_body_builder_add_mesh(b, square, 4, NULL, 1, face, 3, bad->pose, NULL),
                    bad->status, "pose");
        CHECK_FAILS(cstk_body_builder_add_mesh_file(b, "missing.obj", bad->pose, NULL),
                    bad->status, "pose");
    }
    const struct {
        double factor;
        cstk_status status;
    } wrong[] = {
        {0, CSTK_ERROR_INVALID_ARGUMENT},     {-0.0, CSTK_ERROR_INVALID_ARGUMENT},
        {1e-60, CSTK_ERROR_INVALID_ARGUMENT}, {-1e-300, CSTK_ERROR_INVALID_ARGUMENT},
        {1e60, CSTK_ERROR_INVALID_ARGUMENT},  {-1e300, CSTK_ERROR_INVALID_ARGUMENT},
        {NAN, CSTK_ERROR_NOT_FINITE},         {INFINITY, CSTK_ERROR_NOT_FINITE},
        {-INFINITY, CSTK_ERROR_NOT_FINITE},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            char culprit[] = "scale entry 0";
            double scale[3] = {1, 1, 1};
            scale[axis] = wrong[i].factor;
            culprit[12] = (char)('0' + axis);
            CHECK_FAILS(cstk_body_builder_add_mesh(b, square, 4, NULL, 1, face, 3, NULL, scale),
                        wrong[i].status, culprit);
        }
    }
    /* Each number is allowed, but not what comes of them. */
    const double far[9] = {1e30, 0, 0, 0, 1e30, 0, 0, 0, 1e30};
    const double large[3] = {1e30, 1e30, 1e30};
    CHECK_FAILS(cstk_body_builder_add_mesh(b, far, 3, NULL, 1, face, 3, NULL, large),
                CSTK_ERROR_INVALID_ARGUMENT, "face 0");
    /* Turned out of the plane. */
    const double tilted[12] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0};
    cstk_body_builder *planar = NULL;
    cstk_body *body;
    CHECK_OK(cstk_body_builder_create(2, &planar));
    CHECK_FAILS(cstk_body_builder_add_mesh(planar, square, 4, NULL, 1, face, 3, tilted, NULL),
                CSTK_ERROR_NOT_PLANAR, "vertex 2");
    CHECK_REFUSED(body, cstk_body_build(planar, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "body");
    CHECK_OK(cstk_body_builder_release(planar));
    fixture_unchanged(f);
}

static void build(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    cstk_body *out;
    cstk_hierarchy_options options;
    CHECK_OK(cstk_hierarchy_options_default(&options, sizeof options));
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_REFUSED(out, cstk_body_build(bad->handle, &options, never_called, NULL, &out), bad->status,
                      "builder");
    }
    CHECK_FAILS(cstk_body_build(b, &options, never_called, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    EACH_BAD_OPTIONS(options, bad) {
        CHECK_REFUSED(out, cstk_body_build(b, bad->options, never_called, NULL, &out), bad->status,
                      "options");
    }
    const uint32_t limits[] = {0, 1, 7};
    for (int i = 0; i < 3; ++i) {
        options.hull_vertex_limit = limits[i];
        CHECK_REFUSED(out, cstk_body_build(b, &options, never_called, NULL, &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "hull_vertex_limit");
    }
    cstk_body_builder *empty = NULL;
    CHECK_OK(cstk_body_builder_create(3, &empty));
    CHECK_REFUSED(out, cstk_body_build(empty, NULL, never_called, NULL, &out), CSTK_ERROR_EMPTY, "primitive");
    CHECK_OK(cstk_body_builder_release(empty));
    fixture_unchanged(f);
}

/* What is stated of a square shows in its statistics and in a distance, and what is refused changes nothing. */
static void set_deviation(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_set_deviation(bad->handle, 0.1), bad->status, "builder");
    }
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const double here[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const double pose[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1};
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    cstk_query *query = NULL;
    cstk_body_statistics s;
    cstk_distance_result d;
    cstk_depth_result depth;
    bool within;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 0));
    CHECK_OK(cstk_body_builder_set_deviation(builder, 0.1));
    CHECK_FAILS(cstk_body_builder_set_deviation(builder, -1e-300), CSTK_ERROR_INVALID_ARGUMENT, "deviation");
    CHECK_FAILS(cstk_body_builder_set_deviation(builder, 1e51), CSTK_ERROR_INVALID_ARGUMENT, "deviation");
    CHECK_FAILS(cstk_body_builder_set_deviation(builder, NAN), CSTK_ERROR_NOT_FINITE, "deviation");
    CHECK_FAILS(cstk_body_builder_set_deviation(builder, INFINITY), CSTK_ERROR_NOT_FINITE, "deviation");
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &s));
    CHECK(s.deviation == 0.1);
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_pair_distance(query, body, here, body, pose, INFINITY, &d));
    CHECK(fabs(d.distance - 0.8) < 1e-12 && d.lower <= 0.8 && d.upper >= 1.2 && d.upper < 1.2 + 1e-9);
    CHECK(d.has_contact && fabs(d.contact.distance - 0.8) < 1e-12 && d.r_point[2] == 0 && d.s_point[2] == 1);
    CHECK_OK(cstk_pair_within(query, body, here, body, pose, 0.81, &within));
    CHECK(within);
    CHECK_OK(cstk_pair_within(query, body, here, body, pose, 0.79, &within));
    CHECK(!within);
    CHECK_FAILS(cstk_pair_depth(query, body, here, body, here, NULL, &depth), CSTK_ERROR_UNSUPPORTED, "body_a");
    /* The largest there can be: nothing is proved apart. */
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_set_deviation(builder, 1e50));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_pair_distance(query, body, here, body, pose, INFINITY, &d));
    CHECK(d.distance == 0 && d.lower == 0 && d.upper >= 2e50 && isfinite(d.upper));
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    fixture_unchanged(f);
}

static void get_statistics(const fixture *f) {
    cstk_body_statistics out;
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_REFUSED(out, cstk_body_get_statistics(bad->handle, &out), bad->status, "body");
    }
    CHECK_FAILS(cstk_body_get_statistics(f->body, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

typedef struct vertices_out {
    double xyz[24];
    size_t count;
} vertices_out;

static void feature_vertices(const fixture *f) {
    vertices_out out;
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_REFUSED(
            out, cstk_body_get_feature_vertices(bad->handle, 0, CSTK_FEATURE_FACE, 0, 8, out.xyz, &out.count),
            bad->status, "body");
    }
    const struct {
        uint32_t primitive;
        int32_t kind;
        uint32_t feature;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {1, CSTK_FEATURE_FACE, 0, CSTK_ERROR_NOT_FOUND, "primitive 1"},
        {UINT32_MAX, CSTK_FEATURE_FACE, 0, CSTK_ERROR_NOT_FOUND, "primitive"},
        {0, -1, 0, CSTK_ERROR_INVALID_ARGUMENT, "kind"},
        {0, 5, 0, CSTK_ERROR_INVALID_ARGUMENT, "kind"},
        {0, CSTK_FEATURE_SURFACE, 0, CSTK_ERROR_NOT_FOUND, "Surface"},
        {0, CSTK_FEATURE_VERTEX, 8, CSTK_ERROR_NOT_FOUND, "8"},
        {0, CSTK_FEATURE_EDGE, 12, CSTK_ERROR_NOT_FOUND, "12"},
        {0, CSTK_FEATURE_FACE, 6, CSTK_ERROR_NOT_FOUND, "6"},
        {0, CSTK_FEATURE_FACE, UINT32_MAX, CSTK_ERROR_NOT_FOUND, "primitive 0"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_REFUSED(out,
                      cstk_body_get_feature_vertices(f->body, wrong[i].primitive, wrong[i].kind,
                                                 wrong[i].feature, 8, out.xyz, &out.count),
                      wrong[i].status, wrong[i].culprit);
    }
    CHECK_REFUSED(out, cstk_body_get_feature_vertices(f->body, 0, CSTK_FEATURE_FACE, 0, 8, NULL, &out.count),
                  CSTK_ERROR_NULL_ARGUMENT, "xyz");
    CHECK_REFUSED(out, cstk_body_get_feature_vertices(f->body, 0, CSTK_FEATURE_FACE, 0, 8, out.xyz, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "count");
    /* Room for fewer points than there are: no more than that is written, but all are counted. */
    memset(&out, CHECK_SENTINEL, sizeof out);
    CHECK_OK(cstk_body_get_feature_vertices(f->body, 0, CSTK_FEATURE_FACE, 0, 1, out.xyz, &out.count));
    CHECK(out.count == 4);
    check_untouched(out.xyz + 3, 21 * sizeof(double), "feature_vertices", __FILE__, __LINE__);
    CHECK_OK(cstk_body_get_feature_vertices(f->body, 0, CSTK_FEATURE_FACE, 0, 0, NULL, &out.count));
    CHECK(out.count == 4);
    fixture_unchanged(f);
}

static void get_primitive(const fixture *f) {
    cstk_primitive out;
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_REFUSED(out, cstk_body_get_primitive(bad->handle, 0, &out), bad->status, "body");
    }
    CHECK_REFUSED(out, cstk_body_get_primitive(f->body, 1, &out), CSTK_ERROR_NOT_FOUND, "primitive 1");
    CHECK_REFUSED(out, cstk_body_get_primitive(f->body, UINT32_MAX, &out), CSTK_ERROR_NOT_FOUND,
                  "primitive 4294967295");
    CHECK_FAILS(cstk_body_get_primitive(f->body, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    builder_create(&f);
    references(&f);
    add_polygon(&f);
    add_polyhedron(&f);
    planar_builder(&f);
    add_mesh_arguments(&f);
    add_mesh_geometry(&f);
    bow_tie();
    add_mesh_file(&f);
    place_mesh(&f);
    build(&f);
    set_deviation(&f);
    get_statistics(&f);
    feature_vertices(&f);
    get_primitive(&f);
    add_mesh_huge_counts(&f);
    fixture_release(&f);
    return check_result();
}
