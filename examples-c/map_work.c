#include "map_work.h"

#include <mpi.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void fail(const char *format, ...) {
    va_list values;
    va_start(values, format);
    fprintf(stderr, "map_mpi: ");
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

static size_t cell_count(const map_work *work, const tile *t) {
    size_t cells = 1;
    for (size_t i = 0; i < work->axis_count; ++i) {
        cells *= t->count[i];
    }
    return cells;
}

static void describe(map_work *work, const char *scene) {
    char *end = work->description + sizeof work->description, *at = work->description;
    at += snprintf(at, (size_t)(end - at), "%s kind %d tiles %zu at", scene, work->options.kind,
                   work->tile_count);
    for (size_t i = 0; i < work->nq; ++i) {
        at += snprintf(at, (size_t)(end - at), " %.17g", work->q[i]);
    }
    for (size_t i = 0; i < work->axis_count; ++i) {
        const cstk_map_axis *axis = &work->axes[i];
        at += snprintf(at, (size_t)(end - at), " axis %u %.17g %.17g %zu", axis->coordinate,
                       axis->low, axis->high, axis->cells);
    }
}

void cut_into_tiles(map_work *work, size_t at_least, const char *scene) {
    work->tiles = malloc(2 * at_least * sizeof *work->tiles);
    if (work->tiles == NULL) {
        fail("there is no memory for %zu tiles", at_least);
    }
    tile whole;
    memset(&whole, 0, sizeof whole);
    for (size_t i = 0; i < work->axis_count; ++i) {
        whole.count[i] = work->axes[i].cells;
    }
    work->tiles[0] = whole;
    work->tile_count = 1;
    for (size_t before = 0; work->tile_count < at_least && before != work->tile_count;) {
        before = work->tile_count;
        for (size_t i = 0; i < before; ++i) {
            if (cell_count(work, &work->tiles[i]) > 1) {
                work->tiles[work->tile_count++] = halve(&work->tiles[i], work->axis_count);
            }
        }
    }
    describe(work, scene);
}

size_t value_size(const map_work *work) {
    return work->options.kind == CSTK_MAP_DISTANCES ? sizeof(double) : 1;
}

size_t tile_size(const map_work *work, const tile *t) {
    return cell_count(work, t) * value_size(work);
}

/* Of this thread: other programs do not lengthen them. */
static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

tile_cost compute_tile(const map_work *work, const tile *t, void *bytes) {
    cstk_map_axis axes[MAX_AXES];
    for (size_t i = 0; i < work->axis_count; ++i) {
        axes[i] = work->axes[i];
        axes[i].first = t->first[i];
        axes[i].count = t->count[i];
    }
    cstk_map *map = NULL;
    cstk_map_view view;
    double start = processor_seconds();
    require(cstk_map_build(work->cobject, work->q, work->nq, axes, work->axis_count, &work->options,
                           NULL, NULL, &map));
    require(cstk_map_get_view(map, &view));
    const void *values =
        view.distances != NULL ? (const void *)view.distances : (const void *)view.values;
    memcpy(bytes, values, tile_size(work, t));
    tile_cost cost = {processor_seconds() - start, 0, view.proofs, view.questions};
    require(cstk_map_release(map));
    return cost;
}

void release_work(map_work *work) { free(work->tiles); }
