/* What the tiles of map_mpi.c cost. */
#ifndef MAP_REPORT_H
#define MAP_REPORT_H

#include "tile_queue.h"

/* Prints how the costs of this run's tiles are distributed, how long each rank worked, and how busy
 * more ranks would be. */
void print_report(const map_work *work, const tile_log *log);

/* Writes a line for each tile of this run: its number, its rank, the seconds to compute and to
 * write it, proofs and questions. */
void write_costs(const char *name, const map_work *work, const tile_log *log);

#endif
