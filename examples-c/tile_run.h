/* A run of all ranks: tiles computed, and gathered in one file. */
#ifndef TILE_RUN_H
#define TILE_RUN_H

#include "tile_work.h"

/* What both programs are given. */
typedef struct run_arguments {
    const char *scene, *folder, *file; /* the file that is written */
    const char *costs;                 /* NULL: not wanted */
    size_t tiles;                      /* at least */
    bool whole;                        /* by this process alone, in one piece */
} run_arguments;

/* If the argument `*i` is an option of a run, reads it, moves `*i` to its last word, and returns
 * true. */
bool read_run_option(run_arguments *a, int count, char **given, int *i);

/* A number of the command line, from 1. */
size_t number(const char *text, size_t most);

/* Computes what is not yet on disk. Each rank writes its tiles into FILE.part, and rank 0 lists in
 * FILE.journal what is on disk; when all is done, the file gets its name. */
void run_tiles(const run_arguments *a, tile_work *work);

#endif
