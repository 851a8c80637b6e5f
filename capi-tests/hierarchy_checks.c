#include "hierarchy_checks.h"

#include <math.h>

#include "check.h"

double larger(double a, double b) { return a > b ? a : b; }
double smaller(double a, double b) { return a < b ? a : b; }

/* How far a set of points reaches in a direction. */
double reach(const double *points, size_t count, const double *direction) {
    double farthest = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        farthest = larger(farthest, dot(&points[3 * i], direction));
    }
    return farthest;
}

/* Unit vectors: the axes and diagonals, and others. */
const double *direction(int i) {
    static double all[DIRECTIONS][3];
    if (all[0][0] == 0.0) {
        for (int k = 0; k < DIRECTIONS; ++k) {
            const int code = k < 13 ? k : k + 1; /* 13 is the null vector */
            double *d = all[k];
            if (k < 26) {
                d[0] = code % 3 - 1;
                d[1] = code / 3 % 3 - 1;
                d[2] = code / 9 - 1;
            } else {
                d[0] = sin(1.7 * k);
                d[1] = sin(2.9 * k + 1.0);
                d[2] = sin(4.3 * k + 2.0);
            }
            const double length = sqrt(dot(d, d));
            for (int axis = 0; axis < 3; ++axis) {
                d[axis] /= length;
            }
        }
    }
    return all[i];
}

/* The vertices of all primitives. */
typedef struct model {
    cstk_body_statistics statistics;
    double *vertices;
    size_t *first;
    /* The largest coordinate, for tolerances. */
    double largest;
} model;

static model read_model(const cstk_body *body) {
    model m;
    CHECK_OK(cstk_body_get_statistics(body, &m.statistics));
    m.vertices = malloc(3 * 64 * sizeof(double) * m.statistics.primitive_count);
    m.first = calloc(m.statistics.primitive_count + 1, sizeof *m.first);
    CHECK(m.vertices != NULL && m.first != NULL);
    m.largest = 0.0;
    for (size_t i = 0; i < m.statistics.primitive_count; ++i) {
        m.first[i + 1] =
            m.first[i] + primitive_vertices(body, (uint32_t)i, &m.vertices[3 * m.first[i]]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        m.largest = larger(m.largest, fabs(m.statistics.low[axis]));
        m.largest = larger(m.largest, fabs(m.statistics.high[axis]));
    }
    return m;
}

static void free_model(model *m) {
    free(m->vertices);
    free(m->first);
}

/* The leaves of each primitive. */
static size_t *leaves_per_primitive(const tree *t, const model *m, size_t from, size_t end) {
    size_t *leaves = calloc(m->statistics.primitive_count, sizeof *leaves);
    CHECK(leaves != NULL);
    for (size_t i = from; i < end; ++i) {
        if (is_leaf(t, i)) {
            ++leaves[t->nodes[i].primitive];
        }
    }
    return leaves;
}

/* Oracle: the vertices of the primitives that are wholly below a node. */
static size_t vertices_below(const tree *t, const model *m, size_t node, double *xyz) {
    size_t *all = leaves_per_primitive(t, m, 0, t->count);
    size_t *below = leaves_per_primitive(t, m, node, node + t->sizes[node]);
    size_t count = 0;
    for (size_t i = 0; i < m->statistics.primitive_count; ++i) {
        if (below[i] > 0 && below[i] == all[i]) {
            const size_t vertices = m->first[i + 1] - m->first[i];
            memcpy(&xyz[3 * count], &m->vertices[3 * m->first[i]], 3 * vertices * sizeof(double));
            count += vertices;
        }
    }
    free(all);
    free(below);
    return count;
}

/* The wrapper reaches as far as the points in every direction, and the sphere holds them. */
static void check_wrapper(const cstk_hierarchy_node *node, const double *corners,
                          const double *points, size_t count, double rounding) {
    for (int k = 0; k < DIRECTIONS; ++k) {
        const double *along = direction(k);
        const double own = reach(corners, node->corner_count, along) + node->excess;
        CHECK(count == 0 || reach(points, count, along) <= own + rounding);
    }
    for (size_t i = 0; i < count; ++i) {
        CHECK(apart(&points[3 * i], node->center) <= node->radius + rounding);
    }
}

/* What is said of the kinds of wrappers. `limit` is that of a hull's vertices. */
static void check_kind(int32_t wrapper, uint32_t limit, const cstk_hierarchy_node *node,
                       const double *corners, const double *points, size_t count, double rounding) {
    CHECK(node->excess >= 0.0 && node->radius >= 0.0);
    if (wrapper == CSTK_WRAPPER_TIGHT_SPHERE || wrapper == CSTK_WRAPPER_MERGED_SPHERE) {
        CHECK(node->corner_count == 1 && node->excess == node->radius);
        CHECK(apart(corners, node->center) == 0.0);
        return;
    }
    /* Hulls and boxes are grown by rounding only, hulls perhaps by a millionth. */
    CHECK(node->excess <= 1e-5 * node->radius + rounding);
    if (wrapper == CSTK_WRAPPER_HULL) {
        /* A convex piece is bounded exactly, whatever it takes. */
        CHECK(node->is_piece || node->corner_count <= (limit > 8 ? limit : 8));
        return;
    }
    CHECK(node->corner_count == 8);
    /* An aligned box is exact, and so the points' reach along the axes is met. */
    for (int axis = 0; axis < 6 && wrapper == CSTK_WRAPPER_ALIGNED_BOX && count > 0; ++axis) {
        double along[3] = {0, 0, 0};
        along[axis / 2] = axis % 2 ? 1.0 : -1.0;
        CHECK(reach(points, count, along) == reach(corners, 8, along));
    }
}

static void check_wrappers(const tree *t, const model *m, const cstk_hierarchy_options *options) {
    double *points = malloc(3 * sizeof(double) * m->first[m->statistics.primitive_count]);
    const double rounding = 1e-13 * m->largest;
    CHECK(points != NULL);
    for (size_t i = 0; i < t->count; ++i) {
        const double *corners = &t->corners[3 * t->first[i]];
        const size_t count = vertices_below(t, m, i, points);
        check_wrapper(&t->nodes[i], corners, points, count, rounding);
        check_kind(options->wrapper, options->hull_vertex_limit, &t->nodes[i], corners, points,
                   options->aspect_limit > 0.0 ? 0 : count, rounding);
    }
    free(points);
}

/* The nodes' subtrees hold every leaf once. */
static void check_partition(const tree *t, const uint32_t *nodes, size_t count) {
    unsigned char *met = calloc(t->count, 1);
    CHECK(met != NULL);
    for (size_t i = 0; i < count; ++i) {
        CHECK(nodes[i] < t->count);
        for (size_t k = nodes[i]; k < nodes[i] + t->sizes[nodes[i]]; ++k) {
            met[k] += (unsigned char)is_leaf(t, k);
        }
    }
    for (size_t i = 0; i < t->count; ++i) {
        CHECK(met[i] == is_leaf(t, i));
    }
    free(met);
}

void check_levels(const cstk_body *body, const tree *t, uint64_t depth) {
    uint32_t *nodes = malloc(t->count * sizeof *nodes);
    CHECK(nodes != NULL);
    uint32_t deepest = 0;
    for (size_t i = 0; i < t->count; ++i) {
        deepest = t->levels[i] > deepest ? t->levels[i] : deepest;
    }
    CHECK(depth == deepest + 1u);
    for (uint32_t level = 0; level < depth; ++level) {
        cstk_level_statistics statistics;
        size_t count = 0;
        size_t on_level = 0;
        CHECK_OK(cstk_body_get_level_statistics(body, level, &statistics));
        CHECK_OK(cstk_body_get_level_nodes(body, level, t->count, nodes, &count));
        for (size_t i = 0; i < count; ++i) {
            CHECK(t->levels[nodes[i]] <= level);
            on_level += t->levels[nodes[i]] == level;
        }
        CHECK(statistics.node_count == on_level && statistics.leaves_above == count - on_level);
        CHECK(statistics.volume >= 0.0 && statistics.surface >= 0.0);
        check_partition(t, nodes, count);
    }
    free(nodes);
}

void check_covers(const cstk_body *body, const tree *t) {
    const size_t leaves = (t->count + 1) / 2;
    const size_t counts[] = {1, 2, 3, 5, 17, leaves / 2 + 1, leaves, leaves + 10, SIZE_MAX};
    uint32_t *nodes = malloc((leaves + 10) * sizeof *nodes);
    CHECK(nodes != NULL);
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        size_t count = 0;
        CHECK_OK(cstk_body_get_cover_nodes(body, counts[i], nodes, &count));
        CHECK(count >= 1 && count <= counts[i]);
        check_partition(t, nodes, count);
        /* There is room for all leaves: every interior node is opened. */
        CHECK(counts[i] < leaves || count == leaves);
        CHECK(counts[i] > 1 || nodes[0] == 0);
    }
    free(nodes);
}

/* Widens a box (low and high of each axis) to hold points with a margin around them. */
static void hold(const double *points, size_t count, double margin, double box[6]) {
    for (size_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const double at = points[3 * i + axis];
            box[2 * axis] = -larger(-box[2 * axis], margin - at);
            box[2 * axis + 1] = larger(box[2 * axis + 1], at + margin);
        }
    }
}

static void hold_primitives(const tree *t, const model *m, size_t node, double box[6]) {
    if (is_leaf(t, node)) {
        const size_t first = m->first[t->nodes[node].primitive];
        const size_t end = m->first[t->nodes[node].primitive + 1];
        hold(&m->vertices[3 * first], end - first, 0.0, box);
        return;
    }
    for (int k = 0; k < 2; ++k) {
        hold_primitives(t, m, t->nodes[node].children[k], box);
    }
}

/* The size of the box by which a node is described: around its wrapper, or, where wrappers are made
 * when they are looked at, around the primitives. */
static void box_of(const tree *t, const model *m, const cstk_hierarchy_options *options,
                   size_t node, double size[3]) {
    double box[6] = {INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY};
    if (options->wrapper == CSTK_WRAPPER_HULL && options->aspect_limit == 0.0) {
        hold_primitives(t, m, node, box);
    } else {
        hold(&t->corners[3 * t->first[node]], t->nodes[node].corner_count, t->nodes[node].excess,
             box);
    }
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = box[2 * axis + 1] - box[2 * axis];
    }
}

/* Every number of the statistics from the nodes, by the words of the header. */
static void check_statistics(const cstk_body *body, const tree *t, const model *m,
                             const cstk_hierarchy_options *options) {
    cstk_hierarchy_statistics s;
    cstk_body_statistics of_body;
    double levels = 0.0;
    double balance = 0.0;
    double fill = 0.0;
    double cost = 1.0;
    uint64_t leaves = 0;
    uint64_t pieces = 0;
    double root[3];
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
    CHECK_OK(cstk_body_get_statistics(body, &of_body));
    box_of(t, m, options, 0, root);
    for (size_t i = 0; i < t->count; ++i) {
        double own[3];
        box_of(t, m, options, i, own);
        pieces += t->nodes[i].is_piece;
        if (is_leaf(t, i)) {
            ++leaves;
            levels += t->levels[i];
            cost += 4.0 * half_surface(own) / half_surface(root);
            continue;
        }
        double child[2];
        for (int k = 0; k < 2; ++k) {
            double size[3];
            box_of(t, m, options, t->nodes[i].children[k], size);
            child[k] = larger(sqrt(dot(size, size)), 1e-9 * sqrt(dot(root, root)));
        }
        cost += 2.0 * half_surface(own) / half_surface(root);
        balance += larger(child[0] / child[1], child[1] / child[0]);
        fill += sqrt(dot(own, own)) / (child[0] + child[1]);
    }
    const double interior = (double)(t->count - leaves);
    CHECK(s.wrapper == options->wrapper && s.reserved_0 == 0);
    CHECK(s.node_count == t->count && s.leaf_count == leaves && s.node_count == 2 * leaves - 1);
    CHECK(s.node_count == of_body.node_count && s.depth == of_body.depth);
    CHECK(s.piece_count == pieces && (options->pieces != CSTK_PIECES_OFF || pieces == 0));
    CHECK(close_to(s.mean_leaf_level, levels / (double)leaves, 1e-12));
    CHECK(s.balance >= 1.0 && close_to(s.balance, balance / interior, 1e-6));
    CHECK(s.fill > 0.0 && close_to(s.fill, fill / interior, 1e-6));
    CHECK(s.expected_cost > 0.0 && close_to(s.expected_cost, cost, 1e-6));
    CHECK(s.preparation_seconds >= 0.0 && s.preparation_seconds < 300.0);
    CHECK(s.grouping_seconds >= 0.0 && s.grouping_seconds < 300.0);
    CHECK(s.construction_seconds >= 0.0 && s.construction_seconds < 300.0);
    /* A corner takes three doubles. */
    CHECK(s.memory_bytes >= 24 * t->first[t->count] && s.memory_bytes < 1000 * t->count + 100000);
    for (int k = 0; k < 8; ++k) {
        CHECK(s.reserved[k] == 0);
    }
}

void check_body(const cstk_body *body, const cstk_hierarchy_options *options) {
    tree t = read_tree(body);
    model m = read_model(body);
    cstk_hierarchy_statistics statistics;
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &statistics));
    size_t *leaves = leaves_per_primitive(&t, &m, 0, t.count);
    for (size_t i = 0; i < m.statistics.primitive_count; ++i) {
        CHECK(leaves[i] == 1 || (options->aspect_limit > 0.0 && leaves[i] > 1));
    }
    free(leaves);
    check_wrappers(&t, &m, options);
    check_levels(body, &t, statistics.depth);
    check_covers(body, &t);
    check_statistics(body, &t, &m, options);
    free_model(&m);
    free_tree(&t);
}
