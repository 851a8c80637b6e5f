/* What every hierarchy must be, whatever its options. */
#ifndef CSTK_TESTS_HIERARCHY_CHECKS_H
#define CSTK_TESTS_HIERARCHY_CHECKS_H

#include "bodies.h"

double larger(double a, double b);
double smaller(double a, double b);

enum { DIRECTIONS = 26 + 24 };

/* Unit vectors: the axes and diagonals, and others. */
const double *direction(int i);
/* How far a set of points reaches in a direction. */
double reach(const double *points, size_t count, const double *direction);

void check_levels(const cstk_body *body, const tree *t, uint64_t depth);
void check_covers(const cstk_body *body, const tree *t);
/* Trees over all primitives, wrappers that hold what is below them, levels, covers and statistics.
 */
void check_body(const cstk_body *body, const cstk_hierarchy_options *options);

#endif
