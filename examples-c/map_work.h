/* What map_mpi.c computes: an array of values, in tiles that may be computed in any order, by
 * anyone. */
#ifndef MAP_WORK_H
#define MAP_WORK_H

#include <cstk.h>

#include <stddef.h>
#include <stdint.h>

enum { MAX_AXES = 6, MAX_DESCRIPTION = 1024 };

/* Cells of the array: along each axis `count` of them, from number `first` on. */
typedef struct tile {
    size_t first[MAX_AXES], count[MAX_AXES];
} tile;

/* What a tile cost. */
typedef struct tile_cost {
    double seconds;             /* of the processor, to compute it */
    double writing;             /* by the clock, to bring it to the disk */
    uint64_t proofs, questions; /* of cstk_map_view */
} tile_cost;

typedef struct map_work {
    const cstk_cobject *cobject;
    const double *q; /* the coordinates that the map is not over */
    size_t nq;
    cstk_map_axis axes[MAX_AXES];
    size_t axis_count;
    cstk_map_options options;
    tile *tiles;
    size_t tile_count;
    char description[MAX_DESCRIPTION]; /* one line: equal for equal arrays and tiles */
} map_work;

/* Cuts the array into at least so many tiles, if it has cells enough, and writes the description.
 */
void cut_into_tiles(map_work *work, size_t at_least, const char *scene);

/* The bytes of a cell's value, and of all values of a tile. */
size_t value_size(const map_work *work);
size_t tile_size(const map_work *work, const tile *t);

/* Computes a tile: `bytes` has room for its values, of the last axis neighbours following one
 * another. */
tile_cost compute_tile(const map_work *work, const tile *t, void *bytes);

/* Ends all ranks with a message; what follows `format` is printed as by printf. */
_Noreturn void fail(const char *format, ...);

/* Ends all ranks with the library's message unless the status is CSTK_OK. */
void require(cstk_status status);

void release_work(map_work *work);

#endif
