/* Bodies with hierarchies worth looking at, and hierarchies read out node by node. */
#ifndef CSTK_TESTS_BODIES_H
#define CSTK_TESTS_BODIES_H

#include <cstk.h>

/* How many there are. */
enum { GROUPINGS = CSTK_GROUPING_TOP_DOWN + 1 };
enum { WRAPPERS = CSTK_WRAPPER_MERGED_SPHERE + 1 };

/* Far from the origin: a torus of quadrilaterals with a bent and a flat face in its mesh, solids,
 * slender polygons, a flat polyhedron, a segment and a point; tagged 1000 and up after the mesh. */
cstk_body_builder *mixed_builder(void);

/* A torus of `around` times `across` quadrilaterals about the origin, and nothing else. */
cstk_body_builder *torus_builder(int around, int across);

/* The default options. */
cstk_hierarchy_options default_options(void);
cstk_hierarchy_options options_of(int32_t grouping, int32_t wrapper);

/* Builds; `options` may be NULL. */
cstk_body *build_body(cstk_body_builder *builder, const cstk_hierarchy_options *options);

/* The i-th of some poses that turn about all axes and shift by at most `reach` along each. */
void random_pose(int i, double reach, double pose[12]);

/* All vertices of a primitive into `xyz`, which has room for 64; returns their number. */
size_t primitive_vertices(const cstk_body *body, uint32_t primitive, double *xyz);

typedef struct tree {
    size_t count;
    cstk_hierarchy_node *nodes;
    /* Per node: its level, and the number of nodes of its subtree, which follow it. */
    uint32_t *levels;
    size_t *sizes;
    /* The corners of node i begin at 3 * first[i]. */
    size_t *first;
    double *corners;
} tree;

/* The whole hierarchy. Ends the program unless it is one tree in depth-first order whose leaves
 * hold all primitives. */
tree read_tree(const cstk_body *body);
void free_tree(tree *t);

int is_leaf(const tree *t, size_t node);

/* Whether two hierarchies are the same to the last bit. */
int same_trees(const tree *a, const tree *b);

/* Whether two numbers differ by no more than this, relatively where they are large. */
int close_to(double a, double b, double tolerance);

double dot(const double *a, const double *b);
double apart(const double *a, const double *b);

/* Half the surface of a box of these sides. */
double half_surface(const double *sides);

#endif
