#include "tile_report.h"

#include <errno.h>
#include <inttypes.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value below which a share of them lies. */
static double quantile(const double *sorted, size_t count, double share) {
    return sorted[(size_t)(share * (double)(count - 1) + 0.5)];
}

/* How long tiles of these costs, handed out in order to whoever is free, keep so many ranks busy.
 */
static double time_on(const double *seconds, size_t count, size_t ranks) {
    double *free_at = calloc(ranks, sizeof *free_at), end = 0;
    if (free_at == NULL) {
        fail("there is no memory for %zu ranks", ranks);
    }
    for (size_t i = 0; i < count; ++i) {
        size_t first = 0;
        for (size_t rank = 1; rank < ranks; ++rank) {
            first = free_at[rank] < free_at[first] ? rank : first;
        }
        free_at[first] += seconds[i];
        end = free_at[first] > end ? free_at[first] : end;
    }
    free(free_at);
    return end;
}

/* By the costs alone, without the network and the disk. */
static void print_forecast(const double *seconds, size_t count, double sum) {
    for (size_t ranks = 10; ranks <= 1000; ranks *= 10) {
        double time = time_on(seconds, count, ranks);
        printf("  computed by %zu ranks, they would take %.3g s, %.0f %% of the ranks' time\n",
               ranks, time, 100 * sum / (time * (double)ranks));
    }
}

static void print_costs(double *seconds, size_t count, double sum) {
    qsort(seconds, count, sizeof *seconds, ascending);
    double dearest = 0;
    for (size_t i = count - (count + 9) / 10; i < count; ++i) {
        dearest += seconds[i];
    }
    printf("  a tile: mean %.3g ms, least %.3g, median %.3g, 90 %% below %.3g, 99 %% below %.3g, "
           "most %.3g ms\n",
           1e3 * sum / (double)count, 1e3 * seconds[0], 1e3 * quantile(seconds, count, 0.5),
           1e3 * quantile(seconds, count, 0.9), 1e3 * quantile(seconds, count, 0.99),
           1e3 * seconds[count - 1]);
    printf("  the dearest tenth of the tiles took %.0f %% of %.3g s\n", 100 * dearest / sum, sum);
}

void print_report(const tile_work *work, const tile_log *log) {
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    size_t count = 0;
    tile_cost all = {0, 0, {0, 0}};
    double *seconds = malloc(work->tile_count * sizeof *seconds);
    double *of_rank = calloc((size_t)ranks, sizeof *of_rank);
    if (seconds == NULL || of_rank == NULL) {
        fail("there is no memory for the costs of %zu tiles", work->tile_count);
    }
    for (size_t i = 0; i < work->tile_count; ++i) {
        if (log->ranks[i] >= 0) {
            const tile_cost *cost = &log->costs[i];
            seconds[count++] = cost->seconds;
            of_rank[log->ranks[i]] += cost->seconds;
            all.seconds += cost->seconds;
            all.writing += cost->writing;
            all.counts[0] += cost->counts[0];
            all.counts[1] += cost->counts[1];
        }
    }
    printf("%zu of %zu tiles computed by %d rank%s, the others were on disk; %" PRIu64
           " %s, %" PRIu64 " %s\n",
           count, work->tile_count, ranks, ranks == 1 ? "" : "s", all.counts[0],
           work->count_names[0], all.counts[1], work->count_names[1]);
    if (count > 0) {
        print_forecast(seconds, count, all.seconds);
        printf("  writing took %.3g ms a tile\n", 1e3 * all.writing / (double)count);
        print_costs(seconds, count, all.seconds);
        for (int rank = 0; rank < ranks; ++rank) {
            if (of_rank[rank] > 0) {
                printf("  rank %d computed for %.3g s\n", rank, of_rank[rank]);
            }
        }
    }
    free(seconds);
    free(of_rank);
}

void write_costs(const char *name, const tile_work *work, const tile_log *log) {
    FILE *file = fopen(name, "w");
    if (file == NULL) {
        fail("%s: %s", name, strerror(errno));
    }
    fprintf(file, "tile,rank,seconds,writing,%s,%s\n", work->count_names[0], work->count_names[1]);
    for (size_t i = 0; i < work->tile_count; ++i) {
        if (log->ranks[i] >= 0) {
            const tile_cost *cost = &log->costs[i];
            fprintf(file, "%zu,%d,%.9f,%.9f,%" PRIu64 ",%" PRIu64 "\n", i, log->ranks[i],
                    cost->seconds, cost->writing, cost->counts[0], cost->counts[1]);
        }
    }
    if (fclose(file) != 0) {
        fail("%s: %s", name, strerror(errno));
    }
}
