/* Hierarchies of every grouping and wrapper: trees over all primitives, wrappers that hold what is
 * below them, levels and covers, statistics recomputed from the nodes; the same answers from any
 * tree. */
#include <math.h>

#include "bodies.h"
#include "check.h"
#include "fixture.h"

static double larger(double a, double b) { return a > b ? a : b; }
static double smaller(double a, double b) { return a < b ? a : b; }

/* How far a set of points reaches in a direction. */
static double reach(const double *points, size_t count, const double *direction) {
    double farthest = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        farthest = larger(farthest, dot(&points[3 * i], direction));
    }
    return farthest;
}

enum { DIRECTIONS = 26 + 24 };

/* Unit vectors: the axes and diagonals, and others. */
static const double *direction(int i) {
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

static void check_levels(const cstk_body *body, const tree *t, uint64_t depth) {
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

static void check_covers(const cstk_body *body, const tree *t) {
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

/* The size of the box by which a node is described: around its wrapper, or, where wrappers are made when they are looked at,
 * around the primitives. */
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

static void check_body(const cstk_body *body, const cstk_hierarchy_options *options) {
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

/* A body to ask distances of, and every way to build it. */
static void same_answers(const cstk_body *one, const cstk_body *other, const cstk_body *probe) {
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    for (int i = 0; i < 12; ++i) {
        double pose[12];
        cstk_distance_result d[2];
        bool within[2];
        random_pose(i, 8.0, pose);
        pose[3] += 100.0;
        pose[7] -= 50.0;
        pose[11] += 20.0;
        const cstk_body *bodies[2] = {one, other};
        for (int k = 0; k < 2; ++k) {
            CHECK_OK(
                cstk_pair_distance(query, bodies[k], identity_pose, probe, pose, INFINITY, &d[k]));
            CHECK_OK(
                cstk_pair_within(query, bodies[k], identity_pose, probe, pose, 0.5, &within[k]));
        }
        CHECK(d[0].kind == CSTK_DISTANCE_EXACT && d[1].kind == CSTK_DISTANCE_EXACT && within[0] == within[1]);
        CHECK(within[0] == (d[0].distance <= 0.5));
        CHECK(memcmp(&d[0].distance, &d[1].distance, sizeof(double)) == 0);
        CHECK(memcmp(&d[0].lower, &d[1].lower, sizeof(double)) == 0);
        CHECK(memcmp(&d[0].upper, &d[1].upper, sizeof(double)) == 0);
        CHECK(memcmp(d[0].r_point, d[1].r_point, sizeof d[0].r_point) == 0);
        CHECK(memcmp(d[0].s_point, d[1].s_point, sizeof d[0].s_point) == 0);
        CHECK(d[0].witness.r_primitive == d[1].witness.r_primitive);
        CHECK(d[0].witness.s_primitive == d[1].witness.s_primitive);
        CHECK(d[0].witness.r_tag == d[1].witness.r_tag);
    }
    CHECK_OK(cstk_query_release(query));
}

/* Every grouping with every kind of wrapper, and then some options that change trees. */
static void every_kind(void) {
    cstk_body_builder *builder = mixed_builder();
    cstk_body_builder *rings = torus_builder(6, 4);
    cstk_body *first = build_body(builder, NULL);
    cstk_body *probe = build_body(rings, NULL);
    for (int32_t grouping = 0; grouping < GROUPINGS; ++grouping) {
        for (int32_t wrapper = 0; wrapper < WRAPPERS; ++wrapper) {
            cstk_hierarchy_options options = options_of(grouping, wrapper);
            cstk_body *body = build_body(builder, &options);
            check_body(body, &options);
            same_answers(first, body, probe);
            CHECK_OK(cstk_body_release(body));
            options.aspect_limit = 3.0;
            options.pieces = CSTK_PIECES_PATCHES;
            body = build_body(builder, &options);
            check_body(body, &options);
            same_answers(first, body, probe);
            CHECK_OK(cstk_body_release(body));
        }
    }
    for (int i = 0; i < 7; ++i) {
        cstk_hierarchy_options options = default_options();
        *(i < 3   ? &options.cost_diameter
          : i < 5 ? &options.diameter_limit
                  : &options.gap_limit) = i % 2 ? 0.1 : 4.0;
        options.hull_vertex_limit = i < 4 ? 8 : 1000;
        options.pieces = i % 3;
        cstk_body *body = build_body(builder, &options);
        check_body(body, &options);
        same_answers(first, body, probe);
        CHECK_OK(cstk_body_release(body));
    }
    CHECK_OK(cstk_body_release(first));
    CHECK_OK(cstk_body_release(probe));
    CHECK_OK(cstk_body_builder_release(rings));
    CHECK_OK(cstk_body_builder_release(builder));
}

/* Bodies of one leaf, of the same primitive many times, of the plane, of the largest coordinates.
 */
static void odd_bodies(void) {
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const double huge[12] = {-1e50, -1e50, 1e50, 1e50,  -1e50, 1e50,
                             1e50,  1e50,  1e50, -1e50, 1e50,  1e50};
    const double tiny[12] = {0, 0, 0, 1e-49, 0, 0, 1e-49, 1e-49, 0, 0, 1e-49, 0};
    for (int kind = 0; kind < 5; ++kind) {
        const double *points = kind < 3 ? square : kind == 3 ? huge : tiny;
        cstk_body_builder *builder = NULL;
        CHECK_OK(cstk_body_builder_create(kind == 2 ? 2 : 3, &builder));
        for (int i = 0; i < (kind == 0 ? 1 : 20); ++i) {
            CHECK_OK(cstk_body_builder_add_polyhedron(builder, points, kind == 1 ? 1 : 4, 7));
        }
        for (int32_t k = 0; k < GROUPINGS * WRAPPERS; ++k) {
            cstk_hierarchy_options options = options_of(k / WRAPPERS, k % WRAPPERS);
            options.cost_diameter = k % 2 ? 16.0 : 1.0;
            cstk_body *body = build_body(builder, &options);
            cstk_hierarchy_statistics s;
            tree t = read_tree(body);
            CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
            CHECK(t.count == (kind == 0 ? 1 : 39) && s.node_count == t.count);
            CHECK(isfinite(s.expected_cost) && s.expected_cost > 0.0);
            CHECK(isfinite(s.balance) && s.balance >= 1.0 && isfinite(s.fill) && s.fill >= 0.0);
            check_levels(body, &t, s.depth);
            check_covers(body, &t);
            free_tree(&t);
            CHECK_OK(cstk_body_release(body));
        }
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

enum { PLANKS = 6 };

/* Planks of 40 by 1/2, side by side along x or y. */
static cstk_body_builder *plank_builder(int along) {
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    for (int i = 0; i < PLANKS; ++i) {
        double xyz[12];
        for (int k = 0; k < 4; ++k) {
            xyz[3 * k + along] = k == 1 || k == 2 ? 20.0 : -20.0;
            xyz[3 * k + 1 - along] = i - 3.0 + (k >= 2 ? 0.5 : 0.0);
            xyz[3 * k + 2] = 0.0;
        }
        CHECK_OK(cstk_body_builder_add_polygon(builder, xyz, 4, (uint64_t)i));
    }
    return builder;
}

/* Every plank of one body crosses every plank of the other at a distance of 1. */
static void witnesses(const cstk_body *a, const cstk_body *b, size_t max_count) {
    double above[12];
    int met[PLANKS][PLANKS] = {{0}};
    cstk_witness_list list;
    cstk_query *query = NULL;
    translation(0, 0, 1, above);
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_pair_witnesses(query, a, identity_pose, b, above, 1.25, max_count, &list));
    const size_t all = PLANKS * PLANKS;
    CHECK(list.witness_count == (max_count < all ? max_count : all));
    CHECK(list.truncated == (max_count < all));
    for (size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness *w = &list.witnesses[i];
        CHECK(w->r_primitive < PLANKS && w->s_primitive < PLANKS);
        CHECK(w->r_tag == w->r_primitive && w->s_tag == w->s_primitive);
        CHECK(met[w->r_primitive][w->s_primitive]++ == 0);
        CHECK(fabs(w->distance - 1.0) < 1e-13 && w->contact_count == 4);
    }
    CHECK_OK(cstk_pair_witnesses(query, a, identity_pose, b, above, 0.75, max_count, &list));
    CHECK(list.witness_count == 0);
    CHECK_OK(cstk_query_release(query));
}

/* How far a point lies outside a node's wrapper or sphere, as far as that can be seen in some
 * directions. */
static double outside(const tree *t, size_t node, const double *point) {
    const cstk_hierarchy_node *n = &t->nodes[node];
    double out = apart(point, n->center) - n->radius;
    for (int k = 0; k < DIRECTIONS; ++k) {
        const double *along = direction(k);
        const double own = reach(&t->corners[3 * t->first[node]], n->corner_count, along);
        out = larger(out, dot(point, along) - own - n->excess);
    }
    return out;
}

/* Every point of a slender primitive lies in the wrapper of one of its leaves, all of which are
 * shorter than it. */
static void check_slabs(const cstk_body *body, uint32_t plank) {
    tree t = read_tree(body);
    double xyz[3 * 64];
    CHECK(primitive_vertices(body, plank, xyz) == 4);
    for (int k = 0; k <= 60; ++k) {
        const double u = k / 60.0;
        const double v = (k % 7) / 6.0;
        double point[3];
        double least = INFINITY;
        for (int axis = 0; axis < 3; ++axis) {
            point[axis] = xyz[axis] + u * (xyz[3 + axis] - xyz[axis]);
            point[axis] += v * (xyz[9 + axis] - xyz[axis]);
        }
        for (size_t i = 0; i < t.count; ++i) {
            if (is_leaf(&t, i) && t.nodes[i].primitive == plank) {
                CHECK(t.nodes[i].radius < 4.0);
                least = smaller(least, outside(&t, i, point));
            }
        }
        CHECK(least <= 1e-12);
    }
    free_tree(&t);
}

static void slender(void) {
    const double limits[] = {0.0, 1.5, 2.0, 10.0, 79.0, 1e300};
    cstk_body_builder *builders[2] = {plank_builder(0), plank_builder(1)};
    for (int32_t k = 0; k < GROUPINGS * WRAPPERS; ++k) {
        /* Every wrapper of the first grouping, the first wrapper of every other. */
        for (int i = 0; i < 6 && (k < WRAPPERS || k % WRAPPERS == 0); ++i) {
            cstk_hierarchy_options options = options_of(k / WRAPPERS, k % WRAPPERS);
            cstk_hierarchy_statistics s;
            cstk_body *bodies[2];
            options.aspect_limit = limits[i];
            for (int side = 0; side < 2; ++side) {
                bodies[side] = build_body(builders[side], &options);
            }
            CHECK_OK(cstk_body_get_hierarchy_statistics(bodies[0], &s));
            /* Their length is 80 times their width. */
            const int cut = limits[i] > 0.0 && limits[i] < 80.0;
            if (cut ? s.leaf_count <= PLANKS : s.leaf_count != PLANKS) {
                fprintf(stderr, "aspect_limit %g: %d planks of aspect 80 have %d leaves\n",
                        limits[i], PLANKS, (int)s.leaf_count);
                ++check_failures;
            }
            witnesses(bodies[0], bodies[1], SIZE_MAX);
            witnesses(bodies[0], bodies[1], 10);
            if (cut && s.leaf_count > PLANKS && k < WRAPPERS) {
                check_slabs(bodies[0], (uint32_t)i);
                check_body(bodies[0], &options);
            }
            CHECK_OK(cstk_body_release(bodies[0]));
            CHECK_OK(cstk_body_release(bodies[1]));
        }
    }
    CHECK_OK(cstk_body_builder_release(builders[0]));
    CHECK_OK(cstk_body_builder_release(builders[1]));
}

/* A square cut into sixteen, and the six faces of a cube: convex pieces of the body. */
static void pieces(void) {
    for (int32_t kind = CSTK_PIECES_OFF; kind <= CSTK_PIECES_PATCHES; ++kind) {
        cstk_body_builder *builder = NULL;
        cstk_hierarchy_options options = default_options();
        cstk_hierarchy_statistics s;
        CHECK_OK(cstk_body_builder_create(3, &builder));
        for (int i = 0; i < 16; ++i) {
            const double x = i % 4;
            const double y = i / 4;
            const double cell[12] = {x, y, 0, x + 1, y, 0, x + 1, y + 1, 0, x, y + 1, 0};
            CHECK_OK(cstk_body_builder_add_polygon(builder, cell, 4, 0));
        }
        options.pieces = kind;
        cstk_body *body = build_body(builder, &options);
        check_body(body, &options);
        CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
        if ((s.piece_count > 0) != (kind != CSTK_PIECES_OFF)) {
            fprintf(stderr, "pieces %d: %d pieces of a square cut into sixteen\n", (int)kind,
                    (int)s.piece_count);
            ++check_failures;
        }
        CHECK_OK(cstk_body_release(body));
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

int main(void) {
    every_kind();
    odd_bodies();
    slender();
    pieces();
    return check_result();
}
