/* What map_mpi.c and batch_mpi.c compute: an array of values, in tiles that may be computed in any
 * order, by anyone. */
#ifndef TILE_WORK_H
#define TILE_WORK_H

#include <cstk.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MAX_AXES = 6, MAX_DESCRIPTION = 1024 };

/* Values of the array: along each axis `count` of them, from number `first` on. */
typedef struct tile {
    size_t first[MAX_AXES], count[MAX_AXES];
} tile;

/* What a tile cost. */
typedef struct tile_cost {
    double seconds;     /* of the processor, to compute it */
    double writing;     /* by the clock, to bring it to the disk */
    uint64_t counts[2]; /* of what count_names says */
} tile_cost;

typedef struct tile_work {
    size_t sides[MAX_AXES]; /* values along each axis */
    size_t axis_count;
    size_t value_size; /* 1 for unsigned bytes, 8 for doubles */
    tile *tiles;
    size_t tile_count;
    char description[MAX_DESCRIPTION]; /* one line: equal for equal arrays and tiles */
    const char *count_names[2];
    /* Computes a tile of `values`: `bytes` has room for its values, of the last axis neighbours
     * following one another. Fills in the counts of the cost. */
    void (*compute)(void *values, const tile *t, void *bytes, tile_cost *cost);
    void *values;
} tile_work;

/* Adds to the description; what follows `format` is written as by printf. */
void describe(tile_work *work, const char *format, ...);

/* Cuts the array into at least so many tiles, if it has values enough. */
void cut_into_tiles(tile_work *work, size_t at_least);

/* The bytes of all values of a tile. */
size_t tile_size(const tile_work *work, const tile *t);

/* Computes a tile, and measures what it costs. */
tile_cost compute_tile(const tile_work *work, const tile *t, void *bytes);

/* Room for as many values of this size, all 0. */
void *zeros(size_t count, size_t size);

/* Ends all ranks with a message; what follows `format` is printed as by printf. */
_Noreturn void fail(const char *format, ...);

/* Ends all ranks with the library's message unless the status is CSTK_OK. */
void require(cstk_status status);

#endif
