/* A map of C-space as tiles. */
#ifndef MAP_WORK_H
#define MAP_WORK_H

#include "tile_work.h"

typedef struct map_work {
    const cstk_cobject *cobject;
    const double *q; /* the coordinates that the map is not over */
    size_t nq;
    cstk_map_axis axes[MAX_AXES];
    size_t axis_count;
    cstk_map_options options;
} map_work;

/* The map as values that are not yet cut into tiles; it refers to `map`. */
tile_work map_in_tiles(map_work *map, const char *scene);

/* Writes the map in one piece, by all threads of this process. */
void build_whole_map(const map_work *map, const char *file);

#endif
