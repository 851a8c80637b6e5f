/* The C interface by which the shapes benchmark asks the libraries about two bodies at two poses.
 * Each library has the same functions, with its own prefix. */
#ifndef PEER_SHAPES_H
#define PEER_SHAPES_H

#include "peers.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What axis a shape has is z, and its middle is the origin. Sizes are: a radius; a radius and the
 * length of the axis (capsule, cylinder, cone); half sides; semi-axes; the side of a voxel. */
enum {
    PEER_SPHERE,
    PEER_CAPSULE,
    PEER_BOX,
    PEER_CYLINDER,
    PEER_CONE,
    PEER_ELLIPSOID,
    PEER_HULL,
    PEER_MESH,
    PEER_CLOUD
};

typedef struct peer_shape {
    int kind;
    double sizes[3];
    peer_mesh surface; /* of hulls and meshes; of clouds the points */
} peer_shape;

/* Beside the modes of peers.h: how many contacts there are, up to a number. */
enum { PEER_CONTACTS = 3 };

/* Variants are numbered from 0; pair_variant gives NULL past the last. pair gives NULL where the
 * variant does not serve the shapes or the mode. pair_run takes two poses for each query and a
 * threshold, which only PEER_WITHIN reads; it returns the seconds of the pass, or -1 where the
 * library failed. */
#define PEER_SHAPE_FUNCTIONS(name)                                                                 \
    const char *name##_pair_variant(int variant);                                                  \
    void *name##_pair(const peer_shape *first, const peer_shape *second, int mode,                 \
                      size_t most_contacts, int variant);                                          \
    void name##_pair_free(void *pair);                                                             \
    double name##_pair_run(void *pair, const double *poses, const double *thresholds,              \
                           size_t query_count, double *answers)

PEER_SHAPE_FUNCTIONS(fcl);
PEER_SHAPE_FUNCTIONS(coal);

#ifdef __cplusplus
}
#endif
#endif
