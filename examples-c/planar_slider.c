/* A motion filter in the plane: the robot of the report's Figure 16 (section 4.4), three revolute
 * links in a row.
 *
 * The arm is asked to turn; obstacles S0 and S1 and its own first link make a slide of that. It is
 * done twice: with the wrist held, which leaves a slice of C-space that can be drawn, and with all
 * three joints. Usage:
 *
 *   planar_slider FOLDER
 *
 * The picture (planar_slider.svg) and both paths (planar_slider.csv) go to the folder. Build:
 *
 *   cc -std=c99 planar_slider.c $(pkg-config --cflags --libs cstk) -lm -o planar_slider
 */
#include <cstk.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { R0, R1, R2, LINKS, TIP = LINKS };
enum { S0, S1, OBSTACLES, SELF = OBSTACLES, SETS }; /* what can be met; SELF is R0 by R2 */
enum { MAX_CORNERS = 12, MAX_POLYGONS = 5, MAX_STEPS = 400 };

static const double lengths[LINKS] = {1.0, 0.8, 0.5}; /* x0, x1, x2 */
static const double start[LINKS] = {0.05, 0.9, 4.6};
static const double asked[LINKS] = {0.02, -0.004, 0};
static const double max_shell = 0.06; /* the stand-off within which contacts are considered */
static const double desired_distance = 0.02; /* the distance at which the arm slides */

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

typedef struct polygon {
    size_t count;
    double xy[MAX_CORNERS][2];
} polygon;

/* A union of convex polygons, kept for the picture. */
typedef struct shape {
    size_t count;
    polygon polygons[MAX_POLYGONS];
} shape;

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

static cstk_body *make_body(const shape *s) {
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    check(cstk_body_builder_create(2, &builder));
    for (size_t i = 0; i < s->count; ++i) {
        const polygon *p = &s->polygons[i];
        double xyz[3 * MAX_CORNERS] = {0};
        for (size_t k = 0; k < p->count; ++k) {
            xyz[3 * k] = p->xy[k][0];
            xyz[3 * k + 1] = p->xy[k][1];
        }
        check(cstk_body_builder_add_polygon(builder, xyz, p->count, i));
    }
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

typedef struct scene {
    shape links[LINKS], obstacles[OBSTACLES];
    cstk_robot *robot;
    cstk_environment *environment;
    uint64_t ids[OBSTACLES];
} scene;

static void make_shapes(scene *s) {
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

static void make_robot(scene *s) {
    cstk_robot_builder *builder = NULL;
    check(cstk_robot_builder_create(2, &builder));
    /* The last link is the end effector's frame: it has no body. */
    for (int i = 0; i <= LINKS; ++i) {
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        cstk_body *body = i < LINKS ? make_body(&s->links[i]) : NULL;
        def.body = body;
        def.parent = i - 1;
        def.joint = i < LINKS ? CSTK_JOINT_REVOLUTE : CSTK_JOINT_FIXED;
        def.at[3] = i > 0 ? lengths[i - 1] : 0;
        check(cstk_robot_builder_add_link(builder, &def, NULL));
        check(cstk_body_release(body));
    }
    check(cstk_robot_build(builder, &s->robot));
    check(cstk_robot_builder_release(builder));
}

static void make_environment(scene *s) {
    const double at[OBSTACLES][6] = {{1.45, 1.3, 0, 0, -0.5, 0}, {-0.2, 1.05, 0, 0, 0, 0}};
    check(cstk_environment_create(&s->environment));
    for (int i = 0; i < OBSTACLES; ++i) {
        cstk_environment_change change;
        check(cstk_environment_change_default(&change, sizeof change));
        cstk_body *body = make_body(&s->obstacles[i]);
        change.body = body;
        check(cstk_pose_from_euler(at[i], change.pose));
        check(cstk_environment_apply(s->environment, &change, 1, &s->ids[i], NULL));
        check(cstk_body_release(body));
    }
}

/* A C-space of the robot and its C-objects. */
typedef struct world {
    cstk_space *space;
    cstk_cobject *cobject;    /* (R0, S), (R1, S), (R2, S) and (R0, R2) */
    cstk_cobject *sets[SETS]; /* the same, by what is met */
} world;

/* With `held` the third joint keeps its value: its range is that alone. */
static world make_world(const scene *s, bool held) {
    world w;
    cstk_range ranges[LINKS];
    memset(ranges, 0, sizeof ranges);
    for (int i = 0; i < LINKS; ++i) {
        ranges[i].kind = CSTK_RANGE_CIRCLE;
    }
    if (held) {
        ranges[R2].kind = CSTK_RANGE_INTERVAL;
        ranges[R2].lower = ranges[R2].upper = start[R2];
    }
    const double reach = lengths[R0] + lengths[R1] + lengths[R2];
    const double box[6] = {0, 0, 0, reach, reach, 0};
    const cstk_robot *robots[] = {s->robot};
    check(cstk_space_create(robots, 1, ranges, LINKS, box, &w.space));

    cstk_cobject_options options;
    check(cstk_cobject_options_default(&options, sizeof options));
    options.contact_epsilon = max_shell;
    cstk_cobject *parts[LINKS + 1];
    for (uint32_t i = 0; i < LINKS; ++i) {
        check(cstk_cobject_induced(w.space, &i, 1, s->environment, s->ids, OBSTACLES, &options,
                                   &parts[i]));
    }
    const uint32_t pair[2] = {R0, R2};
    check(cstk_cobject_induced_links(w.space, pair, 1, &options, &parts[LINKS]));
    check(cstk_cobject_union((const cstk_cobject *const *)parts, LINKS + 1, &w.cobject));
    for (int i = 0; i < OBSTACLES; ++i) {
        check(cstk_cobject_induced(w.space, NULL, 0, s->environment, &s->ids[i], 1, &options,
                                   &w.sets[i]));
    }
    w.sets[SELF] = parts[LINKS];
    for (int i = 0; i < LINKS; ++i) {
        check(cstk_cobject_release(parts[i]));
    }
    return w;
}

static void release_world(world *w) {
    for (int i = 0; i < SETS; ++i) {
        check(cstk_cobject_release(w->sets[i]));
    }
    check(cstk_cobject_release(w->cobject));
    check(cstk_space_release(w->space));
}

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

static void run_slide(const world *w, cstk_query *query, slide *s) {
    cstk_slide_options options;
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = max_shell;
    options.desired_distance = desired_distance;
    options.normalize = 1;
    memcpy(s->frames[0].q, start, sizeof start);
    for (s->last = 0;; ++s->last) {
        frame *now = &s->frames[s->last];
        for (int i = 0; i < SETS; ++i) {
            check(cstk_within(query, w->sets[i], now->q, LINKS, max_shell, &now->near[i]));
        }
        cstk_slide_result result;
        double next[LINKS];
        check(cstk_slide(query, w->cobject, now->q, LINKS, asked, LINKS, &options, next, &result));
        now->distance = result.distance_before;
        now->contacts = result.contact_count;
        now->outcome = result.outcome;
        if (result.outcome != CSTK_SLIDE_MOVED || s->last == MAX_STEPS) {
            return;
        }
        check(cstk_space_wrap(w->space, next, LINKS, s->frames[s->last + 1].q));
    }
}

static void names_of_near(const frame *f, char *text, size_t size) {
    static const char *const names[SETS] = {" S0", " S1", " R0/R2"};
    size_t used = 0;
    text[0] = 0;
    for (int i = 0; i < SETS; ++i) {
        if (f->near[i]) {
            used += (size_t)snprintf(text + used, size - used, "%s", names[i]);
        }
    }
}

/* The frames at which something comes near or goes away, and every 25th. */
static void print_slide(const slide *s) {
    printf("  step   theta0   theta1   theta2  distance  contacts  outcome\n");
    for (int k = 0; k <= s->last; ++k) {
        const frame *f = &s->frames[k];
        if (k > 0 && k < s->last && k % 25 != 0 &&
            memcmp(f->near, s->frames[k - 1].near, sizeof f->near) == 0) {
            continue;
        }
        char near[32];
        names_of_near(f, near, sizeof near);
        printf("  %4d  %7.4f  %7.4f  %7.4f  %8.4f  %8u  %s%s\n", k, f->q[0], f->q[1], f->q[2],
               f->distance, f->contacts,
               f->outcome == CSTK_SLIDE_INSIDE    ? "inside"
               : f->outcome == CSTK_SLIDE_BLOCKED ? "blocked by"
               : near[0]                          ? "slides on"
                                                  : "free",
               near[0] || f->outcome != CSTK_SLIDE_BLOCKED ? near : " the world box");
    }
}

/* Whether the way from frame to frame is free and in the space; asked anew, at many points. */
static bool is_clear(const world *w, cstk_query *query, const slide *s) {
    enum { POINTS = 20 };
    for (int k = 0; k < s->last; ++k) {
        for (int i = 0; i <= POINTS; ++i) {
            double q[LINKS];
            cstk_class where;
            bool contained;
            check(cstk_space_interpolate(w->space, s->frames[k].q, s->frames[k + 1].q, LINKS,
                                         (double)i / POINTS, q));
            check(cstk_classify(query, w->cobject, q, LINKS, &where));
            check(cstk_space_contains(w->space, q, LINKS, &contained));
            if (where == CSTK_INSIDE || !contained) {
                return false;
            }
        }
    }
    return true;
}

/* Walks straight on, without looking. Returns the first step that leads into S0; 0 if none does. */
static int first_collision(const world *w, cstk_query *query) {
    double q[LINKS];
    memcpy(q, start, sizeof q);
    for (int step = 1; step <= MAX_STEPS; ++step) {
        check(cstk_space_step(w->space, q, LINKS, asked, LINKS, q));
        cstk_class where;
        check(cstk_classify(query, w->sets[S0], q, LINKS, &where));
        if (where == CSTK_INSIDE) {
            return step;
        }
    }
    return 0;
}

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

/* The white rim keeps it legible on whatever is below. */
static void draw_text(FILE *svg, double x, double y, int size, const char *anchor,
                      const char *text) {
    fprintf(
        svg,
        "<text x='%.1f' y='%.1f' font-size='%d' text-anchor='%s' stroke='#fff' stroke-width='5' "
        "stroke-linejoin='round' paint-order='stroke'>%s</text>\n",
        x, y, size, anchor, text);
}

static void draw_dot(FILE *svg, double x, double y, double radius, const char *fill) {
    fprintf(svg, "<circle cx='%.1f' cy='%.1f' r='%.1f' fill='%s' stroke='#000'/>\n", x, y, radius,
            fill);
}

static void draw_arrow(FILE *svg, double x, double y, double dx, double dy, const char *colour) {
    double norm = hypot(dx, dy), ux = 12 * dx / norm, uy = 12 * dy / norm;
    fprintf(svg,
            "<path d='M%.1f %.1fl%.1f %.1f' stroke='%s' stroke-width='3.5'/>"
            "<path d='M%.1f %.1fl%.1f %.1fl%.1f %.1fz' fill='%s'/>\n",
            x, y, dx - ux, dy - uy, colour, x + dx, y + dy, -1.3 * ux - 0.6 * uy,
            -1.3 * uy + 0.6 * ux, 1.2 * uy, -1.2 * ux, colour);
}

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
        draw_dot(svg, x_of(p, poses[i][3]), y_of(p, poses[i][7]), 5, "#fff");
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
        draw_arrow(svg, x_of(p, c->s_point[0]), y_of(p, c->s_point[1]), 52 * c->normal[0],
                   -52 * c->normal[1], normal_colour);
    }
    for (size_t i = 0; i < list.contact_count; ++i) {
        const cstk_contact *c = &list.contacts[i];
        draw_dot(svg, x_of(p, c->s_point[0]), y_of(p, c->s_point[1]), 5, contact_colour);
        draw_dot(svg, x_of(p, c->r_point[0]), y_of(p, c->r_point[1]), 5, contact_colour);
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
    fprintf(svg,
            "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='none' stroke='#777' "
            "stroke-width='2' stroke-dasharray='10 7'/>\n",
            x_of(p, 0), y_of(p, reach), p->scale * reach, p->scale * reach);
    draw_text(svg, x_of(p, reach) - 10, y_of(p, reach) + 28, 20, "end", "world box");
    for (int i = 0; i < OBSTACLES; ++i) {
        double pose[12];
        check(cstk_environment_object_pose(s->environment, s->ids[i], pose));
        draw_shape(svg, p, &s->obstacles[i], pose, colours[i]);
        char name[8];
        snprintf(name, sizeof name, "S%d", i);
        draw_text(svg, x_of(p, pose[3]), y_of(p, pose[7]) + 8, 22, "middle", name);
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
    draw_dot(svg, x, y, 7, asked_colour);
    draw_text(svg, x + 14, y + 8, 22, "start", "start");
    tip_at(w, p, sl->frames[sl->last].q, &x, &y);
    draw_dot(svg, x, y, 7, "#000");
    draw_text(svg, x + 18, y + 34, 22, "start", "end");
}

enum { FREE = SETS, BAND, COLUMNS = 420, MAX_ROWS = 1000 };

/* What a point of the slice is in: a set, the contact band or none. */
static int part_at(const world *w, cstk_query *query, const double *q) {
    cstk_class where;
    check(cstk_classify(query, w->cobject, q, LINKS, &where));
    if (where != CSTK_INSIDE) {
        return where == CSTK_CONTACT ? BAND : FREE;
    }
    for (int i = 0; i < SETS; ++i) {
        check(cstk_classify(query, w->sets[i], q, LINKS, &where));
        if (where == CSTK_INSIDE) {
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
            draw_dot(svg, fmin(fmax(to[0], p->left), right_of(p)),
                     fmin(fmax(to[1], p->top), bottom_of(p)), 6, "#fff");
            draw_dot(svg, fmin(fmax(from[0], p->left), right_of(p)),
                     fmin(fmax(from[1], p->top), bottom_of(p)), 6, "#fff");
        }
    }
    draw_arrow(svg, x, y, 70 * asked[0] / hypot(asked[0], asked[1]),
               -70 * asked[1] / hypot(asked[0], asked[1]), asked_colour);
    draw_dot(svg, x, y, 7, asked_colour);
    draw_dot(svg, x_of(p, into(p, 0, last[0])), y_of(p, into(p, 1, last[1])), 7, "#000");
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
            draw_arrow(svg, x_of(p, into(p, 0, q[0])), y_of(p, into(p, 1, q[1])), 60 * g[0] / norm,
                       -60 * g[1] / norm, normal_colour);
        }
    }
}

/* Frame and ticks, every `eighths` of a circle. */
static void draw_axes(FILE *svg, const panel *p, int eighths) {
    static const char *const labels[8] = {"0",      "&#960;/4",  "&#960;/2",  "3&#960;/4",
                                          "&#960;", "5&#960;/4", "3&#960;/2", "7&#960;/4"};
    fprintf(svg,
            "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='none' stroke='#333' "
            "stroke-width='2'/>\n",
            p->left, p->top, p->scale * p->extent[0], p->scale * p->extent[1]);
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
            draw_text(svg, axis ? x - 14 : x, axis ? y + 7 : y + 32, 21, axis ? "end" : "middle",
                      label);
        }
    }
    draw_text(svg, (p->left + right_of(p)) / 2, bottom_of(p) + 62, 24, "middle", "&#952;&#8320;");
    draw_text(svg, p->left - 92, (p->top + bottom_of(p)) / 2 + 8, 24, "middle", "&#952;&#8321;");
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
        fprintf(svg, "<rect x='%.1f' y='%.1f' width='34' height='22' fill='%s' stroke='#333'/>\n",
                x + 40 * i, y - 18, arm_colours[i]);
    }
    draw_text(svg, x + 130, y, 21, "start", "links R0, R1, R2");
    y += line;
    for (size_t i = 0; i < sizeof fills / sizeof *fills; ++i, y += line) {
        fprintf(svg, "<rect x='%.1f' y='%.1f' width='34' height='22' fill='%s' stroke='#333'/>\n",
                x, y - 18, fills[i]);
        draw_text(svg, x + 50, y, 21, "start", names[i]);
    }
    for (size_t i = 0; i < sizeof arrows / sizeof *arrows; ++i, y += line) {
        draw_arrow(svg, x - 2, y - 7, 38, 0, arrows[i]);
        draw_text(svg, x + 50, y, 21, "start", meanings[i]);
    }
    for (size_t i = 0; i < sizeof dots / sizeof *dots; ++i, y += line) {
        draw_dot(svg, x + 17, y - 7, 7, dots[i]);
        draw_text(svg, x + 50, y, 21, "start", places[i]);
    }
}

static void draw_title(FILE *svg, double x, double y, const char *title, const char *subtitle) {
    draw_text(svg, x, y, 27, "start", title);
    draw_text(svg, x, y + 32, 20, "start", subtitle);
}

/* Of slides[0] and worlds[0] the wrist is held. */
static void draw_picture(FILE *svg, const scene *s, const world worlds[2], cstk_query *query,
                         const slide slides[2]) {
    const panel held = {"held", 40, 100, 250, {-0.42, -0.25}, {2.8, 2.6}};
    const panel whole = {"whole", 900, 112, 103, {0, 0}, {2 * PI, 2 * PI}};
    const panel nearer = {"nearer", 150, 972, 165, {-0.12, 1.15 * PI}, {1.85, 3.9}};
    const panel every = {"every", 860, 960, 250, {-0.42, -0.25}, {2.8, 2.6}};
    const int contact = contact_frame(&slides[0]), last = slides[0].last;
    char text[256];
    fprintf(svg, "<svg xmlns='http://www.w3.org/2000/svg' width='1600' height='1700' "
                 "viewBox='0 0 1600 1700' font-family='DejaVu Sans, sans-serif' fill='#111'>\n"
                 "<rect width='1600' height='1700' fill='#fff'/>\n");
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
    fprintf(svg, "</svg>\n");
}

static void write_paths(FILE *csv, const slide slides[2]) {
    fprintf(csv, "slide,step,theta0,theta1,theta2,distance,contacts\n");
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k <= slides[i].last; ++k) {
            const frame *f = &slides[i].frames[k];
            fprintf(csv, "%s,%d,%.17g,%.17g,%.17g,%.17g,%u\n", slides[i].name, k, f->q[0], f->q[1],
                    f->q[2], f->distance, (unsigned)f->contacts);
        }
    }
}

static FILE *create(const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    return file;
}

static void finish(FILE *file, const char *name) {
    bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        fprintf(stderr, "%s could not be written\n", name);
        exit(1);
    }
}

/* What is meant to happen: round S0, free, along S1, until R2 would meet R0. */
static bool report(const world *w, cstk_query *query, const slide *s) {
    int met = 0, left, next, last = s->last;
    while (met < last && !s->frames[met].near[S0]) {
        ++met;
    }
    for (left = met; left < last && (s->frames[left].near[S0] || s->frames[left].near[S1]);) {
        ++left;
    }
    for (next = left; next < last && !s->frames[next].near[S1];) {
        ++next;
    }
    double least = INFINITY;
    for (int k = 0; k <= last; ++k) {
        least = fmin(least, s->frames[k].distance);
    }
    int collision = first_collision(w, query);
    bool clear = is_clear(w, query, s);
    const frame *end = &s->frames[last];
    printf(
        "  straight on, it would run into S0 at step %d; never nearer than %.4g, the way is %s;\n"
        "  along S0 from step %d to %d, free to %d, then along S1; the wrist moved %.3f rad\n",
        collision, least, clear ? "clear" : "NOT CLEAR", met, left - 1, next - 1,
        fabs(end->q[R2] - start[R2]));
    bool good = collision > 0 && clear && least > 0 && left - met >= 20 && next > left &&
                end->near[S1] && end->near[SELF] && end->outcome == CSTK_SLIDE_BLOCKED;
    printf("  %s\n",
           good ? "the arm slid round S0, went on along S1, and stopped short of its own first link"
                : "THE SLIDE WENT OTHERWISE");
    return good;
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: planar_slider FOLDER\n");
        return 2;
    }
    static scene s;
    static slide slides[2] = {{.name = "wrist held"}, {.name = "all joints"}};
    world worlds[2];
    make_shapes(&s);
    make_robot(&s);
    make_environment(&s);
    cstk_query *query = NULL;
    check(cstk_query_create(&query));
    bool good = true;
    for (int i = 0; i < 2; ++i) {
        worlds[i] = make_world(&s, i == 0);
        run_slide(&worlds[i], query, &slides[i]);
        printf("%s: by (%g, %g, %g) a step, stand-off %g\n", slides[i].name, asked[0], asked[1],
               asked[2], max_shell);
        print_slide(&slides[i]);
        good = report(&worlds[i], query, &slides[i]) && good;
    }
    /* The wrist stayed where its range holds it; let go, it gave way. */
    double held = slides[0].frames[slides[0].last].q[R2],
           freed = slides[1].frames[slides[1].last].q[R2];
    good = good && held == start[R2] && fabs(freed - start[R2]) > 0.2;

    FILE *svg = create(argv[1], "planar_slider.svg");
    draw_picture(svg, &s, worlds, query, slides);
    finish(svg, "planar_slider.svg");
    FILE *csv = create(argv[1], "planar_slider.csv");
    write_paths(csv, slides);
    finish(csv, "planar_slider.csv");
    for (int i = 0; i < 2; ++i) {
        release_world(&worlds[i]);
    }
    check(cstk_query_release(query));
    check(cstk_environment_release(s.environment));
    check(cstk_robot_release(s.robot));
    return good ? 0 : 1;
}
