#include "map_work.h"

#include <string.h>

static void compute(void *values, const tile *t, void *bytes, tile_cost *cost) {
    const map_work *work = values;
    cstk_map_axis axes[MAX_AXES];
    for (size_t i = 0; i < work->axis_count; ++i) {
        axes[i] = work->axes[i];
        axes[i].first = t->first[i];
        axes[i].count = t->count[i];
    }
    cstk_map *map = NULL;
    cstk_map_view view;
    require(cstk_map_build(work->cobject, work->q, work->nq, axes, work->axis_count, &work->options,
                           NULL, NULL, &map));
    require(cstk_map_get_view(map, &view));
    if (view.distances != NULL) {
        memcpy(bytes, view.distances, view.cell_count * sizeof *view.distances);
    } else {
        memcpy(bytes, view.values, view.cell_count);
    }
    cost->counts[0] = view.proofs;
    cost->counts[1] = view.questions;
    require(cstk_map_release(map));
}

tile_work map_in_tiles(map_work *map, const char *scene) {
    bool measures = map->options.kind == CSTK_MAP_DISTANCES;
    tile_work work = {.axis_count = map->axis_count,
                      .value_size = measures ? sizeof(double) : 1,
                      .count_names = {"proofs", "questions"},
                      .compute = compute,
                      .values = map};
    describe(&work, "map of %s kind %d at", scene, map->options.kind);
    for (size_t i = 0; i < map->nq; ++i) {
        describe(&work, " %.17g", map->q[i]);
    }
    for (size_t i = 0; i < map->axis_count; ++i) {
        const cstk_map_axis *axis = &map->axes[i];
        work.sides[i] = axis->cells;
        describe(&work, " axis %u %.17g %.17g %zu", axis->coordinate, axis->low, axis->high,
                 axis->cells);
    }
    return work;
}

void build_whole_map(const map_work *map, const char *file) {
    cstk_map *built = NULL;
    cstk_map_options options = map->options;
    options.threads = 0;
    require(cstk_map_build(map->cobject, map->q, map->nq, map->axes, map->axis_count, &options,
                           NULL, NULL, &built));
    require(cstk_map_save(built, file));
    require(cstk_map_release(built));
}
