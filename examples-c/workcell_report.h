/* A configuration of workcell.c in words: its class, what is nearest, and what made the class; and
 * whether that is as expected. */
#ifndef WORKCELL_REPORT_H
#define WORKCELL_REPORT_H

#include "workcell_scene.h"

#include <stdbool.h>

enum { MAX_REASONS = 2 };

typedef struct expectation {
    cstk_class where;
    const char *reasons[MAX_REASONS]; /* the names of the sets that make it; none where OUTSIDE */
} expectation;

const char *class_name(cstk_class where);

/* Prints a line for the configuration and one for each reason. The leaves of `set` have their names
 * as data. Returns whether all is as expected; if not, it says so. */
bool report(const cell *c, cstk_query *query, const cstk_cobject *set, const char *what,
            const double q[NQ], const expectation *expected);

#endif
