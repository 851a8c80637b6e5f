#include "mpi_scene.h"
#include "tile_work.h"

#include <mpi.h>
#include <stdio.h>
#include <string.h>

static scene read_scene(const char *name, const char *folder) {
    if (strcmp(name, "appendix") == 0) {
        return appendix_scene(folder);
    }
    if (strcmp(name, "puma560") == 0) {
        return puma560_scene(folder);
    }
    fail("there is no scene %s: appendix or puma560", name);
}

scene open_scene(const char *name, const char *folder) {
    double start = MPI_Wtime(), slowest = 0;
    int rank = 0;
    scene s = read_scene(name, folder);
    double seconds = MPI_Wtime() - start;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Reduce(&seconds, &slowest, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    if (rank == 0) {
        printf("the slowest rank read its scene in %.3g s\n", slowest);
    }
    return s;
}

/* Without a shell of contacts, the cost of a map of classes follows its boundary. */
cstk_cobject *obstacles(const scene *s) {
    cstk_cobject *made = NULL;
    require(cstk_cobject_induced(s->space, NULL, 0, s->environment, NULL, 0, NULL, &made));
    return made;
}
