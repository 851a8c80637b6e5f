/* The journal of an array that is being computed: which tiles are on disk. A line is added when a
 * tile's values have been written and synchronised. What a killed run leaves behind is whole lines,
 * and perhaps the start of one more; where the machine itself fails, the lines of the last second
 * may be lost with it, and their tiles are computed again. */
#ifndef TILE_JOURNAL_H
#define TILE_JOURNAL_H

#include "tile_work.h"

#include <stdbool.h>

typedef struct journal {
    int file;
    const char *name;
    double synchronised; /* when, by MPI_Wtime */
} journal;

/* Whether there is a journal of this name. */
bool journal_exists(const char *name);

/* Begins a journal, where there is none. */
journal begin_journal(const char *name, const tile_work *work);

/* Opens the journal that an earlier run left, marks in `done` the tiles that it lists, and returns
 * how many they are. Ends the program if the journal is of another array. */
size_t resume_journal(const char *name, const tile_work *work, bool *done, journal *out);

void add_to_journal(journal *j, size_t tile_number);

void close_journal(journal *j);

#endif
