#include "planar_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double lengths[LINKS] = {1.0, 0.8, 0.5};
const double start[LINKS] = {0.05, 0.9, 4.6};
const double asked[LINKS] = {0.02, -0.004, 0};
const double max_shell = 0.06;
const double desired_distance = 0.02;

void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

static void add_polygon(shape *s, size_t count, const double xy[][2]) {
    polygon *added = &s->polygons[s->count++];
    added->count = count;
    memcpy(added->xy, xy, count * sizeof xy[0]);
}

static void add_round(shape *s, double x, double radius) {
    polygon *added = &s->polygons[s->count++];
    added->count = MAX_CORNERS;
    for (int i = 0; i < MAX_CORNERS; ++i) {
        double angle = 2 * PI * (i + 0.5) / MAX_CORNERS;
        added->xy[i][0] = x + radius * cos(angle);
        added->xy[i][1] = radius * sin(angle);
    }
}

/* From half width a at x = from to half width b at x = to. */
static void add_taper(shape *s, double from, double a, double to, double b) {
    const double xy[][2] = {{from, -a}, {to, -b}, {to, b}, {from, a}};
    add_polygon(s, 4, xy);
}

void make_shapes(scene *s) {
    add_round(&s->links[R0], 0, 0.14);
    add_taper(&s->links[R0], 0, 0.12, lengths[R0], 0.065);
    add_round(&s->links[R0], lengths[R0], 0.09);
    add_round(&s->links[R1], 0, 0.085);
    add_taper(&s->links[R1], 0, 0.075, lengths[R1], 0.04);
    add_round(&s->links[R1], lengths[R1], 0.06);
    /* A gripper; the tip is between its fingers. */
    const double palm[][2] = {{0.25, -0.09}, {0.31, -0.09}, {0.31, 0.09}, {0.25, 0.09}};
    const double left[][2] = {{0.25, 0.05}, {0.5, 0.025}, {0.5, 0.05}, {0.25, 0.09}};
    const double right[][2] = {{0.25, -0.09}, {0.5, -0.05}, {0.5, -0.025}, {0.25, -0.05}};
    add_taper(&s->links[R2], 0, 0.045, 0.28, 0.03);
    add_polygon(&s->links[R2], 4, palm);
    add_polygon(&s->links[R2], 4, left);
    add_polygon(&s->links[R2], 4, right);
    const double bar[][2] = {{-0.3, -0.1}, {0.3, -0.1}, {0.34, 0.1}, {-0.3, 0.1}};
    const double horn[][2] = {{-0.3, -0.1}, {-0.1, -0.1}, {-0.14, 0.45}, {-0.3, 0.36}};
    const double stone[][2] = {
        {-0.2, -0.12}, {0.15, -0.2}, {0.25, 0.05}, {0.05, 0.25}, {-0.2, 0.15}};
    add_polygon(&s->obstacles[S0], 4, bar);
    add_polygon(&s->obstacles[S0], 4, horn);
    add_polygon(&s->obstacles[S1], 5, stone);
}
