/* Meshes and pictures of nodes: indices in range, faces that look outwards, what they enclose,
 * leaves as their primitives.
 */
#include <math.h>

#include "bodies.h"
#include "check.h"

/* Twice the signed area of a face, as a vector. */
static void face_area(const double *vertices, const uint32_t *face, uint32_t size, double area[3]) {
    memset(area, 0, 3 * sizeof(double));
    const double *a = &vertices[3 * face[0]];
    for (uint32_t k = 1; k + 1 < size; ++k) {
        const double *b = &vertices[3 * face[k]];
        const double *c = &vertices[3 * face[k + 1]];
        const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        area[0] += u[1] * v[2] - u[2] * v[1];
        area[1] += u[2] * v[0] - u[0] * v[2];
        area[2] += u[0] * v[1] - u[1] * v[0];
    }
}

/* What one node's mesh encloses, and whether its faces look outwards from the middle of its
 * vertices. */
static double enclosed(const cstk_mesh_view *view) {
    const uint32_t *face = view->indices;
    double middle[3] = {0, 0, 0};
    double volume = 0.0;
    for (size_t i = 0; i < 3 * view->vertex_count; ++i) {
        middle[i % 3] += view->vertices[i] / (double)view->vertex_count;
    }
    for (size_t i = 0; i < view->face_count; ++i) {
        double area[3];
        face_area(view->vertices, face, view->face_sizes[i], area);
        const double *corner = &view->vertices[3 * face[0]];
        const double from[3] = {corner[0] - middle[0], corner[1] - middle[1],
                                corner[2] - middle[2]};
        CHECK(dot(from, area) >= -1e-10 * sqrt(dot(area, area)) * (1.0 + sqrt(dot(from, from))));
        volume += dot(from, area) / 6.0;
        face += view->face_sizes[i];
    }
    return volume;
}

/* Counts match, indices are in range, faces have corners of their own and belong to the nodes asked
 * for. */
static void check_mesh(const cstk_mesh_view *view, const uint32_t *nodes, size_t count) {
    size_t sum = 0;
    for (size_t i = 0; i < view->face_count; ++i) {
        size_t k = 0;
        CHECK(view->face_sizes[i] >= 3 && sum + view->face_sizes[i] <= view->index_count);
        for (size_t a = 0; a < view->face_sizes[i]; ++a) {
            CHECK(view->indices[sum + a] < view->vertex_count);
            for (size_t b = 0; b < a; ++b) {
                CHECK(view->indices[sum + a] != view->indices[sum + b]);
            }
        }
        while (k < count && nodes[k] != view->face_nodes[i]) {
            ++k;
        }
        CHECK(k < count);
        sum += view->face_sizes[i];
    }
    CHECK(sum == view->index_count);
    for (size_t i = 0; i < 3 * view->vertex_count; ++i) {
        CHECK(isfinite(view->vertices[i]));
    }
    for (int k = 0; k < 4; ++k) {
        CHECK(view->reserved[k] == 0);
    }
}

static double wrapper_volume(const cstk_hierarchy_node *node, int32_t wrapper) {
    const double pi = 4.0 * atan(1.0);
    const int sphere =
        wrapper == CSTK_WRAPPER_TIGHT_SPHERE || wrapper == CSTK_WRAPPER_MERGED_SPHERE;
    return sphere ? 4.0 / 3.0 * pi * node->radius * node->radius * node->radius : -1.0;
}

/* The mesh of the root against its wrapper and its level's statistics. */
static void check_root_mesh(const cstk_body *body, int32_t wrapper) {
    const uint32_t root = 0;
    cstk_mesh *mesh = NULL;
    cstk_mesh_view view;
    cstk_hierarchy_node node;
    cstk_level_statistics level;
    CHECK_OK(cstk_mesh_create_from_nodes(body, &root, 1, &mesh));
    CHECK_OK(cstk_mesh_get_view(mesh, &view));
    CHECK_OK(cstk_body_get_node(body, root, &node));
    CHECK_OK(cstk_body_get_level_statistics(body, 0, &level));
    CHECK(level.volume > 0.0 && level.surface > 0.0 && level.leaves_above == 0);
    const double exact = wrapper_volume(&node, wrapper);
    const double drawn = enclosed(&view);
    if (exact >= 0.0) {
        CHECK(close_to(level.volume, exact, 1e-12));
        CHECK(close_to(level.surface, 3.0 * exact / node.radius, 1e-12));
        CHECK(drawn <= exact && drawn > 0.9 * exact);
    } else {
        CHECK(close_to(level.volume, drawn, 1e-9));
    }
    if (wrapper == CSTK_WRAPPER_ALIGNED_BOX) {
        cstk_body_statistics s;
        CHECK_OK(cstk_body_get_statistics(body, &s));
        const double size[3] = {s.high[0] - s.low[0], s.high[1] - s.low[1], s.high[2] - s.low[2]};
        CHECK(close_to(level.volume, size[0] * size[1] * size[2], 1e-12));
        CHECK(close_to(level.surface, 2.0 * half_surface(size), 1e-12));
    }
    for (size_t i = 0; i < view.vertex_count && exact >= 0.0; ++i) {
        CHECK(close_to(apart(&view.vertices[3 * i], node.center), node.radius, 1e-9));
    }
    CHECK_OK(cstk_mesh_release(mesh));
}

/* Leaves are shown as their primitives: every vertex is one of theirs, to the last bit. */
static void check_leaf_meshes(const cstk_body *body, const tree *t) {
    double xyz[3 * 64];
    for (uint32_t i = 0; i < t->count; ++i) {
        cstk_mesh *mesh = NULL;
        cstk_mesh_view view;
        if (!is_leaf(t, i)) {
            continue;
        }
        CHECK_OK(cstk_mesh_create_from_nodes(body, &i, 1, &mesh));
        CHECK_OK(cstk_mesh_get_view(mesh, &view));
        check_mesh(&view, &i, 1);
        const size_t count = primitive_vertices(body, t->nodes[i].primitive, xyz);
        CHECK(view.vertex_count == count);
        CHECK(memcmp(view.vertices, xyz, 3 * count * sizeof(double)) == 0);
        CHECK(count < 3 || view.face_count > 0);
        enclosed(&view);
        CHECK_OK(cstk_mesh_release(mesh));
    }
}

static uint32_t little_endian(const unsigned char *bytes) {
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* A binary glTF: magic, version, length; a chunk of JSON, a chunk of numbers, each a multiple of
 * four long. */
static void check_picture(const char *name) {
    FILE *file = fopen(name, "rb");
    CHECK(file != NULL && fseek(file, 0, SEEK_END) == 0);
    const size_t size = (size_t)ftell(file);
    unsigned char *bytes = malloc(size + 1);
    CHECK(bytes != NULL && size > 28);
    rewind(file);
    CHECK(fread(bytes, 1, size, file) == size && fclose(file) == 0);
    CHECK(memcmp(bytes, "glTF", 4) == 0 && little_endian(bytes + 4) == 2);
    CHECK(little_endian(bytes + 8) == size && size % 4 == 0);
    const size_t text = little_endian(bytes + 12);
    CHECK(memcmp(bytes + 16, "JSON", 4) == 0 && text % 4 == 0 && text < size - 28);
    CHECK(bytes[20] == '{');
    const unsigned char *numbers = bytes + 20 + text;
    CHECK(little_endian(numbers) == size - 28 - text && memcmp(numbers + 4, "BIN", 4) == 0);
    free(bytes);
    CHECK(remove(name) == 0);
}

static void check_shown(const cstk_body *body, const tree *t, int32_t wrapper) {
    uint32_t nodes[24];
    size_t count = 0;
    cstk_mesh *mesh = NULL;
    cstk_mesh_view view;
    CHECK_OK(cstk_body_get_cover_nodes(body, 24, nodes, &count));
    CHECK_OK(cstk_mesh_create_from_nodes(body, nodes, count, &mesh));
    CHECK_OK(cstk_mesh_get_view(mesh, &view));
    CHECK(view.face_count > 0);
    check_mesh(&view, nodes, count);
    CHECK_OK(cstk_mesh_release(mesh));
    check_root_mesh(body, wrapper);
    check_leaf_meshes(body, t);
    CHECK_OK(cstk_body_show_nodes(body, nodes, count, "node_meshes.glb"));
    check_picture("node_meshes.glb");
    /* A node may be asked for twice. */
    const uint32_t twice[2] = {nodes[0], nodes[0]};
    CHECK_OK(cstk_body_show_nodes(body, twice, 2, "node_meshes.glb"));
    check_picture("node_meshes.glb");
}

int main(void) {
    cstk_body_builder *builder = mixed_builder();
    for (int32_t k = 0; k < GROUPINGS * WRAPPERS; ++k) {
        const cstk_hierarchy_options options = options_of(k / WRAPPERS, k % WRAPPERS);
        cstk_body *body = build_body(builder, &options);
        tree t = read_tree(body);
        check_shown(body, &t, options.wrapper);
        free_tree(&t);
        CHECK_OK(cstk_body_release(body));
    }
    CHECK_OK(cstk_body_builder_release(builder));
    return check_result();
}
