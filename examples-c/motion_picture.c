#include "motion_picture.h"

#include "svg.h"

#include <math.h>
#include <stdlib.h>

/* A part of the plane and where it is drawn, in pixels; y points up in the plane and down on the page. */
typedef struct view {
    double left, low, scale;
    double x, y, width, height;
} view;

/* The corners of a rectangle: from a point along a direction, with half a width to either side. */
typedef struct rectangle {
    double x[4], y[4];
} rectangle;

static rectangle bar(double x, double y, double angle, double from, double to, double half) {
    const double along[2] = {cos(angle), sin(angle)};
    const double at[4] = {from, to, to, from}, side[4] = {-half, -half, half, half};
    rectangle made;
    for (int i = 0; i < 4; ++i) {
        made.x[i] = x + at[i] * along[0] - side[i] * along[1];
        made.y[i] = y + at[i] * along[1] + side[i] * along[0];
    }
    return made;
}

static void draw(FILE *svg, const view *v, const rectangle *shape, const char *style) {
    fprintf(svg, "<polygon points=\"");
    for (int i = 0; i < 4; ++i) {
        fprintf(svg, "%.2f,%.2f ", v->x + (shape->x[i] - v->left) * v->scale,
                v->y + v->height - (shape->y[i] - v->low) * v->scale);
    }
    fprintf(svg, "\" %s/>\n", style);
}

/* The arm at a configuration. */
static void draw_arm(FILE *svg, const motion_picture *p, const view *v, const double q[2],
                     const char *style) {
    double poses[2 * 12];
    if (cstk_space_link_poses(p->space, q, 2, poses) != CSTK_OK) {
        fprintf(stderr, "%s\n", cstk_last_error_message());
        exit(1);
    }
    for (int i = 0; i < 2; ++i) {
        const double *pose = poses + 12 * i;
        const double angle = atan2(pose[4], pose[0]);
        const rectangle link =
            bar(pose[3], pose[7], angle, 0, 2 * p->link_half[0], p->link_half[1]);
        draw(svg, v, &link, style);
    }
}

static void draw_scene(FILE *svg, const motion_picture *p, const view *v, const char *clip) {
    fprintf(svg, "<clipPath id=\"%s\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/></clipPath>\n",
            clip, v->x, v->y, v->width, v->height);
    fprintf(svg, "<g clip-path=\"url(#%s)\">\n", clip);
    for (int i = 0; i <= p->samples; ++i) {
        double q[2];
        if (cstk_space_interpolate(p->space, p->from, p->to, 2, (double)i / p->samples, q) != CSTK_OK) {
            fprintf(stderr, "%s\n", cstk_last_error_message());
            exit(1);
        }
        draw_arm(svg, p, v, q, "fill=\"#4477aa\" fill-opacity=\".12\" stroke=\"#4477aa\" stroke-width=\".7\"");
    }
    draw_arm(svg, p, v, p->contact,
             "fill=\"#cc3311\" fill-opacity=\".25\" stroke=\"#cc3311\" stroke-width=\"1.5\"");
    const rectangle plate =
        bar(0, 0, p->plate_angle, p->plate_center - p->plate_half[0],
            p->plate_center + p->plate_half[0], p->plate_half[1]);
    draw(svg, v, &plate, "fill=\"black\" stroke=\"black\" stroke-width=\"1\"");
    fprintf(svg, "</g>\n");
    svg_frame(svg, v->x, v->y, v->width, v->height, "stroke=\"#888888\"");
}

int draw_motion(const motion_picture *picture, const char *path) {
    FILE *svg = fopen(path, "w");
    if (svg == NULL) {
        return 0;
    }
    svg_begin(svg, 1240, 620);
    const view whole = {-0.15, -0.15, 240, 20, 60, 600, 540};
    /* The plate's end that reaches into the sweep. */
    const double end = picture->plate_center - picture->plate_half[0];
    const double side = 0.06;
    const view near_plate = {end * cos(picture->plate_angle) - side / 2,
                             end * sin(picture->plate_angle) - side / 2,
                             540 / side, 660, 60, 540, 540};
    draw_scene(svg, picture, &whole, "whole");
    draw_scene(svg, picture, &near_plate, "near");
    svg_text(svg, 20, 40, 20, "start", "sampled every 0.05 rad (blue): free; the first contact (red)");
    svg_text(svg, 660, 40, 20, "start", "6 cm around the end of the plate, which is 2 mm thick");
    svg_end(svg);
    return fclose(svg) == 0;
}
