/* The two scenes of puma_slider.c and puma_shortcut.c: the arm of the report's Appendix A, and a Puma 560. */
#ifndef PUMA_SCENE_H
#define PUMA_SCENE_H

#include <cstk.h>

enum { MAX_JOINTS = 6 };

/* A robot, its surroundings, and a motion that would run into them. */
typedef struct scene {
    const char *name;
    cstk_robot *robot;
    cstk_space *space;
    cstk_environment *environment;
    cstk_cobject *cobject; /* the union of the links' induced C-objects */
    size_t nq;
    double start[MAX_JOINTS];
    double step[MAX_JOINTS];
    int steps;
    double max_shell;        /* the stand-off within which contacts are considered */
    double desired_distance; /* the distance at which the robot slides */
} scene;

/* Ends the program with the library's message unless the status is CSTK_OK. */
void check(cstk_status status);

/* Appendix A: three links and a tilted cylinder, from the models in a folder. */
scene appendix_scene(const char *models);

/* A Puma 560 with its published kinematics and the STL meshes in a folder, in a workcell. */
scene puma560_scene(const char *meshes);

void release_scene(scene *s);

#endif
