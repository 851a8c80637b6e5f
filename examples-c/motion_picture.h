/* The sweep of motion.c from above: the sampled poses, the plate and the first contact. */
#ifndef MOTION_PICTURE_H
#define MOTION_PICTURE_H

#include <cstk.h>

/* What is drawn. Lengths in metres, angles in radians. */
typedef struct motion_picture {
    const cstk_space *space;
    const double *from, *to; /* two coordinates each */
    int samples;             /* how many steps the sampling takes */
    const double *contact;   /* the configuration at the first contact */
    double link_half[2];     /* half the links' length and width; they begin at their joints */
    double plate_angle;
    double plate_center;     /* its distance from the origin */
    double plate_half[2];    /* half its length along the radius and its thickness */
} motion_picture;

/* Writes an SVG file; says whether it could. */
int draw_motion(const motion_picture *picture, const char *path);

#endif
