/* A batch of configurations of an arm, asked by many ranks of MPI and gathered in one file:
 *
 *     mpirun -n 4 batch_mpi [OPTION VALUE]... SCENE FOLDER ANSWERS.npy CONFIGURATIONS
 *
 * SCENE is appendix, with the folder models/, or puma560, with that of scripts/fetch_puma560.sh.
 * CONFIGURATIONS is a .npy file with a row of doubles each, or a number: then there are so many
 * random ones. Options: --kind classes (the default), distances, motions (from each configuration
 * to the next), or configurations (they themselves, of which ANSWERS.npy may be asked again);
 * --seed of the random ones; --tiles, how many at least; --costs, a .csv file for what each tile
 * cost. batch_work.h says what stands for an item that failed.
 *
 * The items are cut into tiles of neighbours, handed out and gathered as map_mpi.c's are; a run
 * that was lost is resumed by the same command. ANSWERS.npy holds what batch_mpi --whole writes, by
 * one call for all items in one process. */
#include "batch_work.h"
#include "mpi_scene.h"
#include "tile_run.h"

#include <mpi.h>
#include <string.h>

typedef struct arguments {
    run_arguments run;
    batch_kind kind;
    size_t seed;
    const char *configurations;
} arguments;

static batch_kind kind_of(const char *name) {
    const char *const names[] = {"classes", "distances", "motions", "configurations"};
    for (int kind = 0; kind < 4; ++kind) {
        if (strcmp(name, names[kind]) == 0) {
            return (batch_kind)kind;
        }
    }
    fail("there is no kind %s: classes, distances, motions or configurations", name);
}

static arguments read_arguments(int count, char **given) {
    arguments a = {.run = {.tiles = 1024}, .kind = BATCH_CLASSES, .seed = 1};
    int i = 1;
    for (; i < count && strncmp(given[i], "--", 2) == 0; ++i) {
        if (read_run_option(&a.run, count, given, &i)) {
            continue;
        }
        if (strcmp(given[i], "--kind") == 0) {
            a.kind = kind_of(given[++i]);
        } else if (strcmp(given[i], "--seed") == 0) {
            a.seed = number(given[++i], SIZE_MAX);
        } else {
            fail("unknown option %s", given[i]);
        }
    }
    if (count - i != 4) {
        fail("usage: batch_mpi [--kind classes|distances|motions|configurations] [--seed N] "
             "[--tiles N] [--costs FILE.csv] [--whole] appendix|puma560 FOLDER ANSWERS.npy "
             "CONFIGURATIONS.npy|COUNT");
    }
    a.run.scene = given[i];
    a.run.folder = given[i + 1];
    a.run.file = given[i + 2];
    a.configurations = given[i + 3];
    return a;
}

static configurations get_source(const arguments *a, size_t nq) {
    const char *ending = strrchr(a->configurations, '.');
    if (ending != NULL && strcmp(ending, ".npy") == 0) {
        return open_configurations(a->configurations, nq);
    }
    return seeded_configurations(number(a->configurations, (size_t)1 << 40), nq, a->seed);
}

int main(int count, char **given) {
    MPI_Init(&count, &given);
    arguments a = read_arguments(count, given);
    scene s = open_scene(a.run.scene, a.run.folder);
    cstk_cobject *cobject = obstacles(&s);
    configurations q = get_source(&a, s.nq);
    if (a.kind == BATCH_MOTIONS && q.count < 2) {
        fail("a motion needs two configurations");
    }
    batch_work batch = {.kind = a.kind, .cobject = cobject, .q = &q};
    require(cstk_batch_create(&batch.batch));
    require(cstk_batch_options_default(&batch.options, sizeof batch.options));
    /* Each rank has a processor of its own. */
    batch.options.threads = 1;
    tile_work work = batch_in_tiles(&batch, a.run.scene);
    if (a.run.whole) {
        answer_whole_batch(&batch, &work, a.run.file);
    } else {
        run_tiles(&a.run, &work);
    }
    require(cstk_batch_release(batch.batch));
    close_configurations(&q);
    require(cstk_cobject_release(cobject));
    release_scene(&s);
    MPI_Finalize();
    return 0;
}
