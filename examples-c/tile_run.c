#include "tile_run.h"
#include "tile_report.h"

#include <errno.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t number(const char *text, size_t most) {
    char *end = NULL;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end != '\0' || errno != 0 || value == 0 ||
        value > most) {
        fail("\"%s\" is no number from 1 to %zu", text, most);
    }
    return (size_t)value;
}

bool read_run_option(run_arguments *a, int count, char **given, int *i) {
    const char *option = given[*i];
    if (strcmp(option, "--whole") == 0) {
        a->whole = true;
        return true;
    }
    if (*i + 1 == count) {
        fail("%s is unknown or needs a value", option);
    }
    if (strcmp(option, "--tiles") == 0) {
        a->tiles = number(given[++*i], 100000000);
        return true;
    }
    if (strcmp(option, "--costs") == 0) {
        a->costs = given[++*i];
        return true;
    }
    return false;
}

/* A journal without a file: the run was lost after the file had got its name, or somebody took the
 * file away. */
static void end_or_refuse(const tile_work *work, const char *journal_name, const char *part,
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
static void lead(const tile_work *work, const run_arguments *a, const char *part,
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

void run_tiles(const run_arguments *a, tile_work *work) {
    char part[4096], journal_name[4096];
    int rank = 0, is_ended = 0;
    if (snprintf(part, sizeof part, "%s.part", a->file) >= (int)sizeof part ||
        snprintf(journal_name, sizeof journal_name, "%s.journal", a->file) >=
            (int)sizeof journal_name) {
        fail("the name of the file is too long");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    cut_into_tiles(work, a->tiles);
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
    free(work->tiles);
}
