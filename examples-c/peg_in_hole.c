/* Fine motion: a square peg of 20 mm into a square hole that is .05 mm wider on each side, from beside it and tilted, by compliance
 * along the gradients of its contacts.
 *
 *   cc -std=c99 peg_in_hole.c svg.c $(pkg-config --cflags --libs cstk) -lm -o peg_in_hole && ./peg_in_hole peg_in_hole.svg
 *
 * Each round pushes down by cstk_slide, which takes from the step what the contacts do not allow, and proves the rest free; then
 * cstk_spring_step, from the gradients of all contacts within a shell, moves the peg away from the walls, out to the largest
 * distance that they can share: in the hole that centres and straightens it. That step too is proved free (cstk_slide). Nothing
 * knows where the hole is. With the name of a file it draws the peg on its way. Lengths are in centimetres, so that a radian at the
 * peg's edge is about as long as a unit.
 */
#include "svg.h"

#include <cstk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NQ = 6, ROUNDS = 2000, SHOTS = 4 }; /* x, y, z, and turns about x, y, z */
static const double half_width = 1, half_length = 3, clearance = 0.005;
static const double depth = 4, chamfer = 0.1, wall = 1.5;
static const double push = 0.01, shell = 0.02, desired = 0.004;

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

/* One wall of the hole: its section in the plane of the wall's normal and z, drawn out along the wall. Its upper edge is chamfered. */
static void add_wall(cstk_body_builder *builder, int side) {
    const double inner = half_width + clearance, reach = inner + wall;
    const double section[5][2] = {
        {inner, -depth}, {inner, -chamfer}, {inner + chamfer, 0}, {reach, 0}, {reach, -depth}};
    double points[30];
    for (int i = 0; i < 10; ++i) {
        const double out = section[i % 5][0], along = i < 5 ? -reach : reach;
        const double x[2] = {side < 2 ? out : along, side < 2 ? along : out};
        const double sign = side % 2 == 0 ? 1 : -1;
        points[3 * i] = sign * x[0];
        points[3 * i + 1] = sign * x[1];
        points[3 * i + 2] = section[i % 5][1];
    }
    check(cstk_body_builder_add_polyhedron(builder, points, 10, (uint64_t)side));
}

static cstk_body *built(cstk_body_builder *builder) {
    cstk_body *body = NULL;
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

static cstk_environment *make_hole(void) {
    cstk_body_builder *builder = NULL;
    cstk_environment *environment = NULL;
    cstk_environment_change add;
    check(cstk_body_builder_create(3, &builder));
    for (int side = 0; side < 4; ++side) {
        add_wall(builder, side);
    }
    cstk_body *body = built(builder);
    check(cstk_environment_create(&environment));
    check(cstk_environment_change_default(&add, sizeof add));
    add.body = body;
    check(cstk_environment_apply(environment, &add, 1, NULL, NULL));
    check(cstk_body_release(body));
    return environment;
}

/* A peg that moves along and turns about three axes; its frame is at the middle of its lower end. */
static cstk_space *make_peg(void) {
    const double middle[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, half_length};
    const double half[3] = {half_width, half_width, half_length};
    cstk_body_builder *body_builder = NULL;
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    cstk_space *space = NULL;
    check(cstk_body_builder_create(3, &body_builder));
    check(cstk_body_builder_add_box(body_builder, middle, half, 0));
    cstk_body *body = built(body_builder);
    check(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < NQ; ++i) {
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        def.parent = i - 1;
        def.joint = i < 3 ? CSTK_JOINT_PRISMATIC : CSTK_JOINT_REVOLUTE;
        for (int k = 0; k < 3; ++k) {
            def.axis[k] = k == i % 3;
        }
        def.body = i == NQ - 1 ? body : NULL;
        check(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    check(cstk_robot_build(builder, &robot));
    const cstk_robot *robots[1] = {robot};
    check(cstk_space_create(robots, 1, NULL, 0, NULL, &space));
    check(cstk_robot_release(robot));
    check(cstk_robot_builder_release(builder));
    check(cstk_body_release(body));
    return space;
}

/* The section through the middle, enlarged across: hole, and peg at q. */
static void draw(FILE *svg, const double q[NQ], double x, double y, const char *title) {
    const double scale = 38, inner = half_width + clearance;
    for (int sign = -1; sign <= 1; sign += 2) {
        fprintf(svg, "<path d='M%.2f %.2fL%.2f %.2fL%.2f %.2fL%.2f %.2fL%.2f %.2fz' fill='#c9c4b8' stroke='#555'/>\n",
                x + sign * scale * inner, y + scale * depth, x + sign * scale * inner, y + scale * chamfer,
                x + sign * scale * (inner + chamfer), y, x + sign * scale * (inner + wall), y,
                x + sign * scale * (inner + wall), y + scale * depth);
    }
    fprintf(svg, "<path d='");
    for (int i = 0; i < 4; ++i) {
        const double u = i == 0 || i == 3 ? -half_width : half_width, v = i < 2 ? 0 : 2 * half_length;
        fprintf(svg, "%c%.2f %.2f", i == 0 ? 'M' : 'L', x + scale * (q[0] + cos(q[4]) * u + sin(q[4]) * v),
                y - scale * (q[2] - sin(q[4]) * u + cos(q[4]) * v));
    }
    fprintf(svg, "z' fill='#6f9fd8' fill-opacity='.85' stroke='#234'/>\n");
    svg_text(svg, x, y + scale * depth + 34, 14, "middle", title);
}

typedef struct insertion {
    cstk_query *query;
    cstk_cobject *hole;
    double q[NQ];
    cstk_slide_options options;
    int steps; /* that moved the peg; each was proved free */
} insertion;

static int step_by(insertion *at, const double step[NQ]) {
    cstk_slide_result slid;
    check(cstk_slide(at->query, at->hole, at->q, NQ, step, NQ, &at->options, at->q, &slid));
    at->steps += slid.outcome == CSTK_SLIDE_MOVED;
    return slid.outcome == CSTK_SLIDE_MOVED;
}

/* Down, as far as the contacts let it; then away from all of them. Returns whether the peg moved. */
static int round_of(insertion *at) {
    const double down[NQ] = {0, 0, -push, 0, 0, 0};
    double away[NQ];
    cstk_witness_list list;
    bool found = false;
    int moved = step_by(at, down);
    check(cstk_gradients(at->query, at->hole, at->q, NQ, shell, 256, &list));
    check(cstk_spring_step(&list, NQ, desired, away, &found));
    if (found) {
        away[2] = 0; /* the spring centres; it does not lift */
        moved |= step_by(at, away);
    }
    return moved;
}

int main(int argc, char **argv) {
    insertion at = {NULL, NULL, {0.03, -0.04, 0.15, 0.012, -0.015, 0.008}, {0}, 0};
    FILE *svg = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (argc > 1 && svg == NULL) {
        fprintf(stderr, "cannot write %s\n", argv[1]);
        return 1;
    }
    cstk_space *space = make_peg();
    cstk_environment *hole = make_hole();
    check(cstk_query_create(&at.query));
    check(cstk_cobject_induced(space, NULL, 0, hole, NULL, 0, NULL, &at.hole));
    check(cstk_slide_options_default(&at.options, sizeof at.options));
    at.options.max_shell = shell;
    at.options.desired_distance = 0.0005;
    if (svg != NULL) {
        svg_begin(svg, 1000, 460);
    }
    printf("  round  depth, mm  aside, mm        tilt, mrad       clearance, mm\n");
    int round = 0, shot = 0, stuck = 0;
    const double shots[SHOTS] = {0.14, 0.0, -1.0, -depth + 0.55};
    for (; round < ROUNDS && at.q[2] > -depth + 0.5 && stuck < 20; ++round) {
        cstk_distance_result now;
        char title[64];
        check(cstk_distance(at.query, at.hole, at.q, NQ, INFINITY, &now));
        if (round % 50 == 0) {
            printf("%7d %9.3f  %7.4f %7.4f  %7.3f %7.3f  %9.5f\n", round, -10 * at.q[2], 10 * at.q[0], 10 * at.q[1],
                   1e3 * at.q[3], 1e3 * at.q[4], 10 * now.distance);
        }
        if (svg != NULL && shot < SHOTS && at.q[2] <= shots[shot]) {
            snprintf(title, sizeof title, "%+.1f mm deep, %.3f clear", -10 * at.q[2], 10 * now.distance);
            draw(svg, at.q, 130 + 246 * shot++, 250, title);
        }
        stuck = round_of(&at) ? 0 : stuck + 1;
    }
    if (svg != NULL) {
        svg_end(svg);
        fclose(svg);
    }
    cstk_class where;
    check(cstk_classify(at.query, at.hole, at.q, NQ, &where));
    printf("after %d rounds and %d steps, each proved free: %.2f mm deep, aside %.4f and %.4f mm, tilted %.3f and %.3f mrad\n",
           round, at.steps, -10 * at.q[2], 10 * at.q[0], 10 * at.q[1], 1e3 * at.q[3], 1e3 * at.q[4]);
    const int well = at.q[2] <= -depth + 0.5 && where != CSTK_CLASS_INSIDE && fabs(at.q[0]) <= clearance &&
                     fabs(at.q[1]) <= clearance;
    check(cstk_cobject_release(at.hole));
    check(cstk_environment_release(hole));
    check(cstk_space_release(space));
    check(cstk_query_release(at.query));
    return well ? 0 : 1;
}
