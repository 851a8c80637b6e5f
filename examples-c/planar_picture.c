#include "planar_picture.h"

#include "svg.h"

#include <math.h>

/* The picture's colours, by what is met. */
static const char *const colours[SETS] = {"#e69138", "#8e6bb8", "#c9496b"};
static const char *const arm_colours[LINKS] = {"#2f4b6e", "#4a76a8", "#86aed6"};
static const char *const band_colour = "#f2d94e", *const veil_colour = "#dcdcdc";
static const char *const asked_colour = "#1f77d0", *const normal_colour = "#1a8f3c";
static const char *const contact_colour = "#d21f1f";

/* A part of the picture: `scale` pixels a unit; `low` is what its lower left corner shows. */
typedef struct panel {
    const char *id;
    double left, top, scale;
    double low[2], extent[2];
} panel;

static double right_of(const panel *p) { return p->left + p->scale * p->extent[0]; }
static double bottom_of(const panel *p) { return p->top + p->scale * p->extent[1]; }
static double x_of(const panel *p, double u) { return p->left + p->scale * (u - p->low[0]); }
static double y_of(const panel *p, double v) { return bottom_of(p) - p->scale * (v - p->low[1]); }

static void draw_shape(FILE *svg, const panel *p, const shape *s, const double *pose,
                       const char *fill) {
    fprintf(svg, "<path fill='%s' stroke='#222' stroke-width='2.4' paint-order='stroke' d='", fill);
    for (size_t i = 0; i < s->count; ++i) {
        for (size_t k = 0; k < s->polygons[i].count; ++k) {
            const double *xy = s->polygons[i].xy[k];
            double point[3] = {xy[0], xy[1], 0};
            check(cstk_pose_transform_point(pose, point, point));
            fprintf(svg, "%c%.1f %.1f", k ? 'L' : 'M', x_of(p, point[0]), y_of(p, point[1]));
        }
        fprintf(svg, "z");
    }
    fprintf(svg, "'/>\n");
}

static void draw_arm(FILE *svg, const panel *p, const scene *s, const world *w, const double *q,
                     double opacity) {
    double poses[LINKS + 1][12];
    check(cstk_space_link_poses(w->space, q, LINKS, poses[0]));
    fprintf(svg, "<g opacity='%.2f'>\n", opacity);
    for (int i = 0; i < LINKS; ++i) {
        draw_shape(svg, p, &s->links[i], poses[i], arm_colours[i]);
    }
    for (int i = 0; i < LINKS; ++i) {
        svg_dot(svg, x_of(p, poses[i][3]), y_of(p, poses[i][7]), 5, "#fff");
    }
    fprintf(svg, "</g>\n");
}

static void tip_at(const world *w, const panel *p, const double *q, double *x, double *y) {
    double poses[LINKS + 1][12];
    check(cstk_space_link_poses(w->space, q, LINKS, poses[0]));
    *x = x_of(p, poses[TIP][3]);
    *y = y_of(p, poses[TIP][7]);
}

/* The contacts at q, and their normals, from the s-side to the r-side. */
static void draw_contacts(FILE *svg, const panel *p, const world *w, cstk_query *query,
                          const double *q) {
    cstk_witness_list list;
    check(cstk_witnesses(query, w->cobject, q, LINKS, max_shell, 256, &list));
    for (size_t i = 0; i < list.contact_count; ++i) {
        const cstk_contact *c = &list.contacts[i];
        svg_arrow(svg, x_of(p, c->s_point[0]), y_of(p, c->s_point[1]), 52 * c->normal[0],
                  -52 * c->normal[1], normal_colour);
    }
    for (size_t i = 0; i < list.contact_count; ++i) {
        const cstk_contact *c = &list.contacts[i];
        svg_dot(svg, x_of(p, c->s_point[0]), y_of(p, c->s_point[1]), 5, contact_colour);
        svg_dot(svg, x_of(p, c->r_point[0]), y_of(p, c->r_point[1]), 5, contact_colour);
    }
}

enum { ARMS = 10 };

/* The frames in which the arm is drawn. */
static int shown_frame(const slide *s, int arm) { return (s->last * arm + ARMS / 2) / (ARMS - 1); }

/* The one of them whose contacts are drawn: midway along S0. */
static int contact_frame(const slide *s) {
    int along[ARMS] = {0}, count = 0;
    for (int i = 0; i < ARMS; ++i) {
        if (s->frames[shown_frame(s, i)].near[S0]) {
            along[count++] = shown_frame(s, i);
        }
    }
    return along[count / 2];
}

/* The arm along a slide. */
static void draw_workspace(FILE *svg, const panel *p, const scene *s, const world *w,
                           cstk_query *query, const slide *sl) {
    const double reach = lengths[R0] + lengths[R1] + lengths[R2];
    svg_frame(svg, x_of(p, 0), y_of(p, reach), p->scale * reach, p->scale * reach,
              "stroke='#777' stroke-width='2' stroke-dasharray='10 7'");
    svg_text(svg, x_of(p, reach) - 10, y_of(p, reach) + 28, 20, "end", "world box");
    for (int i = 0; i < OBSTACLES; ++i) {
        double pose[12];
        check(cstk_environment_get_object_pose(s->environment, s->ids[i], pose));
        draw_shape(svg, p, &s->obstacles[i], pose, colours[i]);
        char name[8];
        snprintf(name, sizeof name, "S%d", i);
        svg_text(svg, x_of(p, pose[3]), y_of(p, pose[7]) + 8, 22, "middle", name);
    }
    for (int i = 0; i < ARMS; ++i) {
        int k = shown_frame(sl, i);
        double part = (double)i / (ARMS - 1);
        double opacity = k == contact_frame(sl) ? 0.8 : 0.2 + 0.8 * part * part;
        draw_arm(svg, p, s, w, sl->frames[k].q, opacity);
    }
    fprintf(svg, "<path fill='none' stroke='#000' stroke-width='2.5' d='");
    double x, y;
    for (int k = 0; k <= sl->last; ++k) {
        tip_at(w, p, sl->frames[k].q, &x, &y);
        fprintf(svg, "%c%.1f %.1f", k ? 'L' : 'M', x, y);
    }
    fprintf(svg, "'/>\n");
    draw_contacts(svg, p, w, query, sl->frames[contact_frame(sl)].q);
    draw_contacts(svg, p, w, query, sl->frames[sl->last].q);
    tip_at(w, p, sl->frames[0].q, &x, &y);
    svg_dot(svg, x, y, 7, asked_colour);
    svg_text(svg, x + 14, y + 8, 22, "start", "start");
    tip_at(w, p, sl->frames[sl->last].q, &x, &y);
    svg_dot(svg, x, y, 7, "#000");
    svg_text(svg, x + 18, y + 34, 22, "start", "end");
}

enum { FREE = SETS, BAND, COLUMNS = 420, MAX_ROWS = 1000 };

/* What a point of the slice is in: a set, the contact band or none. */
static int part_at(const world *w, cstk_query *query, const double *q) {
    cstk_class where;
    check(cstk_classify(query, w->cobject, q, LINKS, &where));
    if (where != CSTK_CLASS_INSIDE) {
        return where == CSTK_CLASS_CONTACT ? BAND : FREE;
    }
    for (int i = 0; i < SETS; ++i) {
        check(cstk_classify(query, w->sets[i], q, LINKS, &where));
        if (where == CSTK_CLASS_INSIDE) {
            return i;
        }
    }
    return FREE;
}

/* One path for all cells of a kind: a rectangle for each run in a row. */
static void draw_cells(FILE *svg, const unsigned char *cells, int rows, int kind,
                       const char *fill) {
    fprintf(svg, "<path fill='%s' d='", fill);
    for (int row = 0; row < rows; ++row) {
        const unsigned char *cell = cells + (size_t)row * COLUMNS;
        for (int from = 0, to; from < COLUMNS; from = to) {
            for (to = from + 1; to < COLUMNS && cell[to] == cell[from]; ++to) {
            }
            if (cell[from] == kind) {
                fprintf(svg, "M%d %dh%dv1h%dz", from, row, to - from, from - to);
            }
        }
    }
    fprintf(svg, "'/>\n");
}

/* Fills a panel with the slice of C-space through the held joint. */
static void draw_slice(FILE *svg, const panel *p, const world *w, cstk_query *query) {
    static unsigned char cells[MAX_ROWS * COLUMNS], outside[MAX_ROWS * COLUMNS];
    const double cell = p->extent[0] / COLUMNS;
    const int rows = (int)(p->extent[1] / cell + 0.5);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            const double q[LINKS] = {p->low[0] + (column + 0.5) * cell,
                                     p->low[1] + (rows - row - 0.5) * cell, start[R2]};
            bool in_world;
            check(cstk_space_within_world(w->space, q, LINKS, &in_world, NULL));
            cells[row * COLUMNS + column] = (unsigned char)part_at(w, query, q);
            outside[row * COLUMNS + column] = !in_world;
        }
    }
    fprintf(svg, "<g transform='translate(%.1f %.1f) scale(%.5f)' shape-rendering='crispEdges'>\n",
            p->left, p->top, p->scale * cell);
    for (int i = 0; i < SETS; ++i) {
        draw_cells(svg, cells, rows, i, colours[i]);
    }
    draw_cells(svg, cells, rows, BAND, band_colour);
    fprintf(svg, "<g opacity='0.6'>\n");
    draw_cells(svg, outside, rows, 1, veil_colour);
    fprintf(svg, "</g></g>\n");
}

/* The angle's representative in the panel. */
static double into(const panel *p, int axis, double angle) {
    return angle - 2 * PI * floor((angle - p->low[axis]) / (2 * PI));
}

/* A step of the path: where it leads from q, and whence it comes to next. True if over an edge. */
static bool step_in(const panel *p, const world *w, const double *q, const double *next,
                    double to[2], double from[2]) {
    double v[LINKS];
    check(cstk_space_difference(w->space, q, next, LINKS, v));
    to[0] = x_of(p, into(p, 0, q[0]) + v[0]);
    to[1] = y_of(p, into(p, 1, q[1]) + v[1]);
    from[0] = x_of(p, into(p, 0, next[0]) - v[0]);
    from[1] = y_of(p, into(p, 1, next[1]) - v[1]);
    return fabs(x_of(p, into(p, 0, next[0])) - to[0]) > 1 ||
           fabs(y_of(p, into(p, 1, next[1])) - to[1]) > 1;
}

/* The path through the slice. A step over an edge is drawn, and marked, at both edges. */
static void draw_path(FILE *svg, const panel *p, const world *w, const slide *sl) {
    fprintf(svg,
            "<clipPath id='%s'><rect x='%.1f' y='%.1f' width='%.1f' height='%.1f'/></clipPath>\n"
            "<path clip-path='url(#%s)' fill='none' stroke='#000' stroke-width='3' d='",
            p->id, p->left, p->top, p->scale * p->extent[0], p->scale * p->extent[1], p->id);
    const double *first = sl->frames[0].q, *last = sl->frames[sl->last].q;
    double to[2], from[2], x = x_of(p, into(p, 0, first[0])), y = y_of(p, into(p, 1, first[1]));
    fprintf(svg, "M%.1f %.1f", x, y);
    for (int k = 0; k < sl->last; ++k) {
        const double *next = sl->frames[k + 1].q;
        bool over = step_in(p, w, sl->frames[k].q, next, to, from);
        fprintf(svg, "L%.1f %.1f", to[0], to[1]);
        if (over) {
            fprintf(svg, "M%.1f %.1fL%.1f %.1f", from[0], from[1], x_of(p, into(p, 0, next[0])),
                    y_of(p, into(p, 1, next[1])));
        }
    }
    fprintf(svg, "'/>\n");
    for (int k = 0; k < sl->last; ++k) {
        if (step_in(p, w, sl->frames[k].q, sl->frames[k + 1].q, to, from)) {
            svg_dot(svg, fmin(fmax(to[0], p->left), right_of(p)),
                    fmin(fmax(to[1], p->top), bottom_of(p)), 6, "#fff");
            svg_dot(svg, fmin(fmax(from[0], p->left), right_of(p)),
                    fmin(fmax(from[1], p->top), bottom_of(p)), 6, "#fff");
        }
    }
    svg_arrow(svg, x, y, 70 * asked[0] / hypot(asked[0], asked[1]),
              -70 * asked[1] / hypot(asked[0], asked[1]), asked_colour);
    svg_dot(svg, x, y, 7, asked_colour);
    svg_dot(svg, x_of(p, into(p, 0, last[0])), y_of(p, into(p, 1, last[1])), 7, "#000");
}

/* The gradients of the contacts' distances at q, as far as they lie in the slice: the ways out. */
static void draw_gradients(FILE *svg, const panel *p, const world *w, cstk_query *query,
                           const double *q) {
    cstk_witness_list list;
    check(cstk_gradients(query, w->cobject, q, LINKS, max_shell, 256, &list));
    for (size_t i = 0; i < list.contact_count; ++i) {
        const double *g = &list.gradients[i * list.nv];
        double norm = hypot(g[0], g[1]);
        if (norm > 0) {
            svg_arrow(svg, x_of(p, into(p, 0, q[0])), y_of(p, into(p, 1, q[1])), 60 * g[0] / norm,
                      -60 * g[1] / norm, normal_colour);
        }
    }
}

/* Frame and ticks, every `eighths` of a circle. */
static void draw_axes(FILE *svg, const panel *p, int eighths) {
    static const char *const labels[8] = {"0",      "&#960;/4",  "&#960;/2",  "3&#960;/4",
                                          "&#960;", "5&#960;/4", "3&#960;/2", "7&#960;/4"};
    svg_frame(svg, p->left, p->top, p->scale * p->extent[0], p->scale * p->extent[1],
              "stroke='#333' stroke-width='2'");
    for (int axis = 0; axis < 2; ++axis) {
        double high = p->low[axis] + p->extent[axis];
        for (int k = (int)ceil(p->low[axis] * 4 / PI - 1e-9); k * PI / 4 <= high + 1e-9; ++k) {
            if (k % eighths != 0) {
                continue;
            }
            double x = axis ? p->left : x_of(p, k * PI / 4);
            double y = axis ? y_of(p, k * PI / 4) : bottom_of(p);
            fprintf(svg, "<path stroke='#333' stroke-width='2' d='M%.1f %.1f%s'/>\n", x, y,
                    axis ? "h-8" : "v8");
            const char *label = k == 8 ? "2&#960;" : labels[k % 8];
            svg_text(svg, axis ? x - 14 : x, axis ? y + 7 : y + 32, 21, axis ? "end" : "middle",
                     label);
        }
    }
    svg_text(svg, (p->left + right_of(p)) / 2, bottom_of(p) + 62, 24, "middle", "&#952;&#8320;");
    svg_text(svg, p->left - 92, (p->top + bottom_of(p)) / 2 + 8, 24, "middle", "&#952;&#8321;");
}

static void draw_swatch(FILE *svg, double x, double y, const char *fill) {
    fprintf(svg, "<rect x='%.1f' y='%.1f' width='34' height='22' fill='%s' stroke='#333'/>\n", x,
            y - 18, fill);
}

static void draw_legend(FILE *svg, double x, double y) {
    const char *const fills[] = {colours[S0], colours[S1], colours[SELF], band_colour, veil_colour};
    const char *const names[] = {"a link meets S0", "a link meets S1", "R2 meets R0",
                                 "within the stand-off", "outside the world box"};
    const char *const arrows[] = {asked_colour, normal_colour};
    const char *const meanings[] = {"the step asked for", "contact normal"};
    const char *const dots[] = {asked_colour, "#000", "#fff", contact_colour};
    const char *const places[] = {"start", "end", "the path wraps, 0 = 2&#960;", "contact points"};
    const double line = 36;
    for (int i = 0; i < LINKS; ++i) {
        draw_swatch(svg, x + 40 * i, y, arm_colours[i]);
    }
    svg_text(svg, x + 130, y, 21, "start", "links R0, R1, R2");
    y += line;
    for (size_t i = 0; i < sizeof fills / sizeof *fills; ++i, y += line) {
        draw_swatch(svg, x, y, fills[i]);
        svg_text(svg, x + 50, y, 21, "start", names[i]);
    }
    for (size_t i = 0; i < sizeof arrows / sizeof *arrows; ++i, y += line) {
        svg_arrow(svg, x - 2, y - 7, 38, 0, arrows[i]);
        svg_text(svg, x + 50, y, 21, "start", meanings[i]);
    }
    for (size_t i = 0; i < sizeof dots / sizeof *dots; ++i, y += line) {
        svg_dot(svg, x + 17, y - 7, 7, dots[i]);
        svg_text(svg, x + 50, y, 21, "start", places[i]);
    }
}

static void draw_title(FILE *svg, double x, double y, const char *title, const char *subtitle) {
    svg_text(svg, x, y, 27, "start", title);
    svg_text(svg, x, y + 32, 20, "start", subtitle);
}

void draw_picture(FILE *svg, const scene *s, const world worlds[2], cstk_query *query,
                  const slide slides[2]) {
    const panel held = {"held", 40, 100, 250, {-0.42, -0.25}, {2.8, 2.6}};
    const panel whole = {"whole", 900, 112, 103, {0, 0}, {2 * PI, 2 * PI}};
    const panel nearer = {"nearer", 150, 972, 165, {-0.12, 1.15 * PI}, {1.85, 3.9}};
    const panel every = {"every", 860, 960, 250, {-0.42, -0.25}, {2.8, 2.6}};
    const int contact = contact_frame(&slides[0]), last = slides[0].last;
    char text[256];
    svg_begin(svg, 1600, 1700);
    draw_workspace(svg, &held, s, &worlds[0], query, &slides[0]);
    snprintf(text, sizeof text, "steps 0 to %d; contacts of steps %d and %d", last, contact, last);
    draw_title(svg, 40, 44, "(a) The arm slides, its wrist held", text);

    draw_slice(svg, &whole, &worlds[0], query);
    draw_path(svg, &whole, &worlds[0], &slides[0]);
    draw_axes(svg, &whole, 2);
    snprintf(text, sizeof text, "the slice &#952;&#8322; = %g of the torus", start[R2]);
    draw_title(svg, 900, 44, "(b) The same in C-space", text);

    draw_slice(svg, &nearer, &worlds[0], query);
    draw_path(svg, &nearer, &worlds[0], &slides[0]);
    draw_gradients(svg, &nearer, &worlds[0], query, slides[0].frames[contact].q);
    draw_gradients(svg, &nearer, &worlds[0], query, slides[0].frames[last].q);
    draw_axes(svg, &nearer, 1);
    draw_title(svg, 40, 904, "(c) Nearer, across 2&#960; = 0", "normals of the same contacts");
    draw_legend(svg, 500, 1020);

    draw_workspace(svg, &every, s, &worlds[1], query, &slides[1]);
    snprintf(text, sizeof text, "steps 0 to %d; contacts of steps %d and %d", slides[1].last,
             contact_frame(&slides[1]), slides[1].last);
    draw_title(svg, 860, 904, "(d) The same request, the wrist free to give way", text);
    svg_end(svg);
}
