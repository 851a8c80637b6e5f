/* One small scene with an object of every kind, and collections of bad input for the hostile tests.
 */
#ifndef CSTK_TESTS_FIXTURE_H
#define CSTK_TESTS_FIXTURE_H

#include <cstk.h>

typedef enum noun {
    NOUN_BODY_BUILDER,
    NOUN_BODY,
    NOUN_MESH,
    NOUN_ROBOT_BUILDER,
    NOUN_ROBOT,
    NOUN_SPACE,
    NOUN_ENVIRONMENT,
    NOUN_COBJECT,
    NOUN_QUERY,
    NOUN_CERTIFICATE,
    NOUN_BATCH,
    NOUN_MAP,
    NOUN_OCTREE,
    NOUN_COUNT
} noun;

enum { FIXTURE_NQ = 3, FIXTURE_NV = 3, FIXTURE_LINKS = 4, FIXTURE_BASE = 0, FIXTURE_TIP = 3 };

/* A planar-looking arm in space: a base without a body and three links with a box each, turning
 * about z; an environment with one box. At `q` the arm is free. */
typedef struct fixture {
    cstk_body_builder *body_builder;
    cstk_body *body;
    /* The surface of the body's one node. */
    cstk_mesh *mesh;
    cstk_robot_builder *robot_builder;
    cstk_robot *robot;
    cstk_space *space;
    cstk_environment *environment;
    uint64_t box;
    cstk_cobject *cobject;
    cstk_query *query;
    /* That the arm, at rest at `q`, is free. */
    cstk_certificate *certificate;
    cstk_batch *batch;
    /* Of one cell. */
    cstk_map *map;
    /* Of one occupied cell, around the origin's upper side; in no environment. */
    cstk_octree *octree;
    double q[FIXTURE_NQ];
    double link_poses[12 * FIXTURE_LINKS];
    /* The answer at q when all was made. */
    cstk_distance_result distance;
    /* One handle of each kind, and one that was released. */
    void *live[NOUN_COUNT];
    void *released[NOUN_COUNT];
} fixture;

extern const double identity_pose[12];

void fixture_create(fixture *f);
void fixture_release(fixture *f);

/* Ends the program unless all objects answer as they did when they were made. */
void fixture_unchanged(const fixture *f);

/* A solid box with these half extents about the origin. */
cstk_body *make_box(double x, double y, double z);

/* A pose without rotation. */
void translation(double x, double y, double z, double pose[12]);

/* Adds one body to an environment; returns the object's id. */
uint64_t add_object(cstk_environment *environment, const cstk_body *body, double x, double y,
                    double z);

/* The arm with this builder's and body's handles. */
cstk_robot *make_arm(cstk_robot_builder *builder, const cstk_body *body);

typedef struct bad_handle {
    void *handle;
    cstk_status status;
} bad_handle;

/* NULL, every other kind, and released handles; ends with status CSTK_OK. */
const bad_handle *bad_handles(const fixture *f, noun wanted);

#define EACH_BAD_HANDLE(f, wanted, bad)                                                            \
    for (const bad_handle *bad = bad_handles(f, wanted); bad->status != CSTK_OK; ++bad)

typedef struct bad_pose {
    double pose[12];
    cstk_status status;
} bad_pose;

/* NaN and infinity in each entry, reflections, shears, scalings; ends with status CSTK_OK. */
const bad_pose *bad_poses(void);

#define EACH_BAD_POSE(bad) for (const bad_pose *bad = bad_poses(); bad->status != CSTK_OK; ++bad)

typedef struct bad_options {
    const void *options;
    cstk_status status;
} bad_options;

/* Damaged copies of a good options structure; ends with status CSTK_OK. Valid until the next call.
 */
const bad_options *bad_options_like(const void *good, size_t size);

#define EACH_BAD_OPTIONS(good, bad)                                                                \
    for (const bad_options *bad = bad_options_like(&(good), sizeof(good)); bad->status != CSTK_OK; \
         ++bad)

/* A progress function for calls that are refused before they begin. */
int32_t never_called(double fraction, void *user);

extern const double not_finite[3];

#define EACH_NOT_FINITE(i) for (int i = 0; i < 3; ++i)

#endif
