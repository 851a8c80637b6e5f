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
#include "map_report.h"
#include "puma_scene.h"

#include <errno.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct arguments {
    const char *scene, *folder, *file, *costs;
    cstk_map_kind kind;
    size_t tiles;
    bool whole;
    size_t axis_count, cells[MAX_AXES];
} arguments;

static size_t number(const char *text, size_t most) {
    char *end = NULL;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end != '\0' || errno != 0 || value == 0 ||
        value > most) {
        fail("\"%s\" is no number from 1 to %zu", text, most);
    }
    return (size_t)value;
}

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
    arguments a = {.kind = CSTK_MAP_CLASSES, .tiles = 1024};
    int i = 1;
    for (; i < count && strncmp(given[i], "--", 2) == 0; ++i) {
        if (strcmp(given[i], "--whole") == 0) {
            a.whole = true;
        } else if (i + 1 == count) {
            fail("%s is unknown or needs a value", given[i]);
        } else if (strcmp(given[i], "--kind") == 0) {
            a.kind = kind_of(given[++i]);
        } else if (strcmp(given[i], "--tiles") == 0) {
            a.tiles = number(given[++i], 100000000);
        } else if (strcmp(given[i], "--costs") == 0) {
            a.costs = given[++i];
        } else {
            fail("unknown option %s", given[i]);
        }
    }
    if (count - i < 4 || count - i > 3 + MAX_AXES) {
        fail("usage: map_mpi [--kind classes|distances|cells] [--tiles N] [--costs FILE.csv] "
             "[--whole] appendix|puma560 FOLDER MAP.npy CELLS...");
    }
    a.scene = given[i++];
    a.folder = given[i++];
    a.file = given[i++];
    while (i < count) {
        a.cells[a.axis_count++] = number(given[i++], (size_t)1 << 30);
    }
    return a;
}

static scene open_scene(const arguments *a) {
    if (strcmp(a->scene, "appendix") == 0) {
        return appendix_scene(a->folder);
    }
    if (strcmp(a->scene, "puma560") == 0) {
        return puma560_scene(a->folder);
    }
    fail("there is no scene %s: appendix or puma560", a->scene);
}

/* The links against the objects; without a shell of contacts, the cost of a map of classes follows
 * its boundary. */
static cstk_cobject *obstacles(const scene *s) {
    cstk_cobject *made = NULL;
    require(cstk_cobject_induced(s->space, NULL, 0, s->environment, NULL, 0, NULL, &made));
    return made;
}

static map_work describe_work(const arguments *a, const scene *s, const cstk_cobject *cobject) {
    map_work work = {.cobject = cobject, .q = s->start, .nq = s->nq, .axis_count = a->axis_count};
    if (a->axis_count > s->nq) {
        fail("the arm has %zu joints, not %zu", s->nq, a->axis_count);
    }
    for (size_t i = 0; i < a->axis_count; ++i) {
        work.axes[i] = (cstk_map_axis){
            .coordinate = (uint32_t)i, .low = -PI, .high = PI, .cells = a->cells[i]};
    }
    require(cstk_map_options_default(&work.options, sizeof work.options));
    work.options.kind = a->kind;
    /* Each rank has a processor of its own. */
    work.options.threads = 1;
    return work;
}

/* The map in one piece, by all threads of this process. */
static void build_whole(map_work *work, const char *file) {
    cstk_map *map = NULL;
    work->options.threads = 0;
    require(cstk_map_build(work->cobject, work->q, work->nq, work->axes, work->axis_count,
                           &work->options, NULL, NULL, &map));
    require(cstk_map_save(map, file));
    require(cstk_map_release(map));
}

static void *zeros(size_t count, size_t size) {
    void *made = calloc(count, size);
    if (made == NULL) {
        fail("there is no memory for %zu tiles", count);
    }
    return made;
}

/* A journal without a file: the run was lost after the file had got its name, or somebody took the
 * file away. */
static void end_or_refuse(const map_work *work, const char *journal_name, const char *part,
                          const char *file) {
    bool *done = zeros(work->tile_count, sizeof *done);
    journal j;
    if (resume_journal(journal_name, work, done, &j) < work->tile_count || !journal_exists(file)) {
        fail("%s is there, but %s is not; remove it to begin anew", journal_name, part);
    }
    close_journal(&j);
    free(done);
}

/* What rank 0 does: resumes or begins, hands out, and gives the file its name. */
static void lead(const map_work *work, const arguments *a, const char *part,
                 const char *journal_name) {
    journal j;
    bool *done = zeros(work->tile_count, sizeof *done);
    tile_log log = {zeros(work->tile_count, sizeof *log.costs),
                    zeros(work->tile_count, sizeof *log.ranks)};
    memset(log.ranks, -1, work->tile_count * sizeof *log.ranks);
    if (journal_exists(journal_name)) {
        size_t on_disk = resume_journal(journal_name, work, done, &j);
        printf("resumed: %zu of %zu tiles are on disk\n", on_disk, work->tile_count);
    } else {
        create_tile_file(part, work);
        j = begin_journal(journal_name, work);
    }
    fflush(stdout);
    MPI_Barrier(MPI_COMM_WORLD); /* the file is there */
    hand_out_tiles(work, done, part, &j, &log);
    MPI_Barrier(MPI_COMM_WORLD); /* all have closed it */
    close_journal(&j);
    if (rename(part, a->file) != 0 || remove(journal_name) != 0) {
        fail("%s: %s", a->file, strerror(errno));
    }
    print_report(work, &log);
    if (a->costs != NULL) {
        write_costs(a->costs, work, &log);
    }
    free(log.ranks);
    free(log.costs);
    free(done);
}

static void run(const arguments *a, map_work *work) {
    char part[4096], journal_name[4096];
    int rank = 0, is_ended = 0;
    if (snprintf(part, sizeof part, "%s.part", a->file) >= (int)sizeof part ||
        snprintf(journal_name, sizeof journal_name, "%s.journal", a->file) >=
            (int)sizeof journal_name) {
        fail("the name of the file is too long");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    cut_into_tiles(work, a->tiles, a->scene);
    if (rank == 0 && journal_exists(journal_name) && !journal_exists(part)) {
        end_or_refuse(work, journal_name, part, a->file);
        is_ended = remove(journal_name) == 0;
        printf("all %zu tiles are on disk\n", work->tile_count);
    }
    MPI_Bcast(&is_ended, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (!is_ended && rank == 0) {
        lead(work, a, part, journal_name);
    } else if (!is_ended) {
        MPI_Barrier(MPI_COMM_WORLD);
        work_off_tiles(work, part);
        MPI_Barrier(MPI_COMM_WORLD);
    }
}

int main(int count, char **given) {
    MPI_Init(&count, &given);
    double start = MPI_Wtime();
    arguments a = read_arguments(count, given);
    scene s = open_scene(&a);
    cstk_cobject *cobject = obstacles(&s);
    map_work work = describe_work(&a, &s, cobject);
    if (a.whole) {
        build_whole(&work, a.file);
    } else {
        double seconds = MPI_Wtime() - start, slowest = 0;
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Reduce(&seconds, &slowest, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
        if (rank == 0) {
            printf("the slowest rank read its scene in %.3g s\n", slowest);
        }
        run(&a, &work);
        release_work(&work);
    }
    require(cstk_cobject_release(cobject));
    release_scene(&s);
    MPI_Finalize();
    return 0;
}
