#include "tile_queue.h"

#include <mpi.h>
#include <stdlib.h>

enum { REPORT = 1, ORDER = 2 };
#define NO_TILE UINT64_MAX

/* What a rank tells rank 0 when it asks for a tile: which one it has written, and what that cost.
 */
typedef struct report {
    uint64_t tile; /* NO_TILE with the first request */
    tile_cost cost;
} report;

/* Room for the values of any tile. */
static void *tile_buffer(const map_work *work) {
    size_t largest = 0;
    for (size_t i = 0; i < work->tile_count; ++i) {
        size_t size = tile_size(work, &work->tiles[i]);
        largest = size > largest ? size : largest;
    }
    void *buffer = malloc(largest);
    if (buffer == NULL) {
        fail("there is no memory for a tile of %zu bytes", largest);
    }
    return buffer;
}

/* The first tile that nobody has, from `*next` on; NO_TILE if none is left. */
static uint64_t take(const map_work *work, const bool *done, size_t *next) {
    while (*next < work->tile_count && done[*next]) {
        ++*next;
    }
    return *next < work->tile_count ? (uint64_t)(*next)++ : NO_TILE;
}

static void keep(const report *r, int rank, journal *j, tile_log *log) {
    add_to_journal(j, (size_t)r->tile);
    log->costs[r->tile] = r->cost;
    log->ranks[r->tile] = rank;
}

/* Computes the tile of a report and writes it. */
static void compute(const map_work *work, report *r, tile_file *f, void *bytes) {
    const tile *t = &work->tiles[r->tile];
    r->cost = compute_tile(work, t, bytes);
    double start = MPI_Wtime();
    write_tile(f, t, bytes);
    r->cost.writing = MPI_Wtime() - start;
}

static void compute_all(const map_work *work, const bool *done, const char *file, journal *j,
                        tile_log *log) {
    tile_file f = open_tile_file(file, work);
    void *bytes = tile_buffer(work);
    size_t next = 0;
    for (report r; (r.tile = take(work, done, &next)) != NO_TILE;) {
        compute(work, &r, &f, bytes);
        keep(&r, 0, j, log);
    }
    free(bytes);
    close_tile_file(&f);
}

void hand_out_tiles(const map_work *work, const bool *done, const char *file, journal *j,
                    tile_log *log) {
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (ranks == 1) {
        compute_all(work, done, file, j, log);
        return;
    }
    size_t next = 0;
    for (int working = ranks - 1; working > 0;) {
        report r;
        MPI_Status status;
        MPI_Recv(&r, sizeof r, MPI_BYTE, MPI_ANY_SOURCE, REPORT, MPI_COMM_WORLD, &status);
        uint64_t order = take(work, done, &next);
        MPI_Send(&order, 1, MPI_UINT64_T, status.MPI_SOURCE, ORDER, MPI_COMM_WORLD);
        if (r.tile != NO_TILE) {
            keep(&r, status.MPI_SOURCE, j, log);
        }
        working -= order == NO_TILE ? 1 : 0;
    }
}

void work_off_tiles(const map_work *work, const char *file) {
    tile_file f = open_tile_file(file, work);
    void *bytes = tile_buffer(work);
    for (report r = {NO_TILE, {0, 0, 0, 0}};;) {
        MPI_Send(&r, sizeof r, MPI_BYTE, 0, REPORT, MPI_COMM_WORLD);
        MPI_Recv(&r.tile, 1, MPI_UINT64_T, 0, ORDER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (r.tile == NO_TILE) {
            break;
        }
        compute(work, &r, &f, bytes);
    }
    free(bytes);
    close_tile_file(&f);
}
