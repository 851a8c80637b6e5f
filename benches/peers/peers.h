/* The C interface of the libraries the benchmarks compare with. Each library has the same functions, with its own prefix. */
#ifndef PEERS_H
#define PEERS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct peer_mesh {
    const double *vertices; /* three numbers each */
    size_t vertex_count;
    const uint32_t *triangles; /* three indices each */
    size_t triangle_count;
} peer_mesh;

enum { PEER_DISTANCE = 0, PEER_WITHIN = 1, PEER_COLLIDE = 2 };

/* Variants are numbered from 0 for all modes together. scene returns NULL where the variant does not exist or the peer
 * cannot build it. run writes one answer per query, a distance (0 where bodies meet) or 1 and 0, and returns the seconds
 * of the pass, or -1 where the variant does not serve the mode or the peer failed. poses holds moving_count poses for
 * each query, each a row-major 3 by 4 matrix [R|t]. A scene keeps what the last query of a run found, never more than
 * that: a run starts afresh. */
#define PEER_FUNCTIONS(name)                                                                                            \
    int name##_variant_count(int mode); /* one more than the highest variant which serves the mode */                   \
    int name##_variant_serves(int variant, int mode);                                                                   \
    const char *name##_variant_name(int variant);                                                                       \
    void *name##_scene(const peer_mesh *moving, size_t moving_count, const peer_mesh *obstacles,                        \
                       size_t obstacle_count, int variant);                                                             \
    void name##_scene_free(void *scene);                                                                                \
    double name##_run(void *scene, int mode, double threshold, const double *poses, size_t query_count, double *answers)

PEER_FUNCTIONS(fcl);
PEER_FUNCTIONS(coal);

#ifdef __cplusplus
}
#endif
#endif
