/* Boxes in space, seen from a corner of the room, and a curve over time. */
#ifndef BOX_PICTURE_H
#define BOX_PICTURE_H

#include <stddef.h>
#include <stdio.h>

/* A box to be drawn: its pose as 12 doubles, half its sides, and a colour's hue in degrees. */
typedef struct drawn_box {
    double pose[12];
    double half[3];
    double hue;
} drawn_box;

/* The boxes about (x, y), where the origin lies, at `scale` pixels a metre. */
void draw_boxes(FILE *svg, const drawn_box *boxes, size_t count, double x, double y, double scale);

/* A curve in a frame, from the least to the largest value. */
void draw_curve(FILE *svg, const double *values, size_t count, double x, double y, double width,
                double height, const char *title);

#endif
