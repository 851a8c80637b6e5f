/* Bodies in files: what is loaded is what was saved, to the last bit; what is not whole is refused;
 * a file is replaced whole or not at all. */
#include <dirent.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bodies.h"
#include "check.h"
#include "fixture.h"

static const char *folder = "body_files_test";

static const char *path_of(const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

typedef struct content {
    unsigned char *bytes;
    size_t size;
} content;

static content read_file(const char *name) {
    content c = {NULL, 0};
    FILE *file = fopen(path_of(name), "rb");
    CHECK(file != NULL && fseek(file, 0, SEEK_END) == 0);
    c.size = (size_t)ftell(file);
    c.bytes = malloc(c.size + 1);
    CHECK(c.bytes != NULL);
    rewind(file);
    CHECK(fread(c.bytes, 1, c.size, file) == c.size && fclose(file) == 0);
    return c;
}

static void write_file(const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(path_of(name), "wb");
    CHECK(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
}

static int same_content(const char *a, const char *b) {
    content of_a = read_file(a);
    content of_b = read_file(b);
    const int same = of_a.size == of_b.size && memcmp(of_a.bytes, of_b.bytes, of_a.size) == 0;
    free(of_a.bytes);
    free(of_b.bytes);
    return same;
}

/* The number of files in the folder whose names hold a text. */
static int files_with(const char *text) {
    int count = 0;
    DIR *listing = opendir(folder);
    CHECK(listing != NULL);
    for (struct dirent *entry = readdir(listing); entry != NULL; entry = readdir(listing)) {
        count += strstr(entry->d_name, text) != NULL;
    }
    CHECK(closedir(listing) == 0);
    return count;
}

/* Files half written that an earlier run left. */
static int parts_before;

static cstk_body *load(const char *name) {
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_load(path_of(name), &body));
    return body;
}

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

static void refuse(const char *name, cstk_status status, const char *culprit) {
    cstk_body *out;
    CHECK_REFUSED(out, cstk_body_load(path_of(name), &out), status, culprit);
    CHECK_FAILS(cstk_body_load(path_of(name), &out), status, name);
}

static void refuse_bytes(const void *bytes, size_t size, cstk_status status, const char *culprit) {
    write_file("refused.cstk", bytes, size);
    refuse("refused.cstk", status, culprit);
}

static void not_a_body(void) {
    const char text[] = "This is a text that is longer than the header of a body file.\n";
    unsigned char zeros[1000] = {0};
    refuse("missing.cstk", CSTK_ERROR_IO, "missing.cstk");
    refuse("missing/a.cstk", CSTK_ERROR_IO, "missing/a.cstk");
    mkdir(path_of("folder.cstk"), 0777);
    refuse("folder.cstk", CSTK_ERROR_IO, "folder.cstk");
    refuse_bytes("", 0, CSTK_ERROR_PARSE, "truncated");
    refuse_bytes(text, 5, CSTK_ERROR_PARSE, "no body file");
    refuse_bytes(text, sizeof text, CSTK_ERROR_PARSE, "no body file");
    refuse_bytes(zeros, sizeof zeros, CSTK_ERROR_PARSE, "no body file");
    refuse_bytes("v 0 0 0\n", 8, CSTK_ERROR_PARSE, "no body file");
}

/* The file of a triangle. */
static content small_file(void) {
    const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, triangle, 3, 0));
    cstk_body *body = build_body(builder, NULL);
    CHECK_OK(cstk_body_save(body, path_of("small.cstk")));
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    return read_file("small.cstk");
}

enum { VERSION_AT = 8, SUM_AT = 24, HEADER_SUM_AT = 28, HEADER_SIZE = 32 };

static void truncated(const content *whole) {
    for (size_t size = 0; size < whole->size; ++size) {
        refuse_bytes(whole->bytes, size, CSTK_ERROR_PARSE, size < 8 ? "" : "truncated");
    }
    unsigned char *longer = calloc(whole->size + 1, 1);
    CHECK(longer != NULL);
    memcpy(longer, whole->bytes, whole->size);
    refuse_bytes(longer, whole->size + 1, CSTK_ERROR_PARSE, "damaged");
    free(longer);
}

static void altered(const content *whole) {
    for (size_t place = 0; place < whole->size; ++place) {
        const unsigned char masks[] = {0x01, 0x80, 0xFF};
        const int version = place >= VERSION_AT && place < VERSION_AT + 4;
        whole->bytes[place] ^= masks[place % 3];
        refuse_bytes(whole->bytes, whole->size, version ? CSTK_ERROR_UNSUPPORTED : CSTK_ERROR_PARSE,
                     version ? "version" : "");
        whole->bytes[place] ^= masks[place % 3];
    }
    /* Nothing but the altered bytes was to blame. */
    write_file("refused.cstk", whole->bytes, whole->size);
    CHECK_OK(cstk_body_release(load("refused.cstk")));
}

/* CRC-32 as in ISO 3309, bit by bit. */
static uint32_t checksum(const unsigned char *bytes, size_t size) {
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; ++i) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) {
            sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0);
        }
    }
    return ~sum;
}

static void put(unsigned char *bytes, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        bytes[i] = (unsigned char)(value >> 8 * i);
    }
}

static void sign(content *file) {
    put(file->bytes + SUM_AT, checksum(file->bytes + HEADER_SIZE, file->size - HEADER_SIZE));
    put(file->bytes + HEADER_SUM_AT, checksum(file->bytes, HEADER_SUM_AT));
}

/* The version counts before all else, whether the rest is right or not. */
static void newer(content *whole) {
    const uint32_t versions[] = {6, 8, 0x00010000, UINT32_MAX};
    for (int i = 0; i < 4; ++i) {
        char text[32];
        snprintf(text, sizeof text, "version %u", (unsigned)versions[i]);
        put(whole->bytes + VERSION_AT, versions[i]);
        sign(whole);
        refuse_bytes(whole->bytes, whole->size, CSTK_ERROR_UNSUPPORTED, text);
        put(whole->bytes + SUM_AT, 0);
        refuse_bytes(whole->bytes, HEADER_SIZE + 1, CSTK_ERROR_UNSUPPORTED, text);
    }
    put(whole->bytes + VERSION_AT, 7);
    sign(whole);
    CHECK(checksum((const unsigned char *)"123456789", 9) == 0xCBF43926u);
    write_file("signed.cstk", whole->bytes, whole->size);
    CHECK(same_content("signed.cstk", "small.cstk"));
}

/* A file that somebody made up, checksums and all: it is refused, or it is a body that can be
 * asked. */
static void ask_forged(const cstk_body *body) {
    cstk_query *query = NULL;
    cstk_hierarchy_statistics s;
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
    for (uint32_t i = 0; i < s.node_count; ++i) {
        cstk_hierarchy_node node;
        cstk_mesh *mesh = NULL;
        CHECK_OK(cstk_body_get_node(body, i, &node));
        const cstk_status status = cstk_mesh_create_from_nodes(body, &i, 1, &mesh);
        CHECK(status != CSTK_ERROR_INTERNAL);
        CHECK_OK(cstk_mesh_release(mesh));
    }
    for (int i = 0; i < 2; ++i) {
        cstk_distance_result d;
        cstk_witness_list list;
        double pose[12];
        random_pose(i, 2.0, pose);
        CHECK(cstk_pair_distance(query, body, identity_pose, body, pose, INFINITY, &d) !=
              CSTK_ERROR_INTERNAL);
        CHECK(cstk_pair_witnesses(query, body, identity_pose, body, pose, 1.0, 9, &list) !=
              CSTK_ERROR_INTERNAL);
    }
    CHECK_OK(cstk_query_release(query));
}

static void forged(content *whole) {
    const uint32_t values[] = {0, 1, 3, 0x7FF00000, 0x80000000, UINT32_MAX};
    content copy = {malloc(whole->size), whole->size};
    int loaded = 0;
    CHECK(copy.bytes != NULL);
    for (size_t place = HEADER_SIZE; place + 4 <= whole->size; place += 4) {
        for (size_t i = place / 4 % 2; i < 6; i += 2) {
            cstk_body *body = NULL;
            memcpy(copy.bytes, whole->bytes, whole->size);
            put(copy.bytes + place, values[i]);
            sign(&copy);
            write_file("forged.cstk", copy.bytes, copy.size);
            const cstk_status status = cstk_body_load(path_of("forged.cstk"), &body);
            CHECK(status == CSTK_OK || status == CSTK_ERROR_PARSE);
            if (status == CSTK_OK) {
                ask_forged(body);
                CHECK_OK(cstk_body_release(body));
                ++loaded;
            }
        }
    }
    CHECK(loaded > 0);
    free(copy.bytes);
}

/* No room to write in: the file that was there is as it was, and no other is left. */
static void kept_when_saving_fails(void) {
    cstk_body_builder *builder = mixed_builder();
    cstk_body *body = build_body(builder, NULL);
    struct rlimit before;
    content old = small_file();
    CHECK_OK(cstk_body_save(body, path_of("kept.cstk")));
    write_file("kept.cstk", old.bytes, old.size);
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
    mkdir(folder, 0777);
    parts_before = files_with(".part");
    mixed_bodies();
    odd_bodies();
    dimensions();
    not_a_body();
    content small = small_file();
    truncated(&small);
    altered(&small);
    newer(&small);
    forged(&small);
    free(small.bytes);
    kept_when_saving_fails();
    saved_by_threads();
    CHECK(files_with(".part") == parts_before);
    return check_result();
}
