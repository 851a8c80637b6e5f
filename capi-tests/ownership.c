/* References: retaining and releasing, parts that go before the whole, leaks (under valgrind),
 * builds that are cancelled or called back into. */
#include <math.h>

#include "check.h"
#include "fixture.h"

/* Two references, dropped one after the other; `alive` is a call that needs the object. */
#define TWO_REFERENCES(noun, argument, handle, alive)                                              \
    do {                                                                                           \
        CHECK_OK(alive);                                                                           \
        CHECK_OK(cstk_##noun##_retain(handle));                                                    \
        CHECK_OK(cstk_##noun##_release(handle));                                                   \
        CHECK_OK(alive);                                                                           \
        CHECK_OK(cstk_##noun##_release(handle));                                                   \
        CHECK_FAILS(cstk_##noun##_release(handle), CSTK_ERROR_WRONG_HANDLE, argument);                   \
        CHECK_FAILS(cstk_##noun##_retain(handle), CSTK_ERROR_WRONG_HANDLE, "released");                  \
        CHECK_FAILS(alive, CSTK_ERROR_WRONG_HANDLE, argument);                                           \
        CHECK_OK(cstk_##noun##_release(NULL));                                                     \
        CHECK_FAILS(cstk_##noun##_retain(NULL), CSTK_ERROR_NULL_ARGUMENT, argument);                     \
    } while (0)

static void every_noun(void) {
    fixture f;
    bool in_range;
    cstk_class class_of;
    cstk_query_statistics done;
    cstk_body_statistics counts;
    cstk_mesh_view view;
    cstk_map_view cells;
    cstk_certificate_summary summary;
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    cstk_link_def def;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    fixture_create(&f);
    cstk_query *other = NULL;
    CHECK_OK(cstk_query_create(&other));
    TWO_REFERENCES(body_builder, "builder", f.body_builder,
                   cstk_body_builder_add_polygon(f.body_builder, square, 4, 0));
    TWO_REFERENCES(body, "body", f.body, cstk_body_get_statistics(f.body, &counts));
    TWO_REFERENCES(mesh, "mesh", f.mesh, cstk_mesh_get_view(f.mesh, &view));
    TWO_REFERENCES(robot_builder, "builder", f.robot_builder,
                   cstk_robot_builder_add_link(f.robot_builder, &def, NULL));
    TWO_REFERENCES(robot, "robot", f.robot, cstk_robot_get_size(f.robot, NULL, NULL, NULL));
    TWO_REFERENCES(space, "space", f.space,
                   cstk_space_contains(f.space, f.q, FIXTURE_NQ, &in_range));
    TWO_REFERENCES(environment, "environment", f.environment,
                   cstk_environment_get_state(f.environment, NULL, NULL));
    TWO_REFERENCES(certificate, "certificate", f.certificate,
                   cstk_certificate_get_summary(f.certificate, &summary));
    TWO_REFERENCES(map, "map", f.map, cstk_map_get_view(f.map, &cells));
    TWO_REFERENCES(octree, "octree", f.octree, cstk_octree_get_state(f.octree, NULL, NULL, NULL));
    TWO_REFERENCES(batch, "batch", f.batch, cstk_batch_get_statistics(f.batch, false, &done));
    TWO_REFERENCES(query, "query", f.query, cstk_query_get_statistics(f.query, false, &done));
    TWO_REFERENCES(cobject, "cobject", f.cobject,
                   cstk_classify(other, f.cobject, f.q, FIXTURE_NQ, &class_of));
    CHECK_OK(cstk_query_release(other));
}

/* A release through the wrong kind takes nothing away. */
static void wrong_kind(void) {
    fixture f;
    fixture_create(&f);
    for (int i = 0; i < 3; ++i) {
        CHECK_FAILS(cstk_robot_release(f.live[NOUN_BODY]), CSTK_ERROR_WRONG_HANDLE, "robot");
        CHECK_FAILS(cstk_body_release(f.live[NOUN_ROBOT]), CSTK_ERROR_WRONG_HANDLE, "body");
        CHECK_FAILS(cstk_query_release(f.live[NOUN_COBJECT]), CSTK_ERROR_WRONG_HANDLE, "query");
        CHECK_FAILS(cstk_mesh_release(f.live[NOUN_BODY]), CSTK_ERROR_WRONG_HANDLE, "mesh");
        CHECK_FAILS(cstk_space_release(f.live[NOUN_ENVIRONMENT]), CSTK_ERROR_WRONG_HANDLE, "space");
    }
    fixture_unchanged(&f);
    fixture_release(&f);
}

static void check_distance(const fixture *f, const cstk_cobject *cobject) {
    cstk_distance_result d;
    CHECK_OK(cstk_distance(f->query, cobject, f->q, FIXTURE_NQ, INFINITY, &d));
    CHECK(memcmp(&d.distance, &f->distance.distance, sizeof d.distance) == 0);
}

/* A mesh holds copies: it is used when its body is gone, and its arrays stay where they are. */
static void mesh_after_its_body(void) {
    fixture f;
    cstk_mesh_view before;
    cstk_mesh_view after;
    const uint32_t root = 0;
    cstk_mesh *mesh = NULL;
    cstk_body *body = make_box(1, 2, 3);
    CHECK_OK(cstk_mesh_create_from_nodes(body, &root, 1, &mesh));
    CHECK_OK(cstk_mesh_get_view(mesh, &before));
    CHECK_OK(cstk_body_release(body));
    fixture_create(&f); /* may take the memory that is free now */
    fixture_release(&f);
    CHECK_OK(cstk_mesh_get_view(mesh, &after));
    CHECK(memcmp(&before, &after, sizeof before) == 0);
    CHECK(after.vertex_count == 8 && after.face_count == 6 && after.index_count == 24);
    for (size_t i = 0; i < 3 * after.vertex_count; ++i) {
        CHECK(fabs(after.vertices[i]) == 1.0 + (double)(i % 3));
    }
    for (size_t i = 0; i < after.face_count; ++i) {
        CHECK(after.face_sizes[i] == 4 && after.face_nodes[i] == root);
    }
    /* The arrays live as long as the last reference. */
    CHECK_OK(cstk_mesh_retain(mesh));
    CHECK_OK(cstk_mesh_release(mesh));
    CHECK(after.vertices[0] == before.vertices[0] && after.indices[23] < 8);
    CHECK_OK(cstk_mesh_release(mesh));
}

/* A union of two C-objects over an environment and its snapshot is used when all it was made of is
 * gone, and a certificate when its C-object is. */
static void parts_before_the_whole(void) {
    fixture f;
    cstk_environment *snapshot = NULL;
    cstk_cobject *frozen = NULL;
    cstk_cobject *both = NULL;
    fixture_create(&f);
    CHECK_OK(cstk_environment_snapshot(f.environment, &snapshot));
    CHECK_OK(cstk_cobject_induced(f.space, NULL, 0, snapshot, NULL, 0, NULL, &frozen));
    const cstk_cobject *parts[2] = {f.cobject, frozen};
    CHECK_OK(cstk_cobject_union(parts, 2, &both));
    CHECK_OK(cstk_body_builder_release(f.body_builder));
    CHECK_OK(cstk_mesh_release(f.mesh));
    CHECK_OK(cstk_body_release(f.body));
    CHECK_OK(cstk_robot_builder_release(f.robot_builder));
    check_distance(&f, f.cobject);
    CHECK_OK(cstk_robot_release(f.robot));
    CHECK_OK(cstk_space_release(f.space));
    CHECK_OK(cstk_environment_release(f.environment));
    check_distance(&f, f.cobject);
    CHECK_OK(cstk_environment_release(snapshot));
    CHECK_OK(cstk_cobject_release(f.cobject));
    check_distance(&f, frozen);
    CHECK_OK(cstk_cobject_release(frozen));
    check_distance(&f, both);
    CHECK_OK(cstk_cobject_release(both));
    CHECK_OK(cstk_query_release(f.query));
    CHECK_OK(cstk_batch_release(f.batch));
    cstk_map_view cells;
    CHECK_OK(cstk_map_get_view(f.map, &cells));
    CHECK(cells.cell_count == 1 && cells.values[0] == CSTK_CLASS_OUTSIDE);
    CHECK_OK(cstk_map_release(f.map));
    CHECK_OK(cstk_octree_release(f.octree));
    cstk_certificate_summary summary;
    CHECK_OK(cstk_certificate_get_summary(f.certificate, &summary));
    CHECK_OK(cstk_certificate_release(f.certificate));
}

/* A context may outlive what it was asked about; its caches keep nothing that is followed later. */
static void query_after_all_is_gone(void) {
    fixture f;
    fixture g;
    cstk_query_statistics done;
    fixture_create(&f);
    CHECK_OK(cstk_query_retain(f.query));
    cstk_query *query = f.query;
    fixture_release(&f);
    fixture_create(&g);
    CHECK_OK(cstk_query_get_statistics(query, true, &done));
    CHECK(done.primitive_pairs > 0);
    cstk_distance_result d;
    CHECK_OK(cstk_distance(query, g.cobject, g.q, FIXTURE_NQ, INFINITY, &d));
    CHECK(memcmp(&d.distance, &g.distance.distance, sizeof d.distance) == 0);
    CHECK_OK(cstk_query_release(query));
    fixture_release(&g);
}

static void many_times(void) {
    for (int i = 0; i < 300; ++i) {
        fixture f;
        fixture_create(&f);
        fixture_release(&f);
    }
    for (int i = 0; i < 3000; ++i) {
        cstk_body_builder *builder = NULL;
        cstk_environment *environment = NULL;
        cstk_environment *snapshot = NULL;
        cstk_query *query = NULL;
        cstk_batch *batch = NULL;
        CHECK_OK(cstk_batch_create(&batch));
        CHECK_OK(cstk_batch_release(batch));
        CHECK_OK(cstk_body_builder_create(3, &builder));
        CHECK_OK(cstk_body_builder_release(builder));
        CHECK_OK(cstk_environment_create(&environment));
        CHECK_OK(cstk_environment_snapshot(environment, &snapshot));
        CHECK_OK(cstk_environment_release(environment));
        CHECK_OK(cstk_environment_release(snapshot));
        CHECK_OK(cstk_query_create(&query));
        CHECK_OK(cstk_query_release(query));
    }
}

/* Enough faces for a build that reports its progress several times. */
static cstk_body_builder *strip_builder(void) {
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    for (int i = 0; i < 200; ++i) {
        const double triangle[9] = {i, 0, 0, i + 1, 0, 0, i, 1, 0.1 * (i % 7)};
        CHECK_OK(cstk_body_builder_add_polygon(builder, triangle, 3, (uint64_t)i));
    }
    return builder;
}

typedef struct listener {
    int calls;
    int stop_at;
    int32_t answer;
    double last;
} listener;

static int32_t listen(double fraction, void *user) {
    listener *heard = user;
    CHECK(fraction >= heard->last && fraction <= 1.0);
    heard->last = fraction;
    return heard->calls++ == heard->stop_at ? heard->answer : 0;
}

static void progress(void) {
    cstk_body_builder *builder = strip_builder();
    cstk_body *body = NULL;
    listener all = {0, -1, 0, 0.0};
    CHECK_OK(cstk_body_build(builder, NULL, listen, &all, &body));
    CHECK(all.calls >= 2 && all.last == 1.0);
    CHECK_OK(cstk_body_release(body));
    /* Stopped at each call, with any number but 0, and whole again afterwards. */
    for (int stop = 0; stop < all.calls; ++stop) {
        listener some = {0, stop, stop % 2 ? -1 : 1, 0.0};
        CHECK_REFUSED(body, cstk_body_build(builder, NULL, listen, &some, &body), CSTK_ERROR_CANCELLED,
                      "progress");
        CHECK(some.calls == stop + 1);
    }
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    CHECK(statistics.primitive_count == 200);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
}

/* Calls back into the builder that is building: refused; into others: fine. */
static int32_t call_back(double fraction, void *user) {
    cstk_body_builder *builder = user;
    cstk_body *body;
    const double triangle[9] = {0, 0, 9, 1, 0, 9, 0, 1, 9};
    const uint32_t indices[3] = {0, 1, 2};
    (void)fraction;
    CHECK_FAILS(cstk_body_builder_add_polygon(builder, triangle, 3, 0), CSTK_ERROR_BUSY, "builder");
    CHECK_FAILS(cstk_body_builder_add_polyhedron(builder, triangle, 3, 0), CSTK_ERROR_BUSY, "builder");
    CHECK_FAILS(cstk_body_builder_add_mesh(builder, triangle, 3, NULL, 1, indices, 3, NULL, NULL),
                CSTK_ERROR_BUSY, "builder");
    CHECK_FAILS(cstk_body_builder_add_mesh_file(builder, "missing.obj", NULL, NULL), CSTK_ERROR_BUSY,
                "builder");
    CHECK_REFUSED(body, cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_BUSY, "builder");
    CHECK_OK(cstk_body_builder_retain(builder));
    CHECK_OK(cstk_body_builder_release(builder));
    CHECK_OK(cstk_body_release(make_box(1, 1, 1)));
    return 0;
}

static void busy(void) {
    cstk_body_builder *builder = strip_builder();
    cstk_body *body = NULL;
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_build(builder, NULL, call_back, builder, &body));
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    CHECK(statistics.primitive_count == 200);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
}

/* The callback drops the caller's only reference: the build ends well, and the builder goes when it
 * is over. */
static int32_t release_builder(double fraction, void *user) {
    cstk_body_builder **builder = user;
    (void)fraction;
    if (*builder != NULL) {
        CHECK_OK(cstk_body_builder_release(*builder));
        *builder = NULL;
    }
    return 0;
}

static void released_meanwhile(void) {
    cstk_body_builder *builder = strip_builder();
    cstk_body *body = NULL;
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_build(builder, NULL, release_builder, &builder, &body));
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    CHECK(statistics.primitive_count == 200 && builder == NULL);
    CHECK_OK(cstk_body_release(body));
}

int main(void) {
    every_noun();
    wrong_kind();
    mesh_after_its_body();
    parts_before_the_whole();
    query_after_all_is_gone();
    many_times();
    progress();
    busy();
    released_meanwhile();
    return check_result();
}
