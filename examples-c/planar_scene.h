/* The scene of planar_slider.c: a planar arm, two obstacles and the step asked of the arm; and what
 * planar_slider.c makes of it for planar_judge.c and planar_picture.c to read. */
#ifndef PLANAR_SCENE_H
#define PLANAR_SCENE_H

#include <cstk.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PI 3.14159265358979323846

enum { R0, R1, R2, LINKS, TIP = LINKS };
enum { S0, S1, OBSTACLES, SELF = OBSTACLES, SETS }; /* what can be met; SELF is R0 by R2 */
enum { MAX_CORNERS = 12, MAX_POLYGONS = 5, MAX_STEPS = 400 };

extern const double lengths[LINKS]; /* x0, x1, x2 */
extern const double start[LINKS];
extern const double asked[LINKS];
extern const double max_shell;        /* the stand-off within which contacts are considered */
extern const double desired_distance; /* the distance at which the arm slides */

typedef struct polygon {
    size_t count;
    double xy[MAX_CORNERS][2];
} polygon;

/* A union of convex polygons, kept for the picture. */
typedef struct shape {
    size_t count;
    polygon polygons[MAX_POLYGONS];
} shape;

typedef struct scene {
    shape links[LINKS], obstacles[OBSTACLES];
    cstk_robot *robot;
    cstk_environment *environment;
    uint64_t ids[OBSTACLES];
} scene;

/* A C-space of the robot and its C-objects. */
typedef struct world {
    cstk_space *space;
    cstk_cobject *cobject;    /* (R0, S), (R1, S), (R2, S) and (R0, R2) */
    cstk_cobject *sets[SETS]; /* the same, by what is met */
} world;

/* A configuration of a slide, and what became of the step from it. */
typedef struct frame {
    double q[LINKS]; /* circles in [0, 2 pi) */
    double distance;
    uint32_t contacts;
    bool near[SETS]; /* within the stand-off */
    cstk_slide_outcome outcome;
} frame;

typedef struct slide {
    const char *name;
    int last; /* the number of the last frame */
    frame frames[MAX_STEPS + 1];
} slide;

/* Ends the program with the library's message unless the status is CSTK_OK. */
void check(cstk_status status);

/* Fills in the polygons of the links and the obstacles. */
void make_shapes(scene *s);

#endif
