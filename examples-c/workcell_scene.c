#include "workcell_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDES = 12 }; /* of what is round */
enum { X, Y, Z };

static const double pi = 3.14159265358979323846;

const char *const object_names[OBJECTS] = {"table", "fixture", "bin"};

/* What moves a link, and from where: the joint's place in the parent's frame, its axis and limit.
 */
typedef struct joint {
    const char *link, *name;
    double at[3];
    int axis;
    double limit; /* to both sides; radians */
} joint;

/* At coordinates 0 the upper arm is upright, and forearm and hand point along x. */
static const joint joints[LINKS] = {
    [BASE] = {"base", "mount", {0, 0, 0}, Z, 0},
    [SHOULDER] = {"shoulder", "waist joint", {0, 0, .20}, Z, 2.8},
    [UPPER_ARM] = {"upper arm", "shoulder joint", {0, .08, .22}, Y, 2.2},
    [FOREARM] = {"forearm", "elbow joint", {0, -.06, .45}, Y, 2.7},
    [WRIST] = {"wrist", "roll joint", {.30, 0, 0}, X, 3.1},
    [KNUCKLE] = {"knuckle", "wrist joint", {.14, 0, 0}, Y, 2.0},
    [HAND] = {"hand", "hand joint", {.09, 0, 0}, X, 3.1},
};

void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

static void add_box(cstk_body_builder *builder, double x, double y, double z, double length,
                    double width, double height) {
    double corners[8][3];
    for (int i = 0; i < 8; ++i) {
        corners[i][X] = x + (i & 1 ? 0.5 : -0.5) * length;
        corners[i][Y] = y + (i & 2 ? 0.5 : -0.5) * width;
        corners[i][Z] = z + (i & 4 ? 0.5 : -0.5) * height;
    }
    check(cstk_body_builder_add_polyhedron(builder, corners[0], 8, 0));
}

/* Around an axis through the frame's origin, from one place on it to another. */
static void add_cylinder(cstk_body_builder *builder, int axis, double radius, double from,
                         double to) {
    double corners[2 * SIDES][3];
    for (int i = 0; i < SIDES; ++i) {
        double angle = 2 * pi * (i + 0.5) / SIDES;
        double *ends[2] = {corners[i], corners[SIDES + i]};
        for (int end = 0; end < 2; ++end) {
            ends[end][axis] = end == 0 ? from : to;
            ends[end][(axis + 1) % 3] = radius * cos(angle);
            ends[end][(axis + 2) % 3] = radius * sin(angle);
        }
    }
    check(cstk_body_builder_add_polyhedron(builder, corners[0], 2 * SIDES, 0));
}

/* From one joint to the next: the hull of two cylinders about y, the second at (x, z). */
static void add_bar(cstk_body_builder *builder, double radius, double x, double z,
                    double radius_there, double from_y, double to_y) {
    double corners[4 * SIDES][3];
    for (int i = 0; i < SIDES; ++i) {
        double angle = 2 * pi * (i + 0.5) / SIDES;
        for (int k = 0; k < 4; ++k) {
            double *corner = corners[4 * i + k], r = k & 1 ? radius_there : radius;
            corner[X] = (k & 1 ? x : 0) + r * cos(angle);
            corner[Y] = k & 2 ? to_y : from_y;
            corner[Z] = (k & 1 ? z : 0) + r * sin(angle);
        }
    }
    check(cstk_body_builder_add_polyhedron(builder, corners[0], 4 * SIDES, 0));
}

static cstk_body_builder *begin_body(void) {
    cstk_body_builder *builder = NULL;
    check(cstk_body_builder_create(3, &builder));
    return builder;
}

static cstk_body *end_body(cstk_body_builder *builder) {
    cstk_body *body = NULL;
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

static cstk_body *make_link(int link) {
    cstk_body_builder *builder = begin_body();
    switch (link) {
    case BASE:
        add_cylinder(builder, Z, .13, 0, .04);
        add_cylinder(builder, Z, .09, .04, .19);
        break;
    case SHOULDER:
        add_cylinder(builder, Z, .07, 0, .22);
        break;
    case UPPER_ARM:
        add_cylinder(builder, Y, .09, -.16, 0);
        add_bar(builder, .09, 0, .45, .07, 0, .07);
        break;
    case FOREARM:
        add_bar(builder, .07, .30, 0, .045, -.045, .045);
        break;
    case WRIST:
        add_cylinder(builder, X, .035, 0, .11);
        break;
    case KNUCKLE:
        add_cylinder(builder, Y, .04, -.05, .05);
        add_cylinder(builder, X, .03, 0, .09);
        break;
    case HAND:
        add_box(builder, .025, 0, 0, .04, .14, .05);
        add_box(builder, .085, -.055, 0, .08, .02, .03);
        add_box(builder, .085, .055, 0, .08, .02, .03);
        break;
    }
    return end_body(builder);
}

/* Its top is the plane z = 0. */
static cstk_body *make_table(void) {
    cstk_body_builder *builder = begin_body();
    add_box(builder, 0, 0, -.02, 1.6, .9, .04);
    for (int i = 0; i < 4; ++i) {
        add_box(builder, i & 1 ? .74 : -.74, i & 2 ? .39 : -.39, -.24, .06, .06, .40);
    }
    return end_body(builder);
}

static cstk_body *make_fixture(void) {
    cstk_body_builder *builder = begin_body();
    add_box(builder, 0, 0, .03, .24, .20, .06);
    add_box(builder, -.08, 0, .12, .06, .16, .12);
    add_box(builder, .08, 0, .12, .06, .16, .12);
    return end_body(builder);
}

cstk_body *make_bin(void) {
    cstk_body_builder *builder = begin_body();
    add_box(builder, 0, 0, .01, .26, .20, .02);
    add_box(builder, -.12, 0, .08, .02, .20, .12);
    add_box(builder, .12, 0, .08, .02, .20, .12);
    add_box(builder, 0, -.09, .08, .22, .02, .12);
    add_box(builder, 0, .09, .08, .22, .02, .12);
    return end_body(builder);
}

/* An arm whose base stands at a pose; the names of its links and joints begin with its side. */
static cstk_robot *make_arm(const char *side, const double at[12]) {
    cstk_robot_builder *builder = NULL;
    check(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < LINKS; ++i) {
        const joint *j = &joints[i];
        char name[32], joint_name[32];
        snprintf(name, sizeof name, "%s %s", side, j->link);
        snprintf(joint_name, sizeof joint_name, "%s %s", side, j->name);
        cstk_body *body = make_link(i);
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        def.name = name;
        def.joint_name = joint_name;
        def.body = body;
        def.parent = i - 1;
        if (i == BASE) {
            memcpy(def.at, at, sizeof def.at);
        } else {
            def.joint = CSTK_JOINT_REVOLUTE;
            def.at[3] = j->at[X];
            def.at[7] = j->at[Y];
            def.at[11] = j->at[Z];
            memcpy(def.axis, (const double[3]){j->axis == X, j->axis == Y, j->axis == Z},
                   sizeof def.axis);
            def.lower = -j->limit;
            def.upper = j->limit;
        }
        check(cstk_robot_builder_add_link(builder, &def, NULL));
        check(cstk_body_release(body)); /* the robot keeps it */
    }
    cstk_robot *arm = NULL;
    check(cstk_robot_build(builder, &arm));
    check(cstk_robot_builder_release(builder));
    return arm;
}

/* Both at once: an environment's changes are applied together or, on failure, not at all. */
static void furnish(cell *c) {
    cstk_body *bodies[] = {make_table(), make_fixture()};
    cstk_environment_change changes[2];
    for (int i = 0; i < 2; ++i) {
        check(cstk_environment_change_default(&changes[i], sizeof changes[i]));
        changes[i].body = bodies[i];
    }
    check(cstk_environment_create(&c->environment));
    check(cstk_environment_apply(c->environment, changes, 2, c->ids, NULL));
    for (int i = 0; i < 2; ++i) {
        check(cstk_body_release(bodies[i])); /* the environment keeps it */
    }
}

cell make_cell(void) {
    cell c = {.ids = {0}};
    const double left[12] = {1, 0, 0, -.6, 0, 1, 0, 0, 0, 0, 1, 0};
    const double right[12] = {-1, 0, 0, .6, 0, -1, 0, 0, 0, 0, 1, 0}; /* half a turn about z */
    c.arms[LEFT] = make_arm("left", left);
    c.arms[RIGHT] = make_arm("right", right);
    check(cstk_space_create((const cstk_robot *const *)c.arms, ARMS, NULL, 0, NULL, &c.space));
    for (int i = 0; i < ARMS; ++i) {
        check(cstk_space_get_offset(c.space, (size_t)i, &c.first[i]));
    }
    furnish(&c);
    return c;
}

int arm_of(const cell *c, uint32_t link) { return link < c->first[RIGHT].link ? LEFT : RIGHT; }

void release_cell(cell *c) {
    check(cstk_environment_release(c->environment));
    check(cstk_space_release(c->space));
    for (int i = 0; i < ARMS; ++i) {
        check(cstk_robot_release(c->arms[i]));
    }
}
