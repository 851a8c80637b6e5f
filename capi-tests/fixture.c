#include "fixture.h"

#include <math.h>

#include "check.h"

const double identity_pose[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
const double not_finite[3] = {NAN, INFINITY, -INFINITY};

void translation(double x, double y, double z, double pose[12]) {
    memcpy(pose, identity_pose, sizeof identity_pose);
    pose[3] = x;
    pose[7] = y;
    pose[11] = z;
}

static void add_box(cstk_body_builder *builder, double x, double y, double z) {
    double corners[24];
    for (int i = 0; i < 8; ++i) {
        corners[3 * i] = i & 1 ? x : -x;
        corners[3 * i + 1] = i & 2 ? y : -y;
        corners[3 * i + 2] = i & 4 ? z : -z;
    }
    CHECK_OK(cstk_body_builder_add_polyhedron(builder, corners, 8, 7));
}

cstk_body *make_box(double x, double y, double z) {
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    add_box(builder, x, y, z);
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_builder_release(builder));
    return body;
}

uint64_t add_object(cstk_environment *environment, const cstk_body *body, double x, double y,
                    double z) {
    cstk_environment_change change;
    uint64_t id = 0;
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.body = body;
    translation(x, y, z, change.pose);
    CHECK_OK(cstk_environment_apply(environment, &change, 1, &id, NULL));
    return id;
}

cstk_robot *make_arm(cstk_robot_builder *builder, const cstk_body *body) {
    for (int i = 0; i < FIXTURE_LINKS; ++i) {
        cstk_link_def def;
        CHECK_OK(cstk_link_def_default(&def, sizeof def));
        if (i > FIXTURE_BASE) {
            def.body = body;
            def.parent = i - 1;
            def.joint = CSTK_JOINT_REVOLUTE;
            translation(i > 1 ? 1.0 : 0.0, 0.0, 0.0, def.at);
        }
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_build(builder, &robot));
    return robot;
}

static void keep_handles(fixture *f) {
    f->live[NOUN_BODY_BUILDER] = f->body_builder;
    f->live[NOUN_BODY] = f->body;
    f->live[NOUN_MESH] = f->mesh;
    f->live[NOUN_ROBOT_BUILDER] = f->robot_builder;
    f->live[NOUN_ROBOT] = f->robot;
    f->live[NOUN_SPACE] = f->space;
    f->live[NOUN_ENVIRONMENT] = f->environment;
    f->live[NOUN_COBJECT] = f->cobject;
    f->live[NOUN_QUERY] = f->query;
    f->live[NOUN_CERTIFICATE] = f->certificate;
    f->live[NOUN_BATCH] = f->batch;
    f->live[NOUN_MAP] = f->map;
    f->live[NOUN_OCTREE] = f->octree;
}

static void release_handles(void *const handles[NOUN_COUNT]) {
    CHECK_OK(cstk_octree_release(handles[NOUN_OCTREE]));
    CHECK_OK(cstk_map_release(handles[NOUN_MAP]));
    CHECK_OK(cstk_batch_release(handles[NOUN_BATCH]));
    CHECK_OK(cstk_certificate_release(handles[NOUN_CERTIFICATE]));
    CHECK_OK(cstk_query_release(handles[NOUN_QUERY]));
    CHECK_OK(cstk_cobject_release(handles[NOUN_COBJECT]));
    CHECK_OK(cstk_environment_release(handles[NOUN_ENVIRONMENT]));
    CHECK_OK(cstk_space_release(handles[NOUN_SPACE]));
    CHECK_OK(cstk_robot_release(handles[NOUN_ROBOT]));
    CHECK_OK(cstk_robot_builder_release(handles[NOUN_ROBOT_BUILDER]));
    CHECK_OK(cstk_mesh_release(handles[NOUN_MESH]));
    CHECK_OK(cstk_body_release(handles[NOUN_BODY]));
    CHECK_OK(cstk_body_builder_release(handles[NOUN_BODY_BUILDER]));
}

static void create_scene(fixture *f) {
    CHECK_OK(cstk_body_builder_create(3, &f->body_builder));
    add_box(f->body_builder, 0.4, 0.1, 0.1);
    CHECK_OK(cstk_body_build(f->body_builder, NULL, NULL, NULL, &f->body));
    const uint32_t root = 0;
    CHECK_OK(cstk_mesh_create_from_nodes(f->body, &root, 1, &f->mesh));
    CHECK_OK(cstk_robot_builder_create(3, &f->robot_builder));
    f->robot = make_arm(f->robot_builder, f->body);
    const cstk_robot *robot = f->robot;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, NULL, &f->space));
    CHECK_OK(cstk_environment_create(&f->environment));
    f->box = add_object(f->environment, f->body, 3.0, 0.5, 0.0);
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, NULL, &f->cobject));
    CHECK_OK(cstk_query_create(&f->query));
    f->q[0] = 0.1;
    f->q[1] = -0.2;
    f->q[2] = 0.3;
    cstk_motion_result rests;
    CHECK_OK(cstk_motion_certificate(f->query, f->cobject, f->q, f->q, FIXTURE_NQ, NULL, NULL,
                                     &rests, &f->certificate));
    CHECK(f->certificate != NULL);
    CHECK_OK(cstk_batch_create(&f->batch));
    const cstk_map_axis axis = {0, 0, 0, 0.2, 1, 0, 0};
    CHECK_OK(cstk_map_build(f->cobject, f->q, FIXTURE_NQ, &axis, 1, NULL, NULL, NULL, &f->map));
    const double origin[3] = {0, 0, 0};
    CHECK_OK(cstk_octree_create(0.25, &f->octree));
    CHECK_OK(cstk_octree_set(f->octree, origin, 1, true, NULL));
    keep_handles(f);
}

void fixture_create(fixture *f) {
    memset(f, 0, sizeof *f);
    create_scene(f);
    release_handles(f->live);
    memcpy(f->released, f->live, sizeof f->released);
    create_scene(f);

    for (uint32_t i = 0; i < FIXTURE_LINKS; ++i) {
        double *pose = &f->link_poses[12 * i];
        CHECK_OK(cstk_robot_link_pose(f->robot, f->q, FIXTURE_NQ, i, pose));
    }
    CHECK_OK(cstk_distance(f->query, f->cobject, f->q, FIXTURE_NQ, INFINITY, &f->distance));
    CHECK(f->distance.kind == CSTK_DISTANCE_EXACT && f->distance.distance > 0.0);
}

void fixture_release(fixture *f) { release_handles(f->live); }

static void environment_unchanged(const fixture *f) {
    size_t objects = 0;
    uint64_t version = 0;
    double pose[12];
    double expected[12];
    CHECK_OK(cstk_environment_get_state(f->environment, &objects, &version));
    CHECK(objects == 1 && version == 1);
    CHECK_OK(cstk_environment_get_object_pose(f->environment, f->box, pose));
    translation(3.0, 0.5, 0.0, expected);
    CHECK(memcmp(pose, expected, sizeof pose) == 0);
}

static void mesh_unchanged(const fixture *f) {
    cstk_mesh_view view;
    CHECK_OK(cstk_mesh_get_view(f->mesh, &view));
    CHECK(view.vertex_count == 8 && view.face_count == 6 && view.index_count == 24);
}

static void builders_unchanged(const fixture *f) {
    cstk_body *body = NULL;
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_build(f->body_builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    CHECK(statistics.primitive_count == 1);
    CHECK(statistics.faces_split == 0 && statistics.faces_dropped == 0);
    CHECK_OK(cstk_body_release(body));

    cstk_robot *robot = NULL;
    size_t nq = 0;
    size_t links = 0;
    CHECK_OK(cstk_robot_build(f->robot_builder, &robot));
    CHECK_OK(cstk_robot_get_size(robot, &nq, NULL, &links));
    CHECK(nq == FIXTURE_NQ && links == FIXTURE_LINKS);
    CHECK_OK(cstk_robot_release(robot));
}

static void octree_unchanged(const fixture *f) {
    double resolution = 0;
    uint64_t cells = 0;
    size_t objects = 1;
    CHECK_OK(cstk_octree_get_state(f->octree, &resolution, &cells, &objects));
    CHECK(resolution == 0.25 && cells == 1 && objects == 0);
}

void fixture_unchanged(const fixture *f) {
    cstk_distance_result again;
    octree_unchanged(f);
    environment_unchanged(f);
    builders_unchanged(f);
    mesh_unchanged(f);
    CHECK_OK(cstk_certificate_verify(f->certificate, f->cobject, f->q, f->q, FIXTURE_NQ, 0));
    CHECK_OK(cstk_distance(f->query, f->cobject, f->q, FIXTURE_NQ, INFINITY, &again));
    CHECK(memcmp(&again.distance, &f->distance.distance, sizeof again.distance) == 0);
    CHECK(memcmp(again.r_point, f->distance.r_point, sizeof again.r_point) == 0);
    CHECK(memcmp(again.s_point, f->distance.s_point, sizeof again.s_point) == 0);
}

const bad_handle *bad_handles(const fixture *f, noun wanted) {
    static bad_handle bad[2 * NOUN_COUNT + 2];
    /* Not a handle at all, but memory that can be read. */
    static uint64_t foreign[8];
    bad_handle *next = bad;
    *next++ = (bad_handle){NULL, CSTK_ERROR_NULL_ARGUMENT};
    *next++ = (bad_handle){foreign, CSTK_ERROR_WRONG_HANDLE};
    for (int kind = 0; kind < NOUN_COUNT; ++kind) {
        if (kind != (int)wanted) {
            *next++ = (bad_handle){f->live[kind], CSTK_ERROR_WRONG_HANDLE};
        }
    }
    *next++ = (bad_handle){f->released[wanted], CSTK_ERROR_WRONG_HANDLE};
    *next = (bad_handle){NULL, CSTK_OK};
    return bad;
}

static bad_pose pose_with(int entry, double value, cstk_status status) {
    bad_pose bad;
    memcpy(bad.pose, identity_pose, sizeof identity_pose);
    bad.pose[entry] = value;
    bad.status = status;
    return bad;
}

const bad_pose *bad_poses(void) {
    static bad_pose bad[12 * 3 + 8];
    bad_pose *next = bad;
    for (int entry = 0; entry < 12; ++entry) {
        EACH_NOT_FINITE(i) { *next++ = pose_with(entry, not_finite[i], CSTK_ERROR_NOT_FINITE); }
    }
    *next++ = pose_with(0, -1.0, CSTK_ERROR_NOT_A_ROTATION); /* a reflection */
    *next++ = pose_with(1, 0.5, CSTK_ERROR_NOT_A_ROTATION);  /* a shear */
    *next++ = pose_with(10, 2.0, CSTK_ERROR_NOT_A_ROTATION); /* a scaling */
    *next++ = pose_with(5, 0.0, CSTK_ERROR_NOT_A_ROTATION);  /* a projection */
    *next++ = pose_with(4, 1e-4, CSTK_ERROR_NOT_A_ROTATION); /* a little off */
    *next++ = pose_with(7, 1e300, CSTK_ERROR_INVALID_ARGUMENT);
    *next = pose_with(0, 1.0, CSTK_OK);
    return bad;
}

const bad_options *bad_options_like(const void *good, size_t size) {
    enum { ROOM = 256, COPIES = 8 };
    static union {
        uint64_t align;
        unsigned char bytes[ROOM];
        uint32_t words[ROOM / 4];
    } copies[COPIES];
    static bad_options bad[COPIES + 1];
    CHECK(size + 8 <= ROOM);
    memset(copies, 0, sizeof copies);
    for (int i = 0; i < COPIES; ++i) {
        memcpy(copies[i].bytes, good, size);
        bad[i] = (bad_options){copies[i].bytes, CSTK_ERROR_NOT_INITIALISED};
    }
    memset(copies[0].bytes, 0, size); /* not initialised */
    copies[1].words[1] ^= 1;          /* another cookie */
    copies[2].words[0] = 0;           /* the cookie alone */
    copies[3].words[0] = (uint32_t)size - 1;
    copies[4].words[0] = 8; /* size and cookie only */
    copies[5].words[0] = UINT32_MAX;
    memset(copies[6].bytes, 0x5A, size);
    /* A later version of the structure, with a field this library does not know. */
    copies[7].words[0] = (uint32_t)size + 8;
    copies[7].bytes[size + 7] = 1;
    bad[7].status = CSTK_ERROR_UNSUPPORTED;
    bad[COPIES] = (bad_options){NULL, CSTK_OK};
    return bad;
}

int32_t never_called(double fraction, void *user) {
    (void)fraction;
    (void)user;
    fprintf(stderr, "progress of a call that was refused\n");
    exit(1);
}
