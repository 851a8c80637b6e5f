/* Octrees and files of point clouds with bad handles, numbers, poses and files; and an octree that changes in an environment beside
 * queries. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static const double origin[3] = {0, 0, 0};

/* Writes a file of the test's own. */
static void write_file(const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(name, "wb");
    CHECK(file != NULL);
    CHECK(fwrite(bytes, 1, size, file) == size);
    CHECK(fclose(file) == 0);
}

#define WRITE(name, text) write_file(name, text, sizeof(text) - 1)

static void handles(const fixture *f) {
    cstk_body *body;
    size_t count;
    bool occupied;
    EACH_BAD_HANDLE(f, NOUN_OCTREE, bad) {
        void *h = bad->handle;
        CHECK_FAILS(cstk_octree_set(h, origin, 1, true, NULL), bad->status, "octree");
        CHECK_FAILS(cstk_octree_get(h, origin, 1, &occupied), bad->status, "octree");
        CHECK_FAILS(cstk_octree_insert(h, f->octree), bad->status, "octree");
        CHECK_FAILS(cstk_octree_insert(f->octree, h), bad->status, "other");
        CHECK_FAILS(cstk_octree_get_state(h, NULL, NULL, NULL), bad->status, "octree");
        CHECK_FAILS(cstk_octree_get_cubes(h, 0, NULL, &count), bad->status, "octree");
        CHECK_REFUSED(body, cstk_octree_build_body(h, NULL, NULL, NULL, &body), bad->status, "octree");
        CHECK_FAILS(cstk_octree_place(h, f->environment, identity_pose, NULL, NULL), bad->status, "octree");
        CHECK_FAILS(cstk_octree_move(h, identity_pose), bad->status, "octree");
        CHECK_FAILS(cstk_octree_remove(h), bad->status, "octree");
        CHECK_FAILS(cstk_octree_retain(h), bad->status, "octree");
        if (h != NULL) {
            CHECK_FAILS(cstk_octree_release(h), bad->status, "octree");
        }
    }
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_FAILS(cstk_octree_place(f->octree, bad->handle, identity_pose, NULL, NULL), bad->status, "environment");
    }
    EACH_BAD_HANDLE(f, NOUN_BODY_BUILDER, bad) {
        CHECK_FAILS(cstk_body_builder_add_cloud_file(bad->handle, "missing.pcd", NULL, NULL, 1, NULL), bad->status,
                    "builder");
    }
    fixture_unchanged(f);
}

static void arguments(const fixture *f) {
    cstk_octree *made;
    const cstk_status null = CSTK_ERROR_NULL_ARGUMENT;
    CHECK_FAILS(cstk_octree_create(1, NULL), null, "out");
    CHECK_FAILS(cstk_octree_load("missing.bt", 0.5, NULL), null, "out");
    CHECK_REFUSED(made, cstk_octree_load(NULL, 0.5, &made), null, "file");
    CHECK_REFUSED(made, cstk_octree_load("missing.bt", 0.5, &made), CSTK_ERROR_IO, "missing.bt");
    CHECK_FAILS(cstk_octree_set(f->octree, NULL, 1, true, NULL), null, "xyz");
    CHECK_FAILS(cstk_octree_set(f->octree, origin, SIZE_MAX, true, NULL), CSTK_ERROR_WRONG_SIZE, "xyz");
    CHECK_FAILS(cstk_octree_get(f->octree, origin, 1, NULL), null, "occupied");
    CHECK_FAILS(cstk_octree_get_cubes(f->octree, 1, NULL, NULL), null, "cubes");
    CHECK_FAILS(cstk_octree_get_cubes(f->octree, 0, NULL, NULL), null, "count");
    CHECK_FAILS(cstk_octree_build_body(f->octree, NULL, NULL, NULL, NULL), null, "out");
    CHECK_FAILS(cstk_octree_place(f->octree, f->environment, NULL, NULL, NULL), null, "pose");
    CHECK_FAILS(cstk_octree_move(f->octree, NULL), null, "pose");
    CHECK_FAILS(cstk_octree_move(f->octree, identity_pose), CSTK_ERROR_NOT_FOUND, "no environment");
    CHECK_OK(cstk_octree_remove(f->octree));
    CHECK_OK(cstk_octree_insert(f->octree, f->octree));
    CHECK_OK(cstk_octree_set(f->octree, NULL, 0, true, NULL));
    EACH_BAD_POSE(bad) {
        CHECK_FAILS(cstk_octree_place(f->octree, f->environment, bad->pose, NULL, NULL), bad->status, "pose");
        CHECK_FAILS(cstk_octree_move(f->octree, bad->pose), bad->status, "pose");
    }
    const double resolutions[] = {0, -1, NAN, INFINITY, 1e60, 1e-60};
    for (int i = 0; i < 6; ++i) {
        const cstk_status status = isfinite(resolutions[i]) ? CSTK_ERROR_INVALID_ARGUMENT : CSTK_ERROR_NOT_FINITE;
        CHECK_REFUSED(made, cstk_octree_create(resolutions[i], &made), status, "resolution");
    }
    bool occupied = false;
    for (int axis = 0; axis < 3; ++axis) {
        EACH_NOT_FINITE(i) {
            double points[6] = {5, 5, 5, 0, 0, 0};
            points[3 + axis] = not_finite[i];
            CHECK_FAILS(cstk_octree_set(f->octree, points, 2, true, NULL), CSTK_ERROR_NOT_FINITE, "point 1");
            CHECK_FAILS(cstk_octree_get(f->octree, points + 3, 1, &occupied), CSTK_ERROR_NOT_FINITE, "point 0");
        }
        double far[3] = {0, 0, 0};
        far[axis] = 8192;
        CHECK_FAILS(cstk_octree_set(f->octree, far, 1, true, NULL), CSTK_ERROR_INVALID_ARGUMENT, "point 0");
    }
    CHECK_OK(cstk_octree_create(0.5, &made));
    CHECK_FAILS(cstk_octree_insert(f->octree, made), CSTK_ERROR_INVALID_ARGUMENT, "resolutions");
    cstk_body *body;
    CHECK_REFUSED(body, cstk_octree_build_body(made, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "cell");
    cstk_hierarchy_options good;
    CHECK_OK(cstk_hierarchy_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(body, cstk_octree_build_body(f->octree, bad->options, NULL, NULL, &body), bad->status, "options");
    }
    CHECK_OK(cstk_octree_release(made));
    fixture_unchanged(f);
}

static void files(const fixture *f) {
    static const char head[] = "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.25\ndata\n";
    cstk_octree *made;
    char bytes[sizeof head + 4];
    memcpy(bytes, head, sizeof head - 1);
    /* The root has one child that has one occupied child. */
    const unsigned char nodes[4] = {3, 0, 2, 0};
    memcpy(bytes + sizeof head - 1, nodes, 4);
    write_file("hostile_octree.bt", bytes, sizeof head + 3);
    CHECK_OK(cstk_octree_load("hostile_octree.bt", 0.5, &made));
    double cubes[8];
    size_t count = 0;
    CHECK_OK(cstk_octree_get_cubes(made, 2, cubes, &count));
    CHECK(count == 1 && cubes[0] == -8192 && cubes[3] == 4096);
    CHECK_OK(cstk_octree_release(made));
    for (size_t cut = 0; cut < sizeof head + 3; ++cut) {
        write_file("hostile_octree.bt", bytes, cut);
        CHECK_REFUSED(made, cstk_octree_load("hostile_octree.bt", 0.5, &made), CSTK_ERROR_PARSE, "hostile_octree.bt");
    }
    const double wrong[] = {0, 1, -1, NAN, INFINITY};
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(made, cstk_octree_load("hostile_octree.bt", wrong[i], &made), CSTK_ERROR_INVALID_ARGUMENT,
                      "occupancy");
    }
    cstk_body_builder *b = f->body_builder;
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, NULL, NULL, NULL, 1, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "missing.pcd", NULL, NULL, 1, NULL), CSTK_ERROR_IO, "missing.pcd");
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "missing.obj", NULL, NULL, 1, NULL), CSTK_ERROR_UNSUPPORTED, ".pcd");
    WRITE("hostile_octree.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 99999999999999\nDATA ascii\n");
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "hostile_octree.pcd", NULL, NULL, 1, NULL), CSTK_ERROR_UNSUPPORTED,
                "99999999999999 points");
    WRITE("hostile_octree.pcd",
          "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 60000000\nDATA binary_compressed\n\377\377\377\377\000\124\352\052");
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "hostile_octree.pcd", NULL, NULL, 1, NULL), CSTK_ERROR_PARSE, "truncated");
    WRITE("hostile_octree.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n0 0 0\n0 inf 0\n");
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "hostile_octree.pcd", NULL, NULL, 1, NULL), CSTK_ERROR_NOT_FINITE, "line 7");
    WRITE("hostile_octree.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n0 0 0\n0 nan 0\n");
    const double radii[] = {NAN, -1, INFINITY};
    for (int i = 0; i < 3; ++i) {
        const cstk_status status = radii[i] == -1 ? CSTK_ERROR_INVALID_ARGUMENT : CSTK_ERROR_NOT_FINITE;
        CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "hostile_octree.pcd", NULL, NULL, radii[i], NULL), status, "radius");
    }
    EACH_BAD_POSE(bad) {
        CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "hostile_octree.pcd", bad->pose, NULL, 1, NULL), bad->status, "pose");
    }
    const double no_scale[3] = {1, 0, 1};
    CHECK_FAILS(cstk_body_builder_add_cloud_file(b, "hostile_octree.pcd", NULL, no_scale, 1, NULL), CSTK_ERROR_INVALID_ARGUMENT,
                "scale entry 1");
    cstk_body_builder *own = NULL;
    uint64_t left_out = 0;
    CHECK_OK(cstk_body_builder_create(3, &own));
    CHECK_OK(cstk_body_builder_add_cloud_file(own, "hostile_octree.pcd", NULL, NULL, 0.5, &left_out));
    CHECK(left_out == 1);
    CHECK_OK(cstk_body_builder_release(own));
    CHECK(remove("hostile_octree.pcd") == 0 && remove("hostile_octree.bt") == 0);
    fixture_unchanged(f);
}

static int destroyed;

static void destroy(void *data) {
    CHECK(data == &destroyed);
    ++destroyed;
}

static int near_to(double a, double b) { return fabs(a - b) < 1e-12; }

/* The distance of a ball's centre, at (x, 0, 0), from what is in the environment. */
static double distance_at(cstk_query *query, const cstk_cobject *set, double x, void **data) {
    cstk_distance_result d;
    CHECK_OK(cstk_distance(query, set, &x, 1, INFINITY, &d));
    if (data != NULL) {
        *data = d.witness.s_data;
    }
    return d.distance;
}

/* A point on a rail along x, and an octree whose cells change. */
static void changes(void) {
    cstk_body_builder *builder = NULL;
    cstk_body *point = NULL;
    cstk_robot_builder *rail = NULL;
    cstk_robot *robot = NULL;
    cstk_space *space = NULL;
    cstk_environment *world = NULL, *before = NULL;
    cstk_cobject *set = NULL, *old = NULL;
    cstk_query *query = NULL;
    cstk_octree *octree = NULL;
    cstk_link_def def;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_sphere(builder, origin, 0.125, 0));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &point));
    CHECK_OK(cstk_robot_builder_create(3, &rail));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.body = point;
    def.joint = CSTK_JOINT_PRISMATIC;
    def.axis[0] = 1;
    def.axis[1] = def.axis[2] = 0;
    CHECK_OK(cstk_robot_builder_add_link(rail, &def, NULL));
    CHECK_OK(cstk_robot_build(rail, &robot));
    const cstk_robot *robots = robot;
    CHECK_OK(cstk_space_create(&robots, 1, NULL, 0, NULL, &space));
    CHECK_OK(cstk_environment_create(&world));
    CHECK_OK(cstk_cobject_induced(space, NULL, 0, world, NULL, 0, NULL, &set));
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_octree_create(0.5, &octree));
    CHECK_OK(cstk_octree_place(octree, world, identity_pose, &destroyed, destroy));
    CHECK_FAILS(cstk_octree_place(octree, world, identity_pose, NULL, NULL), CSTK_ERROR_INVALID_ARGUMENT, "environment");
    const double cells[6] = {10.1, 0.1, 0.1, 20.1, 0.1, 0.1};
    size_t changed = 0;
    CHECK_OK(cstk_octree_set(octree, cells, 2, true, &changed));
    CHECK(changed == 2);
    CHECK_OK(cstk_octree_set(octree, cells, 2, true, &changed));
    CHECK(changed == 0);
    void *data = NULL;
    CHECK(near_to(distance_at(query, set, 0, &data), 9.875) && data == &destroyed);
    CHECK(near_to(distance_at(query, set, 10.2, NULL), 0));
    CHECK_OK(cstk_environment_snapshot(world, &before));
    CHECK_FAILS(cstk_octree_place(octree, before, identity_pose, NULL, NULL), CSTK_ERROR_INVALID_ARGUMENT, "environment");
    CHECK_OK(cstk_cobject_induced(space, NULL, 0, before, NULL, 0, NULL, &old));
    CHECK_OK(cstk_octree_set(octree, cells, 1, false, NULL));
    CHECK(near_to(distance_at(query, set, 0, NULL), 19.875) && near_to(distance_at(query, old, 0, NULL), 9.875));
    double shifted[12];
    translation(2, 0, 0, shifted);
    CHECK_OK(cstk_octree_move(octree, shifted));
    CHECK(near_to(distance_at(query, set, 0, NULL), 21.875));
    CHECK_OK(cstk_octree_remove(octree));
    CHECK(isinf(distance_at(query, set, 0, NULL)));
    cstk_octree *other = NULL;
    CHECK_OK(cstk_octree_create(0.5, &other));
    CHECK_FAILS(cstk_octree_place(other, before, identity_pose, NULL, NULL), CSTK_ERROR_UNSUPPORTED, "snapshot");
    CHECK_OK(cstk_octree_insert(other, octree));
    CHECK_OK(cstk_octree_place(other, world, identity_pose, NULL, NULL));
    CHECK(near_to(distance_at(query, set, 0, NULL), 19.875));
    /* Its objects stay when it goes. */
    CHECK_OK(cstk_octree_release(other));
    CHECK(near_to(distance_at(query, set, 0, NULL), 19.875));
    CHECK_OK(cstk_octree_release(octree));
    CHECK_OK(cstk_cobject_release(set));
    CHECK_OK(cstk_cobject_release(old));
    CHECK_OK(cstk_environment_release(before));
    CHECK_OK(cstk_environment_release(world));
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(rail));
    CHECK_OK(cstk_body_release(point));
    CHECK_OK(cstk_body_builder_release(builder));
    CHECK(destroyed == 1);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    handles(&f);
    arguments(&f);
    files(&f);
    fixture_release(&f);
    changes();
    return check_result();
}
