/* The scenes of puma_scene.h, as map_mpi.c and batch_mpi.c ask about them. */
#ifndef MPI_SCENE_H
#define MPI_SCENE_H

#include "puma_scene.h"

/* `name` is appendix or puma560. Rank 0 prints how long the slowest rank took. */
scene open_scene(const char *name, const char *folder);

/* The links against the objects. */
cstk_cobject *obstacles(const scene *s);

#endif
