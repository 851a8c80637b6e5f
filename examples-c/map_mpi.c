/* A map of C-space, computed by many ranks of MPI and gathered in one file:
 *
 *     mpirun -n 4 map_mpi [OPTION VALUE]... SCENE FOLDER MAP.npy CELLS...
 *
 * SCENE is appendix, with the folder models/, or puma560, with that of scripts/fetch_puma560.sh.
 * The map is over as many of the arm's joints as there are numbers of cells, all the way round; the
 * others stand as at the start of puma_slider.c's slide. Options: --kind classes (the default),
 * distances or cells; --tiles, how many at least; --costs, a .csv file for what each tile cost.
 *
 * The map is cut into tiles, 1024 by default, which rank 0 hands out to the others; alone, it
 * computes them itself. Each rank writes its tiles into MAP.npy.part by MPI-IO, and rank 0 lists in
 * MAP.npy.journal what is on disk. When all is done, the file gets its name, and holds what
 * cstk_map_save writes of a map built in one piece: map_mpi --whole builds that. A run that was
 * lost is resumed by the same command, with any number of ranks. docs/scale.md says what many ranks
 * would do. */
#include "map_work.h"
#include "mpi_scene.h"
#include "tile_run.h"

#include <mpi.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct arguments {
    run_arguments run;
    cstk_map_kind kind;
    size_t axis_count, cells[MAX_AXES];
} arguments;

static cstk_map_kind kind_of(const char *name) {
    const char *const names[] = {"classes", "distances", "cells"};
    for (int kind = 0; kind < 3; ++kind) {
        if (strcmp(name, names[kind]) == 0) {
            return (cstk_map_kind)kind;
        }
    }
    fail("there is no kind %s: classes, distances or cells", name);
}

static arguments read_arguments(int count, char **given) {
    arguments a = {.run = {.tiles = 1024}, .kind = CSTK_MAP_CLASSES};
    int i = 1;
    for (; i < count && strncmp(given[i], "--", 2) == 0; ++i) {
        if (read_run_option(&a.run, count, given, &i)) {
            continue;
        }
        if (strcmp(given[i], "--kind") != 0) {
            fail("unknown option %s", given[i]);
        }
        a.kind = kind_of(given[++i]);
    }
    if (count - i < 4 || count - i > 3 + MAX_AXES) {
        fail("usage: map_mpi [--kind classes|distances|cells] [--tiles N] [--costs FILE.csv] "
             "[--whole] appendix|puma560 FOLDER MAP.npy CELLS...");
    }
    a.run.scene = given[i++];
    a.run.folder = given[i++];
    a.run.file = given[i++];
    while (i < count) {
        a.cells[a.axis_count++] = number(given[i++], (size_t)1 << 30);
    }
    return a;
}

static map_work describe_map(const arguments *a, const scene *s, const cstk_cobject *cobject) {
    map_work map = {.cobject = cobject, .q = s->start, .nq = s->nq, .axis_count = a->axis_count};
    if (a->axis_count > s->nq) {
        fail("the arm has %zu joints, not %zu", s->nq, a->axis_count);
    }
    for (size_t i = 0; i < a->axis_count; ++i) {
        map.axes[i] = (cstk_map_axis){
            .coordinate = (uint32_t)i, .low = -PI, .high = PI, .cells = a->cells[i]};
    }
    require(cstk_map_options_default(&map.options, sizeof map.options));
    map.options.kind = a->kind;
    /* Each rank has a processor of its own. */
    map.options.threads = 1;
    return map;
}

int main(int count, char **given) {
    MPI_Init(&count, &given);
    arguments a = read_arguments(count, given);
    scene s = open_scene(a.run.scene, a.run.folder);
    cstk_cobject *cobject = obstacles(&s);
    map_work map = describe_map(&a, &s, cobject);
    if (a.run.whole) {
        build_whole_map(&map, a.run.file);
    } else {
        tile_work work = map_in_tiles(&map, a.run.scene);
        run_tiles(&a.run, &work);
    }
    require(cstk_cobject_release(cobject));
    release_scene(&s);
    MPI_Finalize();
    return 0;
}
