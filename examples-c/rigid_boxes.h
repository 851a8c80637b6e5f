/* Rigid boxes that fall, stop and slide: the state, and one step by impulses at contacts that others find. SI units. */
#ifndef RIGID_BOXES_H
#define RIGID_BOXES_H

#include <stddef.h>

typedef struct rigid_box {
    double half[3];
    double mass;
    double inertia[3];         /* about the box's own axes */
    double position[3];        /* of the centre */
    double turn[4];            /* a unit quaternion x, y, z, w: the box's axes in the world */
    double velocity[3], spin[3]; /* in the world */
} rigid_box;

/* Where two boxes may meet within the step. A box of NULL is the ground, which does not move. */
typedef struct touch {
    rigid_box *r, *s;
    double point[3];
    double normal[3]; /* from s to r */
    double clearance; /* how far apart they are there */
} touch;

/* A box at rest, of a density in kg / m^3. */
rigid_box make_rigid_box(const double half[3], const double position[3], double density);

/* The pose as the library takes it: 12 doubles. */
void box_pose(const rigid_box *box, double pose[12]);

/* Kinetic and potential energy, joules; heights count from z = 0. */
double box_energy(const rigid_box *box);

/* Gravity for a time, in seconds. */
void accelerate(rigid_box *boxes, size_t count, double time);

/* Changes the velocities so that no contact comes nearer than `gap` within `time`, with friction. */
void push_apart(const touch *touches, size_t count, double gap, double friction, double time);

/* Moves the boxes by their velocities. */
void move_boxes(rigid_box *boxes, size_t count, double time);

#endif
