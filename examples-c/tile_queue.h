/* Tiles handed out to ranks on demand: who is done with one asks for the next, since tiles at the
 * boundary cost more than others. */
#ifndef TILE_QUEUE_H
#define TILE_QUEUE_H

#include "tile_work.h"
#include "tile_file.h"
#include "tile_journal.h"

/* What became of the tiles of this run; `rank` is -1 for those that were on disk before. */
typedef struct tile_log {
    tile_cost *costs;
    int *ranks;
} tile_log;

/* Rank 0: hands out the tiles that are not `done` until none is left, and lists in the journal what
 * ranks have written. Alone, it computes them itself. */
void hand_out_tiles(const tile_work *work, const bool *done, const char *file, journal *j,
                    tile_log *log);

/* Other ranks: compute tiles, and write them, as long as they are given some. */
void work_off_tiles(const tile_work *work, const char *file);

#endif
