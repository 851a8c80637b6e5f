/* Bodies in files: what is loaded is what was saved, to the last bit; a file is replaced whole or not at all. */
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bodies.h"
#include "check.h"
#include "file_folder.h"
#include "fixture.h"

/* Files half written that an earlier run left. */
static int parts_before;

static void check_same_numbers(const cstk_body *a, const cstk_body *b) {
    cstk_body_statistics counts[2];
    cstk_hierarchy_statistics shapes[2];
    CHECK_OK(cstk_body_get_statistics(a, &counts[0]));
    CHECK_OK(cstk_body_get_statistics(b, &counts[1]));
    CHECK(memcmp(&counts[0], &counts[1], sizeof counts[0]) == 0);
    CHECK_OK(cstk_body_get_hierarchy_statistics(a, &shapes[0]));
    CHECK_OK(cstk_body_get_hierarchy_statistics(b, &shapes[1]));
    CHECK(memcmp(&shapes[0], &shapes[1], sizeof shapes[0]) == 0);
    for (uint32_t level = 0; level < shapes[0].depth; ++level) {
        cstk_level_statistics levels[2];
        CHECK_OK(cstk_body_get_level_statistics(a, level, &levels[0]));
        CHECK_OK(cstk_body_get_level_statistics(b, level, &levels[1]));
        CHECK(memcmp(&levels[0], &levels[1], sizeof levels[0]) == 0);
    }
    tree trees[2] = {read_tree(a), read_tree(b)};
    CHECK(same_trees(&trees[0], &trees[1]));
    free_tree(&trees[0]);
    free_tree(&trees[1]);
}

/* Every feature of every primitive, and one that is none. */
static void check_same_features(const cstk_body *a, const cstk_body *b) {
    cstk_body_statistics s;
    CHECK_OK(cstk_body_get_statistics(a, &s));
    for (uint32_t primitive = 0; primitive < s.primitive_count; ++primitive) {
        for (int32_t kind = CSTK_FEATURE_VERTEX; kind <= CSTK_FEATURE_INTERIOR; ++kind) {
            cstk_status status = CSTK_OK;
            for (uint32_t feature = 0; status == CSTK_OK; ++feature) {
                double xyz[2][3 * 64];
                size_t count[2] = {0, 0};
                status =
                    cstk_body_get_feature_vertices(a, primitive, kind, feature, 64, xyz[0], &count[0]);
                CHECK_STATUS(
                    cstk_body_get_feature_vertices(b, primitive, kind, feature, 64, xyz[1], &count[1]),
                    status);
                CHECK(count[0] == count[1] && count[0] <= 64);
                CHECK(memcmp(xyz[0], xyz[1], 3 * count[0] * sizeof(double)) == 0);
                CHECK(feature < 1000);
            }
            CHECK(status == CSTK_ERROR_NOT_FOUND);
        }
    }
}

static void check_same_bits(const void *a, const void *b, size_t size) {
    CHECK(memcmp(a, b, size) == 0);
}

/* Distances of either from the first at poses near and far, and witnesses. `reach` is about the
 * size of the bodies. */
static void check_same_answers(const cstk_body *a, const cstk_body *b, double reach, int planar) {
    cstk_body_statistics s;
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_body_get_statistics(a, &s));
    for (int i = 0; i < 12; ++i) {
        const cstk_body *bodies[2] = {a, b};
        cstk_distance_result d[2];
        cstk_witness witnesses[2][16];
        size_t counts[2];
        double pose[12];
        random_pose(i, fmin(1.5 * reach, 5e49), pose);
        if (planar) {
            translation(pose[3], pose[7], 0, pose);
        }
        /* Turned about its middle. */
        for (int axis = 0; axis < 3; ++axis) {
            for (int k = 0; k < 3; ++k) {
                const double middle = 0.5 * s.low[k] + 0.5 * s.high[k];
                pose[4 * axis + 3] += ((axis == k) - pose[4 * axis + k]) * middle;
            }
        }
        for (int k = 0; k < 2; ++k) {
            cstk_witness_list list;
            CHECK_OK(cstk_pair_distance(query, bodies[k], identity_pose, a, pose, INFINITY, &d[k]));
            CHECK_OK(cstk_pair_witnesses(query, bodies[k], identity_pose, a, pose,
                                         1.1 * d[0].distance, 16, &list));
            counts[k] = list.witness_count;
            memcpy(witnesses[k], list.witnesses, list.witness_count * sizeof(cstk_witness));
        }
        check_same_bits(&d[0].distance, &d[1].distance, 3 * sizeof(double));
        check_same_bits(d[0].r_point, d[1].r_point, 6 * sizeof(double));
        CHECK(d[0].kind == CSTK_DISTANCE_EXACT && d[1].kind == CSTK_DISTANCE_EXACT && counts[0] == counts[1]);
        CHECK(d[0].witness.r_primitive == d[1].witness.r_primitive);
        CHECK(d[0].witness.r_tag == d[1].witness.r_tag);
        for (size_t w = 0; w < counts[0]; ++w) {
            CHECK(witnesses[0][w].r_primitive == witnesses[1][w].r_primitive);
            CHECK(witnesses[0][w].r_tag == witnesses[1][w].r_tag);
            check_same_bits(&witnesses[0][w].distance, &witnesses[1][w].distance, sizeof(double));
        }
    }
    CHECK_OK(cstk_query_release(query));
}

static void round_trip(const cstk_body *saved, double reach, int planar) {
    CHECK_OK(cstk_body_save(saved, path_of("a.cstk")));
    cstk_body *loaded = load("a.cstk");
    CHECK(remove(path_of("a.cstk")) == 0); /* the loaded body needs it no more */
    check_same_numbers(saved, loaded);
    check_same_features(saved, loaded);
    check_same_answers(saved, loaded, reach, planar);
    /* Saved again, it makes the same file, over one of that name. */
    CHECK_OK(cstk_body_save(saved, path_of("a.cstk")));
    CHECK_OK(cstk_body_save(saved, path_of("b.cstk")));
    CHECK_OK(cstk_body_save(loaded, path_of("b.cstk")));
    CHECK(same_content("a.cstk", "b.cstk"));
    CHECK_OK(cstk_body_release(loaded));
}

static void mixed_bodies(void) {
    cstk_body_builder *builder = mixed_builder();
    cstk_body_statistics s;
    for (int32_t k = 0; k < GROUPINGS * WRAPPERS; ++k) {
        cstk_hierarchy_options options = default_options();
        options.grouping = k / WRAPPERS;
        options.wrapper = k % WRAPPERS;
        options.aspect_limit = k % 2 ? 2.0 : 0.0;
        options.pieces = k % 3;
        cstk_body *body = build_body(builder, &options);
        CHECK_OK(cstk_body_get_statistics(body, &s));
        CHECK(s.faces_split > 0 && s.faces_dropped > 0);
        round_trip(body, 8.0, 0);
        CHECK_OK(cstk_body_release(body));
    }
    CHECK_OK(cstk_body_builder_release(builder));
}

/* Points and segments alone, the plane, and coordinates as large and as small as they may be. */
static void odd_bodies(void) {
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    for (int kind = 0; kind < 6; ++kind) {
        const double scale = kind == 4 ? 1e50 : kind == 5 ? 1e-50 : 1.0;
        cstk_body_builder *builder = NULL;
        CHECK_OK(cstk_body_builder_create(kind == 3 ? 2 : 3, &builder));
        for (int i = 0; i < 8; ++i) {
            double points[12];
            for (int k = 0; k < 12; ++k) {
                const double shift = kind < 4 ? 2.0 * i : 0.0;
                points[k] = scale * (square[k] + (k % 3 < 2 ? shift : 0.0));
                if (kind == 4) {
                    points[k] =
                        i & (1 << k % 3) ? 2.0 * points[k] - scale : scale - 2.0 * points[k];
                }
            }
            CHECK_OK(cstk_body_builder_add_polyhedron(builder, points,
                                                      kind == 0   ? 1
                                                      : kind == 1 ? 2
                                                                  : 4,
                                                      7));
        }
        for (int32_t wrapper = 0; wrapper < WRAPPERS; ++wrapper) {
            cstk_hierarchy_options options = default_options();
            options.wrapper = wrapper;
            cstk_body *body = build_body(builder, &options);
            round_trip(body, scale, kind == 3);
            CHECK_OK(cstk_body_release(body));
        }
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

/* A loaded body has its dimension: it serves robots of that dimension and no others. */
static void dimensions(void) {
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        cstk_body_builder *builder = NULL;
        CHECK_OK(cstk_body_builder_create(dimension, &builder));
        CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 0));
        cstk_body *saved = build_body(builder, NULL);
        CHECK_OK(cstk_body_save(saved, path_of("plane.cstk")));
        cstk_body *loaded = load("plane.cstk");
        for (uint32_t of_robot = 2; of_robot <= 3; ++of_robot) {
            cstk_robot_builder *robot = NULL;
            cstk_link_def def;
            CHECK_OK(cstk_robot_builder_create(of_robot, &robot));
            CHECK_OK(cstk_link_def_default(&def, sizeof def));
            def.body = saved;
            const cstk_status status = cstk_robot_builder_add_link(robot, &def, NULL);
            def.body = loaded;
            CHECK_STATUS(cstk_robot_builder_add_link(robot, &def, NULL), status);
            CHECK((status == CSTK_OK) == (dimension == of_robot));
            CHECK_OK(cstk_robot_builder_release(robot));
        }
        CHECK_OK(cstk_body_release(saved));
        CHECK_OK(cstk_body_release(loaded));
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

/* No room to write in: the file that was there is as it was, and no other is left. */
static void kept_when_saving_fails(void) {
    cstk_body_builder *builder = mixed_builder();
    cstk_body *body = build_body(builder, NULL);
    struct rlimit before;
    content old = small_file();
    CHECK_OK(cstk_body_save(body, path_of("kept.cstk")));
    write_file("kept.cstk", old.bytes, old.size);
    mkdir(path_of("folder.cstk"), 0777);
    remove(path_of("new.cstk"));
    remove(path_of("new.glb"));
    CHECK(getrlimit(RLIMIT_FSIZE, &before) == 0);
    struct rlimit tight = before;
    tight.rlim_cur = 1000;
    signal(SIGXFSZ, SIG_IGN);
    CHECK(setrlimit(RLIMIT_FSIZE, &tight) == 0);
    CHECK_FAILS(cstk_body_save(body, path_of("kept.cstk")), CSTK_ERROR_IO, "kept.cstk");
    CHECK_FAILS(cstk_body_save(body, path_of("new.cstk")), CSTK_ERROR_IO, "new.cstk");
    const uint32_t root = 0;
    CHECK_FAILS(cstk_body_show_nodes(body, &root, 1, path_of("new.glb")), CSTK_ERROR_IO, "new.glb");
    CHECK(setrlimit(RLIMIT_FSIZE, &before) == 0);
    CHECK(same_content("kept.cstk", "small.cstk"));
    CHECK(access(path_of("new.cstk"), F_OK) != 0 && access(path_of("new.glb"), F_OK) != 0);
    CHECK_FAILS(cstk_body_save(body, path_of("missing/new.cstk")), CSTK_ERROR_IO, "missing/new.cstk");
    CHECK_FAILS(cstk_body_save(body, path_of("folder.cstk")), CSTK_ERROR_IO, "folder.cstk");
    CHECK(files_with(".part") == parts_before);
    CHECK_OK(cstk_body_save(body, path_of("kept.cstk")));
    CHECK_OK(cstk_body_release(load("kept.cstk")));
    CHECK(files_with(".part") == parts_before);
    free(old.bytes);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
}

enum { SAVERS = 4, SAVES = 150 };

typedef struct saver {
    pthread_t thread;
    const cstk_body *body;
    char path[512];
    int failures;
} saver;

static void *save_often(void *user) {
    saver *s = user;
    for (int i = 0; i < SAVES; ++i) {
        cstk_body *loaded = NULL;
        s->failures += cstk_body_save(s->body, s->path) != CSTK_OK;
        const cstk_status status = cstk_body_load(s->path, &loaded);
        s->failures += status != CSTK_OK;
        s->failures += cstk_body_release(loaded) != CSTK_OK;
    }
    return NULL;
}

/* Threads save different bodies under one name: whoever reads finds one of them, whole. */
static void saved_by_threads(void) {
    saver savers[SAVERS];
    cstk_body *bodies[SAVERS];
    for (int i = 0; i < SAVERS; ++i) {
        cstk_body_builder *builder = torus_builder(8 + 4 * i, 8);
        bodies[i] = build_body(builder, NULL);
        CHECK_OK(cstk_body_builder_release(builder));
        memset(&savers[i], 0, sizeof savers[i]);
        savers[i].body = bodies[i];
        snprintf(savers[i].path, sizeof savers[i].path, "%s", path_of("shared.cstk"));
    }
    int failures = 0;
    for (int i = 0; i < SAVERS; ++i) {
        CHECK(pthread_create(&savers[i].thread, NULL, save_often, &savers[i]) == 0);
    }
    for (int i = 0; i < SAVERS; ++i) {
        CHECK(pthread_join(savers[i].thread, NULL) == 0);
        failures += savers[i].failures;
        CHECK_OK(cstk_body_release(bodies[i]));
    }
    if (failures > 0) {
        fprintf(stderr, "%d calls failed of %d threads that save under one name\n", failures,
                SAVERS);
        ++check_failures;
    }
}

int main(void) {
    use_folder("body_files_test");
    parts_before = files_with(".part");
    mixed_bodies();
    odd_bodies();
    dimensions();
    kept_when_saving_fails();
    saved_by_threads();
    CHECK(files_with(".part") == parts_before);
    return check_result();
}
