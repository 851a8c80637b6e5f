/* Hostile input to ready-made shapes, point clouds, height fields and support functions. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static const double origin[3] = {0, 0, 0};
static const double one[3] = {1, 1, 1};
static const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

static const struct {
    double value;
    cstk_status status;
} bad_sizes[] = {
    {NAN, CSTK_ERROR_NOT_FINITE},      {INFINITY, CSTK_ERROR_NOT_FINITE},   {-INFINITY, CSTK_ERROR_NOT_FINITE},
    {-1, CSTK_ERROR_INVALID_ARGUMENT}, {1e60, CSTK_ERROR_INVALID_ARGUMENT}, {1e-60, CSTK_ERROR_DEGENERATE},
};

#define EACH_BAD_SIZE(i) for (size_t i = 0; i < sizeof bad_sizes / sizeof bad_sizes[0]; ++i)

static void handles(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        void *h = bad->handle;
        const double *at = identity_pose;
        CHECK_FAILS(cstk_body_builder_add_sphere(h, origin, 1, 0), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_capsule(h, origin, one, 1, 0), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_box(h, at, one, 0), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_cylinder(h, at, 1, 1, 0), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_cone(h, at, 1, 1, 0), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_ellipsoid(h, at, one, 0), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_rounded_polygon(h, square, 4, 1, 0), bad->status,
                    "builder");
        CHECK_FAILS(cstk_body_builder_add_rounded_polyhedron(h, square, 4, 1, 0), bad->status,
                    "builder");
        CHECK_FAILS(cstk_body_builder_add_points(h, square, 4, 1), bad->status, "builder");
        CHECK_FAILS(cstk_body_builder_add_height_field(h, 2, 2, square, 1, 1, NAN), bad->status,
                    "builder");
        CHECK_FAILS(cstk_body_builder_add_support(h, NULL, NULL, NULL, 0), bad->status, "builder");
    }
    fixture_unchanged(f);
}

static void null_arguments(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    const double *at = identity_pose;
    const cstk_status null = CSTK_ERROR_NULL_ARGUMENT;
    CHECK_FAILS(cstk_body_builder_add_sphere(b, NULL, 1, 0), null, "center");
    CHECK_FAILS(cstk_body_builder_add_capsule(b, NULL, one, 1, 0), null, "a is NULL");
    CHECK_FAILS(cstk_body_builder_add_capsule(b, one, NULL, 1, 0), null, "b is NULL");
    CHECK_FAILS(cstk_body_builder_add_box(b, NULL, one, 0), null, "pose");
    CHECK_FAILS(cstk_body_builder_add_box(b, at, NULL, 0), null, "half_extents");
    CHECK_FAILS(cstk_body_builder_add_cylinder(b, NULL, 1, 1, 0), null, "pose");
    CHECK_FAILS(cstk_body_builder_add_cone(b, NULL, 1, 1, 0), null, "pose");
    CHECK_FAILS(cstk_body_builder_add_ellipsoid(b, NULL, one, 0), null, "pose");
    CHECK_FAILS(cstk_body_builder_add_ellipsoid(b, at, NULL, 0), null, "semi_axes");
    CHECK_FAILS(cstk_body_builder_add_rounded_polygon(b, NULL, 4, 1, 0), null, "xyz");
    CHECK_FAILS(cstk_body_builder_add_rounded_polyhedron(b, NULL, 4, 1, 0), null, "xyz");
    CHECK_FAILS(cstk_body_builder_add_points(b, NULL, 4, 1), null, "xyz");
    CHECK_FAILS(cstk_body_builder_add_height_field(b, 2, 2, NULL, 1, 1, NAN), null, "heights");
    CHECK_FAILS(cstk_body_builder_add_support(b, NULL, NULL, NULL, 0), null, "support");
    CHECK_FAILS(cstk_body_builder_add_rounded_polygon(b, square, SIZE_MAX, 1, 0), CSTK_ERROR_WRONG_SIZE,
                "xyz");
    CHECK_FAILS(cstk_body_builder_add_rounded_polyhedron(b, square, SIZE_MAX, 1, 0),
                CSTK_ERROR_WRONG_SIZE, "xyz");
    CHECK_FAILS(cstk_body_builder_add_points(b, square, SIZE_MAX / 24 + 1, 1), CSTK_ERROR_WRONG_SIZE,
                "xyz");
    CHECK_FAILS(cstk_body_builder_add_rounded_polygon(b, square, 2, 1, 0), CSTK_ERROR_DEGENERATE,
                "rounded polygon");
    CHECK_FAILS(cstk_body_builder_add_rounded_polyhedron(b, square, 0, 1, 0), CSTK_ERROR_EMPTY,
                "rounded polyhedron");
    fixture_unchanged(f);
}

static void sizes(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    const double *at = identity_pose;
    EACH_BAD_SIZE(i) {
        const double x = bad_sizes[i].value;
        const double sides[3] = {1, 1, x};
        const cstk_status status = bad_sizes[i].status;
        CHECK_FAILS(cstk_body_builder_add_sphere(b, origin, x, 0), status, "radius");
        CHECK_FAILS(cstk_body_builder_add_capsule(b, origin, one, x, 0), status, "radius");
        CHECK_FAILS(cstk_body_builder_add_box(b, at, sides, 0), status, "half extent z");
        CHECK_FAILS(cstk_body_builder_add_cylinder(b, at, x, 1, 0), status, "radius");
        CHECK_FAILS(cstk_body_builder_add_cylinder(b, at, 1, x, 0), status, "half length");
        CHECK_FAILS(cstk_body_builder_add_cone(b, at, x, 1, 0), status, "radius");
        CHECK_FAILS(cstk_body_builder_add_cone(b, at, 1, x, 0), status, "height");
        CHECK_FAILS(cstk_body_builder_add_ellipsoid(b, at, sides, 0), status, "semi-axis z");
        CHECK_FAILS(cstk_body_builder_add_rounded_polygon(b, square, 4, x, 0), status, "radius");
        CHECK_FAILS(cstk_body_builder_add_rounded_polyhedron(b, square, 4, x, 0), status, "radius");
        CHECK_FAILS(cstk_body_builder_add_points(b, square, 4, x), status, "point 0");
    }
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double point[3] = {0, 0, 0};
            double cloud[6] = {0, 0, 0, 0, 0, 0};
            point[entry] = not_finite[i];
            cloud[3 + entry] = not_finite[i];
            CHECK_FAILS(cstk_body_builder_add_sphere(b, point, 1, 0), CSTK_ERROR_NOT_FINITE, "center");
            CHECK_FAILS(cstk_body_builder_add_capsule(b, point, one, 1, 0), CSTK_ERROR_NOT_FINITE,
                        "end a");
            CHECK_FAILS(cstk_body_builder_add_capsule(b, one, point, 1, 0), CSTK_ERROR_NOT_FINITE,
                        "end b");
            CHECK_FAILS(cstk_body_builder_add_points(b, cloud, 2, 1), CSTK_ERROR_NOT_FINITE, "point 1");
        }
    }
    EACH_BAD_POSE(bad) {
        CHECK_FAILS(cstk_body_builder_add_box(b, bad->pose, one, 0), bad->status, "pose");
        CHECK_FAILS(cstk_body_builder_add_cylinder(b, bad->pose, 1, 1, 0), bad->status, "pose");
        CHECK_FAILS(cstk_body_builder_add_cone(b, bad->pose, 1, 1, 0), bad->status, "pose");
        CHECK_FAILS(cstk_body_builder_add_ellipsoid(b, bad->pose, one, 0), bad->status, "pose");
    }
    fixture_unchanged(f);
}

static void height_fields(const fixture *f) {
    cstk_body_builder *b = f->body_builder;
    double heights[6] = {1, 2, 3, 4, 5, 6};
    const struct {
        size_t nx, ny;
        double cell_x, cell_y, base;
        cstk_status status;
        const char *culprit;
    } bad[] = {
        {0, 2, 1, 1, NAN, CSTK_ERROR_INVALID_ARGUMENT, "nodes"},
        {1, 6, 1, 1, NAN, CSTK_ERROR_INVALID_ARGUMENT, "nodes"},
        {SIZE_MAX, 2, 1, 1, NAN, CSTK_ERROR_WRONG_SIZE, "heights"},
        {SIZE_MAX / 2 + 2, 2, 1, 1, NAN, CSTK_ERROR_WRONG_SIZE, "heights"},
        {3, 2, 0, 1, NAN, CSTK_ERROR_INVALID_ARGUMENT, "along x"},
        {3, 2, 1, -1, NAN, CSTK_ERROR_INVALID_ARGUMENT, "along y"},
        {3, 2, 1, NAN, NAN, CSTK_ERROR_NOT_FINITE, "along y"},
        {3, 2, 1, 1, 1, CSTK_ERROR_INVALID_ARGUMENT, "height 0"},
        {3, 2, 1, 1, INFINITY, CSTK_ERROR_NOT_FINITE, "base"},
        {3, 2, 1e60, 1, NAN, CSTK_ERROR_INVALID_ARGUMENT, "along x"},
        {3, 2, 1e50, 1, NAN, CSTK_ERROR_DEGENERATE, "cell (0, 0)"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK_FAILS(cstk_body_builder_add_height_field(b, bad[i].nx, bad[i].ny, heights,
                                                       bad[i].cell_x, bad[i].cell_y, bad[i].base),
                    bad[i].status, bad[i].culprit);
    }
    heights[4] = NAN;
    CHECK_FAILS(cstk_body_builder_add_height_field(b, 3, 2, heights, 1, 1, 0), CSTK_ERROR_NOT_FINITE,
                "height 4");
    fixture_unchanged(f);
}

/* What the support function below does. */
typedef struct behaviour {
    int status;
    double factor;
    int writes;
    int destroyed;
} behaviour;

static int32_t ball(const double *direction, double *point, void *user) {
    const behaviour *how = user;
    for (int i = 0; i < how->writes; ++i) {
        point[i] = direction[i] * how->factor;
    }
    return how->status;
}

static void count_destroyed(void *user) { ++((behaviour *)user)->destroyed; }

static void supports(const fixture *f) {
    behaviour refused[] = {
        {1, 1, 3, 0}, {0, NAN, 3, 0}, {0, 1, 2, 0}, {0, -1, 3, 0}, {0, 1e60, 3, 0}};
    const cstk_status status[] = {CSTK_ERROR_CALLBACK_FAILED, CSTK_ERROR_NOT_FINITE, CSTK_ERROR_NOT_FINITE,
                                  CSTK_ERROR_NOT_CONVEX, CSTK_ERROR_INVALID_ARGUMENT};
    for (int i = 0; i < 5; ++i) {
        CHECK_FAILS(
            cstk_body_builder_add_support(f->body_builder, ball, &refused[i], count_destroyed, 0),
            status[i], "support function");
        CHECK(refused[i].destroyed == 0);
    }
    cstk_body_builder *builder;
    cstk_body *body;
    behaviour good = {0, 2, 3, 0};
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_support(builder, ball, &good, count_destroyed, 0));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_builder_release(builder));
    CHECK(good.destroyed == 0);
    CHECK_FAILS(cstk_body_save(body, "support.cstk"), CSTK_ERROR_UNSUPPORTED, "primitive 0");
    /* It fails, or answers nonsense, when it is asked: no call does. */
    double away[12];
    translation(9, 0, 0, away);
    cstk_distance_result found;
    CHECK_OK(cstk_pair_distance(f->query, body, identity_pose, f->body, away, INFINITY, &found));
    CHECK(found.distance > 0);
    good.status = 5;
    CHECK_OK(cstk_pair_distance(f->query, body, identity_pose, f->body, away, INFINITY, &found));
    good.status = 0;
    good.factor = NAN;
    CHECK_OK(cstk_pair_distance(f->query, body, identity_pose, f->body, away, INFINITY, &found));
    good.factor = -3;
    CHECK_OK(cstk_pair_distance(f->query, body, identity_pose, f->body, away, INFINITY, &found));
    CHECK_OK(cstk_body_release(body));
    CHECK(good.destroyed == 1);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    handles(&f);
    null_arguments(&f);
    sizes(&f);
    height_fields(&f);
    supports(&f);
    fixture_release(&f);
    return check_result();
}
