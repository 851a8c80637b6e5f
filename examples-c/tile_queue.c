#include "tile_queue.h"

#include <mpi.h>
#include <stdlib.h>

enum { REPORT = 1, ORDER = 2, MAX_FINISHED = 64 };
#define NO_TILE UINT64_MAX
/* In seconds: how long tiles wait to be synchronised, which takes as long as many tiles. */
#define MAX_WAIT 0.5

typedef struct finished_tile {
    uint64_t tile;
    tile_cost cost;
} finished_tile;

/* What a rank tells rank 0 when it asks for a tile: those that have come to the disk since. */
typedef struct report {
    uint64_t is_last, count;
    finished_tile tiles[MAX_FINISHED];
} report;

/* What a rank works with. Its tiles up to `written` are written; they are reported when they are
 * synchronised too. */
typedef struct worker {
    const tile_work *work;
    tile_file file;
    void *bytes;
    report report;
    size_t written;
    double synchronised;
} worker;

/* Room for the values of any tile. */
static void *tile_buffer(const tile_work *work) {
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
static uint64_t take(const tile_work *work, const bool *done, size_t *next) {
    while (*next < work->tile_count && done[*next]) {
        ++*next;
    }
    return *next < work->tile_count ? (uint64_t)(*next)++ : NO_TILE;
}

/* Lists what a rank has finished. */
static void keep(const report *r, int rank, journal *j, tile_log *log) {
    for (uint64_t i = 0; i < r->count; ++i) {
        const finished_tile *finished = &r->tiles[i];
        add_to_journal(j, (size_t)finished->tile);
        log->costs[finished->tile] = finished->cost;
        log->ranks[finished->tile] = rank;
    }
}

static worker begin_worker(const tile_work *work, const char *file) {
    worker w = {.work = work, .file = open_tile_file(file, work), .bytes = tile_buffer(work)};
    w.synchronised = MPI_Wtime();
    return w;
}

static void end_worker(worker *w) {
    free(w->bytes);
    close_tile_file(&w->file);
}

/* Synchronises what is written, so that it may be reported. */
static void settle(worker *w) {
    if (w->written > 0) {
        double start = MPI_Wtime();
        synchronise_tiles(&w->file);
        w->synchronised = MPI_Wtime();
        w->report.tiles[w->written - 1].cost.writing += w->synchronised - start;
    }
    w->report.count = w->written;
}

/* Computes a tile and writes it. */
static void finish(worker *w, uint64_t number) {
    const tile *t = &w->work->tiles[number];
    finished_tile *finished = &w->report.tiles[w->written++];
    finished->tile = number;
    finished->cost = compute_tile(w->work, t, w->bytes);
    double start = MPI_Wtime();
    write_tile(&w->file, t, w->bytes);
    finished->cost.writing = MPI_Wtime() - start;
    if (w->written == MAX_FINISHED || MPI_Wtime() - w->synchronised > MAX_WAIT) {
        settle(w);
    }
}

/* What was reported need not be reported again. */
static void begin_report(worker *w) {
    if (w->report.count > 0) {
        w->written = w->report.count = 0;
    }
}

static void compute_all(const tile_work *work, const bool *done, const char *file, journal *j,
                        tile_log *log) {
    worker w = begin_worker(work, file);
    size_t next = 0;
    for (uint64_t number; (number = take(work, done, &next)) != NO_TILE;) {
        finish(&w, number);
        keep(&w.report, 0, j, log);
        begin_report(&w);
    }
    settle(&w);
    keep(&w.report, 0, j, log);
    end_worker(&w);
}

void hand_out_tiles(const tile_work *work, const bool *done, const char *file, journal *j,
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
        if (r.is_last) {
            --working;
        } else {
            uint64_t order = take(work, done, &next);
            MPI_Send(&order, 1, MPI_UINT64_T, status.MPI_SOURCE, ORDER, MPI_COMM_WORLD);
        }
        keep(&r, status.MPI_SOURCE, j, log);
    }
}

static void send_report(const worker *w) {
    size_t size = offsetof(report, tiles) + w->report.count * sizeof w->report.tiles[0];
    MPI_Send(&w->report, (int)size, MPI_BYTE, 0, REPORT, MPI_COMM_WORLD);
}

void work_off_tiles(const tile_work *work, const char *file) {
    worker w = begin_worker(work, file);
    for (;;) {
        uint64_t number;
        send_report(&w);
        begin_report(&w);
        MPI_Recv(&number, 1, MPI_UINT64_T, 0, ORDER, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (number == NO_TILE) {
            break;
        }
        finish(&w, number);
    }
    settle(&w);
    w.report.is_last = 1;
    send_report(&w);
    end_worker(&w);
}
