/* What tiles cost. */
#ifndef TILE_REPORT_H
#define TILE_REPORT_H

#include "tile_queue.h"

/* Prints how the costs of this run's tiles are distributed, how long each rank worked, and how busy
 * more ranks would be. */
void print_report(const tile_work *work, const tile_log *log);

/* Writes a line for each tile of this run: its number, its rank, the seconds to compute and to
 * write it, and its counts. */
void write_costs(const char *name, const tile_work *work, const tile_log *log);

#endif
