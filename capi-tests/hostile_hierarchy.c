/* Hostile input to what concerns hierarchies: options, levels, covers, nodes, meshes, files. */
#include <math.h>
#include <stddef.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bodies.h"
#include "check.h"
#include "fixture.h"

enum { LEAVES = 5, NODES = 2 * LEAVES - 1, ROOM = 64 };

/* Five squares side by side. */
static cstk_body *make_squares(void) {
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    for (int i = 0; i < LEAVES; ++i) {
        const double square[12] = {i, 0, 0, i + 1, 0, 0, i + 1, 1, 0, i, 1, 0};
        CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 0));
    }
    cstk_body *body = build_body(builder, NULL);
    CHECK_OK(cstk_body_builder_release(builder));
    return body;
}

static void refuse_options(const fixture *f, const cstk_hierarchy_options *options,
                           cstk_status status, const char *field) {
    cstk_body *out;
    const int before = check_failures;
    CHECK_REFUSED(out, cstk_body_build(f->body_builder, options, never_called, NULL, &out), status, field);
    if (check_failures > before) {
        fprintf(stderr, "  (%s)\n", field);
    }
}

#define FIELD(name)                                                                                \
    { #name, offsetof(cstk_hierarchy_options, name) }

typedef struct field {
    const char *name;
    size_t offset;
} field;

static void options_numbers(const fixture *f) {
    const field fields[] = {FIELD(cost_diameter),  FIELD(cost_fill), FIELD(cost_balance),
                            FIELD(diameter_limit), FIELD(gap_limit), FIELD(aspect_limit)};
    const double negative[] = {-1.0, -5e-324, -1e300};
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i) {
        cstk_hierarchy_options options = default_options();
        double *value = (double *)((char *)&options + fields[i].offset);
        EACH_NOT_FINITE(k) {
            *value = not_finite[k];
            refuse_options(f, &options, CSTK_ERROR_NOT_FINITE, fields[i].name);
        }
        for (int k = 0; k < 3; ++k) {
            *value = negative[k];
            refuse_options(f, &options, CSTK_ERROR_INVALID_ARGUMENT, fields[i].name);
        }
    }
    const double steep[] = {16.000001, 17.0, 1e300};
    const double square[] = {5e-324, 1.0, 1.4999};
    for (int i = 0; i < 3; ++i) {
        cstk_hierarchy_options options = default_options();
        options.cost_diameter = steep[i];
        refuse_options(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "cost_diameter");
        options = default_options();
        options.aspect_limit = square[i];
        refuse_options(f, &options, CSTK_ERROR_INVALID_ARGUMENT, "aspect_limit");
    }
    fixture_unchanged(f);
}

static void options_choices(const fixture *f) {
    const struct {
        field of;
        uint32_t value;
    } wrong[] = {
        {FIELD(hull_vertex_limit), 0},
        {FIELD(hull_vertex_limit), 1},
        {FIELD(hull_vertex_limit), 7},
        {FIELD(threads), 1025},
        {FIELD(threads), 5000},
        {FIELD(threads), UINT32_MAX},
        {FIELD(grouping), GROUPINGS},
        {FIELD(grouping), UINT32_MAX},
        {FIELD(grouping), 0x80000000u},
        {FIELD(wrapper), WRAPPERS},
        {FIELD(wrapper), UINT32_MAX},
        {FIELD(wrapper), 0x7FFFFFFFu},
        {FIELD(pieces), CSTK_PIECES_PATCHES + 1},
        {FIELD(pieces), UINT32_MAX},
        {FIELD(reserved), 1},
        {FIELD(reserved), UINT32_MAX},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_hierarchy_options options = default_options();
        memcpy((char *)&options + wrong[i].of.offset, &wrong[i].value, sizeof wrong[i].value);
        refuse_options(f, &options, CSTK_ERROR_INVALID_ARGUMENT, wrong[i].of.name);
    }
    fixture_unchanged(f);
}

/* The outermost values that are welcome build a sound tree of whatever quality. */
static void options_extremes(void) {
    const struct {
        field of;
        double value;
    } most[] = {
        {FIELD(cost_diameter), 0.0},    {FIELD(cost_diameter), 16.0},  {FIELD(cost_fill), 0.0},
        {FIELD(cost_fill), 1e308},      {FIELD(cost_balance), 0.0},    {FIELD(cost_balance), 1e308},
        {FIELD(diameter_limit), 1e308}, {FIELD(diameter_limit), 1e-6}, {FIELD(gap_limit), 1e308},
        {FIELD(gap_limit), 5e-324},     {FIELD(aspect_limit), 1e308},  {FIELD(aspect_limit), 1.5},
    };
    cstk_body_builder *builder = mixed_builder();
    for (size_t i = 0; i < sizeof most / sizeof most[0]; ++i) {
        for (int32_t grouping = 0; grouping < GROUPINGS; ++grouping) {
            cstk_hierarchy_options options = default_options();
            options.grouping = grouping;
            memcpy((char *)&options + most[i].of.offset, &most[i].value, sizeof most[i].value);
            cstk_body *body = build_body(builder, &options);
            tree t = read_tree(body);
            free_tree(&t);
            CHECK_OK(cstk_body_release(body));
        }
    }
    cstk_hierarchy_options options = default_options();
    options.hull_vertex_limit = UINT32_MAX;
    CHECK_OK(cstk_body_release(build_body(builder, &options)));
    options.hull_vertex_limit = 8;
    CHECK_OK(cstk_body_release(build_body(builder, &options)));
    CHECK_OK(cstk_body_builder_release(builder));
}

/* A quarter of this limit, which is the first gap, is 0 when rounded; it must grow all the same.
 * Last of all, for it has gone on for ever. */
static void least_limit(void) {
    cstk_body_builder *builder = mixed_builder();
    cstk_hierarchy_options options = default_options();
    options.diameter_limit = 5e-324;
    alarm(10);
    for (options.grouping = 0; options.grouping < GROUPINGS; ++options.grouping) {
        CHECK_OK(cstk_body_release(build_body(builder, &options)));
    }
    alarm(0);
    CHECK_OK(cstk_body_builder_release(builder));
}

static cstk_body *build_with_words(cstk_body_builder *builder, const uint32_t *words) {
    return build_body(builder, (const cstk_hierarchy_options *)(const void *)words);
}

/* The first version of the options ended after four words, the last of them reserved. The structure
 * lies in memory of that size, so that valgrind sees whoever reads or writes on. */
static void old_caller(const fixture *f) {
    cstk_body_builder *builder = mixed_builder();
    cstk_body *out;
    uint32_t *words = malloc(16);
    CHECK(words != NULL);
    cstk_hierarchy_options *old = (cstk_hierarchy_options *)(void *)words;
    CHECK_OK(cstk_hierarchy_options_default(old, 16));
    const cstk_hierarchy_options now = default_options();
    CHECK(words[0] == 16 && words[1] == now.cookie && words[2] == 32);
    cstk_body *bodies[4] = {build_body(builder, NULL), build_with_words(builder, words)};
    words[2] = 8;
    words[3] = 0; /* as the first version's default had it */
    bodies[2] = build_with_words(builder, words);
    cstk_hierarchy_options options = now;
    options.hull_vertex_limit = 8;
    bodies[3] = build_body(builder, &options);
    tree trees[4];
    for (int i = 0; i < 4; ++i) {
        trees[i] = read_tree(bodies[i]);
    }
    CHECK(same_trees(&trees[0], &trees[1]) && same_trees(&trees[2], &trees[3]));
    CHECK(!same_trees(&trees[0], &trees[2]));
    words[2] = 7;
    CHECK_REFUSED(out, cstk_body_build(builder, old, never_called, NULL, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "hull_vertex_limit");
    for (int i = 0; i < 4; ++i) {
        free_tree(&trees[i]);
        CHECK_OK(cstk_body_release(bodies[i]));
    }
    free(words);
    CHECK_OK(cstk_body_builder_release(builder));
    fixture_unchanged(f);
}

/* Sizes of no version, though larger than that of the first: some would cut a field in two. */
static void sizes_in_between(const fixture *f) {
    const uint32_t now = sizeof(cstk_hierarchy_options);
    const uint32_t sizes[] = {17, 18, 33, now - 4, now - 1};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        cstk_hierarchy_options options = default_options();
        cstk_body *out;
        options.size = sizes[i];
        CHECK_REFUSED(out, cstk_body_build(f->body_builder, &options, NULL, NULL, &out),
                      CSTK_ERROR_NOT_INITIALISED, "options");
    }
    /* The size of something larger would have what stands behind the options overwritten. */
    cstk_hierarchy_options options;
    CHECK_REFUSED(options, cstk_hierarchy_options_default(&options, now + 129), CSTK_ERROR_WRONG_SIZE,
                  "sizeof(cstk_hierarchy_options)");
    cstk_motion_options motion;
    CHECK_REFUSED(motion, cstk_motion_options_default(&motion, sizeof(cstk_link_def)),
                  CSTK_ERROR_WRONG_SIZE, "sizeof(cstk_motion_options)");
    fixture_unchanged(f);
}

static void options_elsewhere(const fixture *f) {
    unsigned char bytes[sizeof(cstk_hierarchy_options) + 8];
    const cstk_hierarchy_options good = default_options();
    cstk_body *out;
    memcpy(bytes + 1, &good, sizeof good);
    CHECK_REFUSED(out,
                  cstk_body_build(f->body_builder,
                                  (const cstk_hierarchy_options *)(const void *)(bytes + 1), never_called,
                                  NULL, &out),
                  CSTK_ERROR_INVALID_ARGUMENT, "options");
    CHECK_REFUSED(
        bytes,
        cstk_hierarchy_options_default((cstk_hierarchy_options *)(void *)(bytes + 1), sizeof good),
        CSTK_ERROR_INVALID_ARGUMENT, "out");
    fixture_unchanged(f);
}

/* Numbers for all functions that describe a body, and where they write. */
typedef union answer {
    cstk_hierarchy_statistics hierarchy;
    cstk_level_statistics level;
    cstk_hierarchy_node node;
    cstk_mesh *mesh;
    cstk_body *body;
    struct {
        uint32_t items[ROOM];
        size_t count;
    } nodes;
    struct {
        double items[3 * ROOM];
        size_t count;
    } corners;
} answer;

/* A pointer into the same union that no type may live at. */
#define OFF(pointer) ((void *)((char *)(pointer) + 1))

static void describe_handles(const fixture *f) {
    const uint32_t root = 0;
    answer out;
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        const cstk_body *body = bad->handle;
        CHECK_REFUSED(out, cstk_body_get_hierarchy_statistics(body, &out.hierarchy), bad->status, "body");
        CHECK_REFUSED(out, cstk_body_get_level_statistics(body, 0, &out.level), bad->status, "body");
        CHECK_REFUSED(out, cstk_body_get_level_nodes(body, 0, ROOM, out.nodes.items, &out.nodes.count),
                      bad->status, "body");
        CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, ROOM, out.nodes.items, &out.nodes.count),
                      bad->status, "body");
        CHECK_REFUSED(out, cstk_body_get_node(body, 0, &out.node), bad->status, "body");
        CHECK_REFUSED(out,
                      cstk_body_get_node_corners(body, 0, ROOM, out.corners.items, &out.corners.count),
                      bad->status, "body");
        CHECK_REFUSED(out, cstk_mesh_create_from_nodes(body, &root, 1, &out.mesh), bad->status, "body");
        CHECK_FAILS(cstk_body_show_nodes(body, &root, 1, "hostile_nodes.glb"), bad->status, "body");
        CHECK_FAILS(cstk_body_save(body, "hostile_body.cstk"), bad->status, "body");
    }
    CHECK(access("hostile_nodes.glb", F_OK) != 0 && access("hostile_body.cstk", F_OK) != 0);
    fixture_unchanged(f);
}

static void describe_null(const cstk_body *body) {
    const uint32_t root = 0;
    answer out;
    CHECK_FAILS(cstk_body_get_hierarchy_statistics(body, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_body_get_level_statistics(body, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_body_get_node(body, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_mesh_create_from_nodes(body, &root, 1, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_body_load("missing", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_body_get_level_nodes(body, 0, 1, NULL, &out.nodes.count), CSTK_ERROR_NULL_ARGUMENT,
                  "nodes");
    CHECK_REFUSED(out, cstk_body_get_level_nodes(body, 0, SIZE_MAX, NULL, &out.nodes.count),
                  CSTK_ERROR_NULL_ARGUMENT, "nodes");
    CHECK_REFUSED(out, cstk_body_get_level_nodes(body, 0, ROOM, out.nodes.items, NULL), CSTK_ERROR_NULL_ARGUMENT,
                  "count");
    CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, 1, NULL, &out.nodes.count), CSTK_ERROR_NULL_ARGUMENT,
                  "nodes");
    CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, ROOM, out.nodes.items, NULL), CSTK_ERROR_NULL_ARGUMENT,
                  "count");
    CHECK_REFUSED(out, cstk_body_get_node_corners(body, 0, 1, NULL, &out.corners.count),
                  CSTK_ERROR_NULL_ARGUMENT, "xyz");
    CHECK_REFUSED(out, cstk_body_get_node_corners(body, 0, ROOM, out.corners.items, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "count");
    CHECK_REFUSED(out, cstk_mesh_create_from_nodes(body, NULL, 1, &out.mesh), CSTK_ERROR_NULL_ARGUMENT, "nodes");
    CHECK_FAILS(cstk_body_show_nodes(body, NULL, 1, "a.glb"), CSTK_ERROR_NULL_ARGUMENT, "nodes");
    CHECK_FAILS(cstk_body_show_nodes(body, &root, 1, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_body_save(body, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_REFUSED(out, cstk_body_load(NULL, &out.body), CSTK_ERROR_NULL_ARGUMENT, "file");
}

static void describe_misaligned(const cstk_body *body) {
    const uint32_t nodes[4] = {0, 0, 0, 0};
    const uint32_t *off = OFF(nodes);
    answer out;
    CHECK_REFUSED(out, cstk_body_get_hierarchy_statistics(body, OFF(&out)), CSTK_ERROR_INVALID_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_body_get_level_statistics(body, 0, OFF(&out)), CSTK_ERROR_INVALID_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_body_get_node(body, 0, OFF(&out)), CSTK_ERROR_INVALID_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_mesh_create_from_nodes(body, nodes, 1, OFF(&out)), CSTK_ERROR_INVALID_ARGUMENT,
                  "out");
    CHECK_REFUSED(out, cstk_body_load("missing", OFF(&out)), CSTK_ERROR_INVALID_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_body_get_level_nodes(body, 0, 4, OFF(out.nodes.items), &out.nodes.count),
                  CSTK_ERROR_INVALID_ARGUMENT, "nodes");
    CHECK_REFUSED(out, cstk_body_get_level_nodes(body, 0, 4, out.nodes.items, OFF(&out.nodes.count)),
                  CSTK_ERROR_INVALID_ARGUMENT, "count");
    CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, 4, OFF(out.nodes.items), &out.nodes.count),
                  CSTK_ERROR_INVALID_ARGUMENT, "nodes");
    CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, 4, out.nodes.items, OFF(&out.nodes.items[8])),
                  CSTK_ERROR_INVALID_ARGUMENT, "count");
    CHECK_REFUSED(out,
                  cstk_body_get_node_corners(body, 0, 4, OFF(out.corners.items), &out.corners.count),
                  CSTK_ERROR_INVALID_ARGUMENT, "xyz");
    CHECK_REFUSED(out, cstk_body_get_node_corners(body, 0, 4, out.corners.items, OFF(&out)),
                  CSTK_ERROR_INVALID_ARGUMENT, "count");
    CHECK_REFUSED(out, cstk_mesh_create_from_nodes(body, off, 1, &out.mesh), CSTK_ERROR_INVALID_ARGUMENT,
                  "nodes");
    CHECK_FAILS(cstk_body_show_nodes(body, off, 1, "a.glb"), CSTK_ERROR_INVALID_ARGUMENT, "nodes");
}

static void numbers_out_of_range(const cstk_body *body) {
    cstk_hierarchy_statistics statistics;
    answer out;
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &statistics));
    CHECK(statistics.node_count == NODES && statistics.leaf_count == LEAVES);
    const uint32_t levels[] = {(uint32_t)statistics.depth, (uint32_t)statistics.depth + 1,
                               0x7FFFFFFFu, UINT32_MAX};
    const uint32_t nodes[] = {NODES, NODES + 1, 0x80000000u, UINT32_MAX};
    for (int i = 0; i < 4; ++i) {
        char level[32];
        char node[32];
        snprintf(level, sizeof level, "level %u", (unsigned)levels[i]);
        snprintf(node, sizeof node, "node %u", (unsigned)nodes[i]);
        const uint32_t list[3] = {0, nodes[i], 1};
        CHECK_REFUSED(out, cstk_body_get_level_statistics(body, levels[i], &out.level), CSTK_ERROR_NOT_FOUND, level);
        CHECK_REFUSED(out, cstk_body_get_level_nodes(body, levels[i], 4, out.nodes.items, &out.nodes.count),
                      CSTK_ERROR_NOT_FOUND, level);
        CHECK_REFUSED(out, cstk_body_get_level_nodes(body, levels[i], 0, NULL, &out.nodes.count),
                      CSTK_ERROR_NOT_FOUND, level);
        CHECK_REFUSED(out, cstk_body_get_node(body, nodes[i], &out.node), CSTK_ERROR_NOT_FOUND, node);
        CHECK_REFUSED(
            out, cstk_body_get_node_corners(body, nodes[i], 4, out.corners.items, &out.corners.count),
            CSTK_ERROR_NOT_FOUND, node);
        CHECK_REFUSED(out, cstk_mesh_create_from_nodes(body, list, 3, &out.mesh), CSTK_ERROR_NOT_FOUND, node);
        CHECK_FAILS(cstk_body_show_nodes(body, list, 3, "hostile_nodes.glb"), CSTK_ERROR_NOT_FOUND, node);
    }
    CHECK(access("hostile_nodes.glb", F_OK) != 0);
    CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, 0, out.nodes.items, &out.nodes.count),
                  CSTK_ERROR_INVALID_ARGUMENT, "max_count");
    CHECK_REFUSED(out, cstk_body_get_cover_nodes(body, 0, NULL, &out.nodes.count), CSTK_ERROR_INVALID_ARGUMENT,
                  "max_count");
    const size_t huge[] = {SIZE_MAX, SIZE_MAX / 4 + 1, SIZE_MAX / 8 + 1};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out, cstk_mesh_create_from_nodes(body, nodes, huge[i], &out.mesh), CSTK_ERROR_WRONG_SIZE,
                      "nodes");
        CHECK_FAILS(cstk_body_show_nodes(body, nodes, huge[i], "hostile_nodes.glb"),
                    CSTK_ERROR_WRONG_SIZE, "nodes");
    }
}

static void check_rest_untouched(const void *from, const void *end, const char *call) {
    check_untouched(from, (size_t)((const char *)end - (const char *)from), call, __FILE__,
                    __LINE__);
}

/* Room for fewer than there are: no more than that is written, but all are counted. Room for more
 * than memory holds: what there is is written. */
static void rooms(const cstk_body *body) {
    const size_t counts[] = {0, 1, 2, NODES, ROOM, SIZE_MAX / 4, SIZE_MAX};
    cstk_hierarchy_node root;
    CHECK_OK(cstk_body_get_node(body, 0, &root));
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        answer out;
        const size_t room = counts[i];
        for (uint32_t level = 0; level < 2; ++level) {
            const size_t all = level + 1;
            memset(&out, CHECK_SENTINEL, sizeof out);
            CHECK_OK(cstk_body_get_level_nodes(body, level, room, room > 0 ? out.nodes.items : NULL,
                                     &out.nodes.count));
            CHECK(out.nodes.count == all);
            check_rest_untouched(&out.nodes.items[room < all ? room : all], &out.nodes.items[ROOM],
                                 "level");
        }
        memset(&out, CHECK_SENTINEL, sizeof out);
        CHECK_OK(cstk_body_get_node_corners(body, 0, room, room > 0 ? out.corners.items : NULL,
                                        &out.corners.count));
        const size_t all = root.corner_count;
        CHECK(out.corners.count == all && all > 2 && all < ROOM);
        check_rest_untouched(&out.corners.items[3 * (room < all ? room : all)],
                             &out.corners.items[3 * ROOM], "node_corners");
        if (room > 0) {
            memset(&out, CHECK_SENTINEL, sizeof out);
            CHECK_OK(cstk_body_get_cover_nodes(body, room, out.nodes.items, &out.nodes.count));
            CHECK(out.nodes.count == (room < LEAVES ? room : LEAVES));
            check_rest_untouched(&out.nodes.items[out.nodes.count], &out.nodes.items[ROOM],
                                 "cover");
        }
    }
}

static void meshes(const fixture *f, const cstk_body *body) {
    cstk_mesh_view view;
    EACH_BAD_HANDLE(f, NOUN_MESH, bad) {
        CHECK_FAILS(cstk_mesh_retain(bad->handle), bad->status, "mesh");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_mesh_release(bad->handle), bad->status, "mesh");
        }
        CHECK_REFUSED(view, cstk_mesh_get_view(bad->handle, &view), bad->status, "mesh");
    }
    CHECK_FAILS(cstk_mesh_get_view(f->mesh, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(view, cstk_mesh_get_view(f->mesh, OFF(&view)), CSTK_ERROR_INVALID_ARGUMENT, "out");
    /* No nodes, no faces. */
    cstk_mesh *empty = NULL;
    CHECK_OK(cstk_mesh_create_from_nodes(body, NULL, 0, &empty));
    CHECK_OK(cstk_mesh_get_view(empty, &view));
    CHECK(view.vertex_count == 0 && view.face_count == 0 && view.index_count == 0);
    CHECK_OK(cstk_mesh_release(empty));
    fixture_unchanged(f);
}

/* Refused, and no file of that name stands there now. */
static void refuse_picture(const cstk_body *body, const char *file, cstk_status status,
                           const char *culprit) {
    const uint32_t root = 0;
    CHECK_FAILS(cstk_body_show_nodes(body, &root, 1, file), status, culprit);
    CHECK(file[0] == '\0' || strcmp(file, ".") == 0 || access(file, F_OK) != 0);
}

static void file_names(const fixture *f, const cstk_body *body) {
    char longest[5000];
    cstk_body *out;
    const uint32_t root = 0;
    memset(longest, 'x', sizeof longest);
    memcpy(longest + sizeof longest - 5, ".glb", 5);
    refuse_picture(body, "", CSTK_ERROR_UNSUPPORTED, ".glb");
    refuse_picture(body, ".", CSTK_ERROR_UNSUPPORTED, ".glb");
    refuse_picture(body, "hostile_nodes", CSTK_ERROR_UNSUPPORTED, "hostile_nodes");
    refuse_picture(body, "hostile_nodes.gltf", CSTK_ERROR_UNSUPPORTED, "hostile_nodes.gltf");
    refuse_picture(body, "hostile_nodes.glb/", CSTK_ERROR_IO, "hostile_nodes.glb");
    refuse_picture(body, ".glb", CSTK_ERROR_UNSUPPORTED, ".glb");
    refuse_picture(body, "no_such_folder/a.glb", CSTK_ERROR_IO, "no_such_folder");
    refuse_picture(body, longest, CSTK_ERROR_IO, "xxx");
    mkdir("hostile_folder.glb", 0777);
    CHECK_FAILS(cstk_body_show_nodes(body, &root, 1, "hostile_folder.glb"), CSTK_ERROR_IO,
                "hostile_folder.glb");
    CHECK_FAILS(cstk_body_save(body, "hostile_folder.glb"), CSTK_ERROR_IO, "hostile_folder.glb");
    CHECK_REFUSED(out, cstk_body_load("hostile_folder.glb", &out), CSTK_ERROR_IO, "hostile_folder.glb");
    CHECK(rmdir("hostile_folder.glb") == 0);
    CHECK_FAILS(cstk_body_save(body, ""), CSTK_ERROR_IO, "");
    CHECK_FAILS(cstk_body_save(body, "."), CSTK_ERROR_IO, ".");
    CHECK_FAILS(cstk_body_save(body, longest), CSTK_ERROR_IO, "xxx");
    CHECK_FAILS(cstk_body_save(body, "no_such_folder/a"), CSTK_ERROR_IO, "no_such_folder");
    CHECK_REFUSED(out, cstk_body_load("", &out), CSTK_ERROR_IO, "");
    CHECK_REFUSED(out, cstk_body_load("missing \xff.cstk", &out), CSTK_ERROR_IO, "missing");
    CHECK_REFUSED(out, cstk_body_load("no_such_folder/a", &out), CSTK_ERROR_IO, "no_such_folder");
    CHECK_REFUSED(out, cstk_body_load(longest, &out), CSTK_ERROR_IO, "xxx");
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    cstk_body *squares = make_squares();
    options_numbers(&f);
    options_choices(&f);
    options_extremes();
    old_caller(&f);
    sizes_in_between(&f);
    options_elsewhere(&f);
    describe_handles(&f);
    describe_null(squares);
    describe_misaligned(squares);
    numbers_out_of_range(squares);
    rooms(squares);
    meshes(&f, squares);
    file_names(&f, squares);
    CHECK_OK(cstk_body_release(squares));
    fixture_release(&f);
    least_limit();
    return check_result();
}
