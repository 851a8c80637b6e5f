#include "tile_work.h"

#include <mpi.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void fail(const char *format, ...) {
    va_list values;
    va_start(values, format);
    vfprintf(stderr, format, values);
    fprintf(stderr, "\n");
    va_end(values);
    MPI_Abort(MPI_COMM_WORLD, 1);
    exit(1);
}

void require(cstk_status status) {
    if (status != CSTK_OK) {
        fail("%s: %s", cstk_status_name(status), cstk_last_error_message());
    }
}

void *zeros(size_t count, size_t size) {
    void *made = calloc(count > 0 ? count : 1, size);
    if (made == NULL) {
        fail("there is no memory for %zu times %zu bytes", count, size);
    }
    return made;
}

void describe(tile_work *work, const char *format, ...) {
    size_t length = strlen(work->description), room = sizeof work->description - length;
    va_list values;
    va_start(values, format);
    int added = vsnprintf(work->description + length, room, format, values);
    va_end(values);
    if (added < 0 || (size_t)added >= room) {
        fail("the description of the array is too long");
    }
}

/* The second half of a tile, which keeps the first: across its longest side, the first of equal
 * ones. These are the halves that cstk_map_build makes of a map; tiles that are cut in other ways
 * make maps as good, but prove more. */
static tile halve(tile *t, size_t axis_count) {
    size_t longest = 0;
    for (size_t i = 1; i < axis_count; ++i) {
        longest = t->count[i] > t->count[longest] ? i : longest;
    }
    tile rest = *t;
    size_t half = t->count[longest] / 2;
    t->count[longest] = half;
    rest.first[longest] += half;
    rest.count[longest] -= half;
    return rest;
}

static size_t value_count(const tile_work *work, const tile *t) {
    size_t count = 1;
    for (size_t i = 0; i < work->axis_count; ++i) {
        count *= t->count[i];
    }
    return count;
}

void cut_into_tiles(tile_work *work, size_t at_least) {
    work->tiles = zeros(2 * at_least, sizeof *work->tiles);
    memcpy(work->tiles[0].count, work->sides, sizeof work->sides);
    work->tile_count = 1;
    for (size_t before = 0; work->tile_count < at_least && before != work->tile_count;) {
        before = work->tile_count;
        for (size_t i = 0; i < before; ++i) {
            if (value_count(work, &work->tiles[i]) > 1) {
                work->tiles[work->tile_count++] = halve(&work->tiles[i], work->axis_count);
            }
        }
    }
    describe(work, " tiles %zu", work->tile_count);
}

size_t tile_size(const tile_work *work, const tile *t) {
    return value_count(work, t) * work->value_size;
}

/* Of this thread: other programs do not lengthen them. */
static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

tile_cost compute_tile(const tile_work *work, const tile *t, void *bytes) {
    tile_cost cost = {0, 0, {0, 0}};
    double start = processor_seconds();
    work->compute(work->values, t, bytes, &cost);
    cost.seconds = processor_seconds() - start;
    return cost;
}
