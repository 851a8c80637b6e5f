/* A robot whose joint is given by functions, which can be made to misbehave. */
#ifndef CSTK_TESTS_WRIST_H
#define CSTK_TESTS_WRIST_H

#include "fixture.h"

enum { BASE = 0, WRIST = 1 };

/* What the functions of a joint are to do; the joint turns about z by its one coordinate. */
typedef struct wrist {
    int32_t pose_status;
    int32_t jacobian_status;
    /* What they write instead of the right numbers, if anything. */
    const double *pose;
    const double *jacobian;
    bool leaves_unwritten;
    /* Called from within the pose function, if anything. */
    void (*call)(struct wrist *);
    const struct scene *scene;
    cstk_status answered;
    int destroyed;
} wrist;

/* A base, and a box that a wrist turns; the box of the fixture's environment is in reach. */
typedef struct scene {
    cstk_robot_builder *builder;
    cstk_robot *robot;
    cstk_space *space;
    cstk_cobject *cobject;
    cstk_query *query;
    double q[1];
} scene;

cstk_custom_joint good_joint(wrist *w);
cstk_link_def wrist_link(const cstk_custom_joint *joint, const cstk_body *body);
void scene_create(const fixture *f, const cstk_custom_joint *joint, scene *s);
void scene_release(const scene *s);

#endif
