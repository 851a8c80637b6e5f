#include "bodies.h"

#include <math.h>

#include "check.h"

enum { MOST_FACES = 4096 };

static const double middle[3] = {100.0, -50.0, 20.0};

/* Vertices and quadrilaterals of a torus about the z axis. Returns the number of vertices. */
static size_t torus(int around, int across, const double at[3], double *xyz, uint32_t *indices) {
    const double turn = 8.0 * atan(1.0);
    CHECK(around * across <= MOST_FACES);
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double a = turn * i / around;
            const double b = turn * j / across;
            double *vertex = &xyz[3 * (i * across + j)];
            uint32_t *face = &indices[4 * (i * across + j)];
            const int next_i = (i + 1) % around;
            const int next_j = (j + 1) % across;
            vertex[0] = at[0] + (3.0 + cos(b)) * cos(a);
            vertex[1] = at[1] + (3.0 + cos(b)) * sin(a);
            vertex[2] = at[2] + sin(b);
            face[0] = (uint32_t)(i * across + j);
            face[1] = (uint32_t)(next_i * across + j);
            face[2] = (uint32_t)(next_i * across + next_j);
            face[3] = (uint32_t)(i * across + next_j);
        }
    }
    return (size_t)(around * across);
}

static void add_faces(cstk_body_builder *builder, const double *xyz, size_t vertices,
                      const uint32_t *indices, size_t faces) {
    static uint32_t sizes[MOST_FACES + 8];
    CHECK(faces <= MOST_FACES + 8);
    for (size_t i = 0; i < faces; ++i) {
        sizes[i] = 4;
    }
    CHECK_OK(cstk_body_builder_add_mesh(builder, xyz, vertices, sizes, faces, indices, 4 * faces,
                                        NULL, NULL));
}

cstk_body_builder *torus_builder(int around, int across) {
    static double xyz[3 * MOST_FACES];
    static uint32_t indices[4 * MOST_FACES];
    const double at[3] = {0, 0, 0};
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    const size_t count = torus(around, across, at, xyz, indices);
    add_faces(builder, xyz, count, indices, count);
    return builder;
}

static void add_solids(cstk_body_builder *builder, uint64_t tag) {
    for (int i = 0; i < 6; ++i) {
        double corners[24];
        for (int k = 0; k < 8; ++k) {
            corners[3 * k] = middle[0] + 2.0 * i + (k & 1 ? 0.7 : 0.0);
            corners[3 * k + 1] = middle[1] + 0.3 * i * i + (k & 2 ? 0.4 + 0.1 * i : 0.0);
            corners[3 * k + 2] = middle[2] + 5.0 + (k & 4 ? 0.2 : 0.0);
        }
        CHECK_OK(cstk_body_builder_add_polyhedron(builder, corners, i % 2 ? 8 : 5, tag++));
    }
    /* A prism of forty corners has more than a hull wrapper may have. */
    double prism[120];
    for (int k = 0; k < 40; ++k) {
        const double angle = 0.1 * atan(1.0) * 4.0 * (k % 20);
        prism[3 * k] = middle[0] - 6.0 + cos(angle);
        prism[3 * k + 1] = middle[1] + sin(angle);
        prism[3 * k + 2] = middle[2] + (k < 20 ? 0.0 : 2.0);
    }
    CHECK_OK(cstk_body_builder_add_polyhedron(builder, prism, 40, tag));
}

cstk_body_builder *mixed_builder(void) {
    static double xyz[3 * MOST_FACES];
    static uint32_t indices[4 * MOST_FACES];
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    const size_t count = torus(10, 6, middle, xyz, indices);
    /* A bent face is split in two, one without area dropped. */
    const uint32_t more[8] = {0, 7, 20, 33, 5, 5, 5, 5};
    memcpy(indices + 4 * count, more, sizeof more);
    add_faces(builder, xyz, count, indices, count + 2);
    add_solids(builder, 1000);
    for (int i = 0; i < 4; ++i) {
        const double x = middle[0] - 8.0;
        const double y = middle[1] + 4.0 + 0.5 * i;
        const double z = middle[2] - 2.0;
        const double plank[12] = {
            x, y, z, x + 16, y + i, z + 0.25 * i, x + 16, y + i, z + 0.25 * i + 0.1, x, y, z + 0.1};
        CHECK_OK(cstk_body_builder_add_polygon(builder, plank, 4, 1100 + (uint64_t)i));
    }
    double others[24];
    for (int k = 0; k < 8; ++k) {
        others[3 * k] = middle[0] + (k & 1) + 0.25 * (k & 4);
        others[3 * k + 1] = middle[1] + (k & 2);
        others[3 * k + 2] = middle[2] - 4.0;
    }
    CHECK_OK(cstk_body_builder_add_polyhedron(builder, others, 8, UINT64_MAX));
    CHECK_OK(cstk_body_builder_add_polyhedron(builder, others, 2, 1201));
    CHECK_OK(cstk_body_builder_add_polyhedron(builder, others, 1, 1202));
    return builder;
}

cstk_hierarchy_options default_options(void) {
    cstk_hierarchy_options options;
    CHECK_OK(cstk_hierarchy_options_default(&options, sizeof options));
    return options;
}

cstk_hierarchy_options options_of(int32_t grouping, int32_t wrapper) {
    cstk_hierarchy_options options = default_options();
    options.grouping = grouping;
    options.wrapper = wrapper;
    return options;
}

cstk_body *build_body(cstk_body_builder *builder, const cstk_hierarchy_options *options) {
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_build(builder, options, NULL, NULL, &body));
    return body;
}

void random_pose(int i, double reach, double pose[12]) {
    uint64_t state = 0x9E3779B97F4A7C15u * (uint64_t)(i + 1);
    double placement[6];
    for (int k = 0; k < 6; ++k) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        placement[k] = 2.0 * (double)(state >> 11) / 9007199254740992.0 - 1.0;
        placement[k] *= k < 3 ? reach : 3.0;
    }
    CHECK_OK(cstk_pose_from_euler(placement, pose));
}

size_t primitive_vertices(const cstk_body *body, uint32_t primitive, double *xyz) {
    for (uint32_t vertex = 0; vertex < 64; ++vertex) {
        size_t count = 0;
        const cstk_status status = cstk_body_get_feature_vertices(body, primitive, CSTK_FEATURE_VERTEX, vertex,
                                                              1, &xyz[3 * vertex], &count);
        if (status == CSTK_ERROR_NOT_FOUND && vertex > 0) {
            return vertex;
        }
        CHECK_STATUS(status, CSTK_OK);
        CHECK(count == 1);
    }
    CHECK(!"a primitive of so many vertices");
    return 0;
}

int is_leaf(const tree *t, size_t node) { return t->nodes[node].children[0] == UINT32_MAX; }

static void *room(size_t count, size_t size) {
    void *memory = calloc(count + 1, size);
    CHECK(memory != NULL);
    return memory;
}

static void read_node(const cstk_body *body, tree *t, size_t i) {
    size_t count = 0;
    CHECK_OK(cstk_body_get_node(body, (uint32_t)i, &t->nodes[i]));
    const cstk_hierarchy_node *node = &t->nodes[i];
    t->first[i + 1] = t->first[i] + node->corner_count;
    t->corners = realloc(t->corners, 3 * t->first[i + 1] * sizeof(double));
    CHECK(t->corners != NULL && node->corner_count > 0);
    CHECK_OK(cstk_body_get_node_corners(body, (uint32_t)i, node->corner_count,
                                    &t->corners[3 * t->first[i]], &count));
    CHECK(count == node->corner_count);
    CHECK(node->is_piece <= 1);
    for (int k = 0; k < 4; ++k) {
        CHECK(node->reserved[k] == 0);
    }
}

/* One tree, depth first, each primitive in a leaf. */
static void check_order(const cstk_body *body, tree *t) {
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    unsigned char *met = room(statistics.primitive_count, 1);
    for (size_t i = t->count; i-- > 0;) {
        const cstk_hierarchy_node *node = &t->nodes[i];
        t->sizes[i] = 1;
        if (is_leaf(t, i)) {
            CHECK(node->children[1] == UINT32_MAX);
            CHECK(node->primitive < statistics.primitive_count);
            met[node->primitive] = 1;
            continue;
        }
        const size_t a = node->children[0];
        const size_t b = node->children[1];
        CHECK(node->primitive == UINT32_MAX);
        CHECK(a == i + 1 && b == a + t->sizes[a] && b < t->count);
        t->sizes[i] = 1 + t->sizes[a] + t->sizes[b];
    }
    CHECK(t->sizes[0] == t->count);
    for (size_t i = 0; i < t->count; ++i) {
        for (int k = 0; k < 2 && !is_leaf(t, i); ++k) {
            t->levels[t->nodes[i].children[k]] = t->levels[i] + 1;
        }
    }
    for (size_t i = 0; i < statistics.primitive_count; ++i) {
        CHECK(met[i]);
    }
    free(met);
}

tree read_tree(const cstk_body *body) {
    tree t = {0, NULL, NULL, NULL, NULL, NULL};
    cstk_hierarchy_statistics statistics;
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &statistics));
    t.count = statistics.node_count;
    t.nodes = room(t.count, sizeof *t.nodes);
    t.levels = room(t.count, sizeof *t.levels);
    t.sizes = room(t.count, sizeof *t.sizes);
    t.first = room(t.count, sizeof *t.first);
    for (size_t i = 0; i < t.count; ++i) {
        read_node(body, &t, i);
    }
    check_order(body, &t);
    return t;
}

void free_tree(tree *t) {
    free(t->nodes);
    free(t->levels);
    free(t->sizes);
    free(t->first);
    free(t->corners);
}

int same_trees(const tree *a, const tree *b) {
    return a->count == b->count && memcmp(a->nodes, b->nodes, a->count * sizeof *a->nodes) == 0 &&
           memcmp(a->corners, b->corners, 3 * a->first[a->count] * sizeof(double)) == 0;
}

int close_to(double a, double b, double tolerance) {
    return fabs(a - b) <= tolerance * (1.0 + fabs(b));
}

double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double apart(const double *a, const double *b) {
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dot(d, d));
}

double half_surface(const double *s) { return s[0] * s[1] + s[1] * s[2] + s[2] * s[0]; }
