#include "box_picture.h"
#include "svg.h"

#include <math.h>
#include <stdlib.h>

/* A point on the page, and how far it is from the eye. */
static void project(const double p[3], double out[3]) {
    const double turn = 0.55, rise = 0.32;
    const double right = cos(turn) * p[0] + sin(turn) * p[1];
    const double away = -sin(turn) * p[0] + cos(turn) * p[1];
    out[0] = right;
    out[1] = cos(rise) * p[2] + sin(rise) * away;
    out[2] = cos(rise) * away - sin(rise) * p[2];
}

typedef struct face {
    double corners[4][3];
    double depth, light, hue;
} face;

static int farther_first(const void *a, const void *b) {
    const double da = ((const face *)a)->depth, db = ((const face *)b)->depth;
    return (da < db) - (da > db);
}

/* The side of a box along an axis, up or down; false if it is turned away. */
static int make_face(const drawn_box *box, int axis, int sign, face *out) {
    static const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double normal[3], seen[3];
    for (int i = 0; i < 3; ++i) {
        normal[i] = sign * box->pose[4 * i + axis];
    }
    project(normal, seen);
    if (seen[2] >= 0) {
        return 0;
    }
    out->depth = 0;
    out->hue = box->hue;
    out->light = 46 + 26 * (0.35 * normal[0] - 0.25 * normal[1] + 0.9 * normal[2]);
    for (int c = 0; c < 4; ++c) {
        double own[3], world[3];
        own[axis] = sign * box->half[axis];
        own[u] = around[c][0] * box->half[u];
        own[v] = around[c][1] * box->half[v];
        for (int i = 0; i < 3; ++i) {
            const double *row = &box->pose[4 * i];
            world[i] = row[0] * own[0] + row[1] * own[1] + row[2] * own[2] + row[3];
        }
        project(world, out->corners[c]);
        out->depth += out->corners[c][2] / 4;
    }
    return 1;
}

void draw_boxes(FILE *svg, const drawn_box *boxes, size_t count, double x, double y, double scale) {
    face *faces = malloc((6 * count + 1) * sizeof *faces);
    size_t seen = 0;
    if (faces == NULL) {
        abort();
    }
    for (size_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int sign = -1; sign <= 1; sign += 2) {
                seen += (size_t)make_face(&boxes[i], axis, sign, &faces[seen]);
            }
        }
    }
    qsort(faces, seen, sizeof *faces, farther_first);
    for (size_t i = 0; i < seen; ++i) {
        fprintf(svg, "<path d='");
        for (int c = 0; c < 4; ++c) {
            fprintf(svg, "%c%.2f %.2f", c == 0 ? 'M' : 'L', x + scale * faces[i].corners[c][0],
                    y - scale * faces[i].corners[c][1]);
        }
        fprintf(svg, "z' fill='hsl(%.0f,55%%,%.0f%%)' stroke='#222' stroke-width='.8' stroke-linejoin='round'/>\n",
                faces[i].hue, faces[i].light);
    }
    free(faces);
}

void draw_curve(FILE *svg, const double *values, size_t count, double x, double y, double width,
                double height, const char *title) {
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        least = fmin(least, values[i]);
        most = fmax(most, values[i]);
    }
    svg_frame(svg, x, y, width, height, "stroke='#999'");
    fprintf(svg, "<polyline fill='none' stroke='#b02020' stroke-width='2' points='");
    for (size_t i = 0; i < count; ++i) {
        const double up = most > least ? (values[i] - least) / (most - least) : 0.5;
        fprintf(svg, "%.1f,%.1f ", x + width * (double)i / (double)(count - 1),
                y + height - 4 - (height - 8) * up);
    }
    fprintf(svg, "'/>\n");
    svg_text(svg, x + 8, y + height + 20, 15, "start", title);
}
