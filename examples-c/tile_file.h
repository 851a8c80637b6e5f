/* The file of an array, NumPy's format 1.0, written tile by tile with MPI-IO. */
#ifndef TILE_FILE_H
#define TILE_FILE_H

#include "tile_work.h"

#include <mpi.h>

typedef struct tile_file {
    MPI_File file;
    MPI_Offset header_size;
    const tile_work *work;
} tile_file;

enum { MAX_HEADER = 512 };

/* The bytes before the first value, as cstk_map_save writes them; returns how many they are. */
size_t header_of(const tile_work *work, char header[MAX_HEADER]);

/* Makes a file of the array's size, with the header. One rank does. */
void create_tile_file(const char *name, const tile_work *work);

/* Opens it, each rank for itself: so each may synchronise what it wrote, whatever the others do.
 * Ends the program if the file is not one of this array. */
tile_file open_tile_file(const char *name, const tile_work *work);

/* Writes the values of a tile. They are sure to be on the disk after the next synchronise_tiles. */
void write_tile(tile_file *f, const tile *t, const void *bytes);

void synchronise_tiles(tile_file *f);

void close_tile_file(tile_file *f);

#endif
