#include "puma_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

static cstk_body *load_body(const char *folder, const char *file) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    check(cstk_body_builder_create(3, &builder));
    check(cstk_body_builder_add_mesh_file(builder, path, NULL, NULL));
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

/* A box of these full side lengths around the origin. */
static cstk_body *box_body(double x, double y, double z) {
    double corners[24];
    for (int i = 0; i < 8; ++i) {
        corners[3 * i] = (i & 1 ? 0.5 : -0.5) * x;
        corners[3 * i + 1] = (i & 2 ? 0.5 : -0.5) * y;
        corners[3 * i + 2] = (i & 4 ? 0.5 : -0.5) * z;
    }
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    check(cstk_body_builder_create(3, &builder));
    check(cstk_body_builder_add_polyhedron(builder, corners, 8, 0));
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

/* Adds a link by its name, parent, joint and placement (x, y, z, yaw, pitch, roll); releases the body. */
static uint32_t add_link(cstk_robot_builder *builder, const char *name, cstk_body *body,
                         int32_t parent, int32_t joint, const double at[6]) {
    cstk_link_def def;
    uint32_t link = 0;
    check(cstk_link_def_default(&def, sizeof def));
    def.name = name;
    def.body = body;
    def.parent = parent;
    def.joint = joint;
    check(cstk_pose_from_euler(at, def.at));
    check(cstk_robot_builder_add_link(builder, &def, &link));
    check(cstk_body_release(body));
    return link;
}

/* Adds a body to the environment at a placement; releases the body. */
static void add_object(cstk_environment *environment, cstk_body *body, const double at[6]) {
    cstk_environment_change change;
    check(cstk_environment_change_default(&change, sizeof change));
    change.body = body;
    check(cstk_pose_from_euler(at, change.pose));
    check(cstk_environment_apply(environment, &change, 1, NULL, NULL));
    check(cstk_body_release(body));
}

/* The union of one induced C-object for each of the links. */
static cstk_cobject *union_over_links(const scene *s, const uint32_t *links, size_t count) {
    cstk_cobject *parts[8];
    cstk_cobject *all = NULL;
    cstk_induced_options options;
    check(cstk_induced_options_default(&options, sizeof options));
    options.contact_epsilon = s->max_shell;
    for (size_t i = 0; i < count; ++i) {
        check(cstk_cobject_induced(s->space, &links[i], 1, s->environment, NULL, 0, &options,
                                   &parts[i]));
    }
    check(cstk_cobject_union((const cstk_cobject *const *)parts, count, &all));
    for (size_t i = 0; i < count; ++i) {
        check(cstk_cobject_release(parts[i]));
    }
    return all;
}

/* Builds robot and space; releases the builder. */
static void finish_robot(scene *s, cstk_robot_builder *builder, const cstk_range *ranges,
                         size_t range_count, const double *world) {
    check(cstk_robot_build(builder, &s->robot));
    check(cstk_robot_builder_release(builder));
    const cstk_robot *robots[] = {s->robot};
    check(cstk_space_create(robots, 1, ranges, range_count, world, &s->space));
    check(cstk_space_get_size(s->space, &s->nq, NULL, NULL));
}

scene appendix_scene(const char *models) {
    scene s = {.name = "appendix",
               .start = {.17, 0, 0},
               .step = {.01, 0, 0},
               .steps = 60,
               .max_shell = 0.5,
               .desired_distance = 0.05};
    /* The report's :at lists; the third one has a zero too many there. */
    const double at[3][6] = {
        {0, 0, 0, 0, 0, 0}, {0, 2.875, 0, 0, 0, PI / 2}, {6.5, 0, -2.125, 0, 0, 0}};
    cstk_robot_builder *builder = NULL;
    check(cstk_robot_builder_create(3, &builder));
    add_link(builder, "shoulder", load_body(models, "puma_shoulder.obj"), -1, CSTK_JOINT_REVOLUTE,
             at[0]);
    add_link(builder, "upper arm", load_body(models, "puma_upper_arm.obj"), 0, CSTK_JOINT_REVOLUTE,
             at[1]);
    add_link(builder, "forearm", load_body(models, "puma_forearm.obj"), 1, CSTK_JOINT_REVOLUTE,
             at[2]);
    const double world[6] = {-20, -20, -20, 20, 20, 20};
    finish_robot(&s, builder, NULL, 0, world);

    check(cstk_environment_create(&s.environment));
    /* Tilted by 35 degrees or more from every axis, across the way of the forearm. */
    const double cylinder[6] = {9.27, 10.06, -2.44, 1.11, 0.88, -0.8};
    add_object(s.environment, load_body(models, "cylinder.obj"), cylinder);
    const uint32_t links[] = {0, 1, 2};
    s.cobject = union_over_links(&s, links, 3);
    return s;
}

scene puma560_scene(const char *meshes) {
    scene s = {.name = "puma560",
               .start = {-0.6, 0.6, -1.8, 0, 0.2, 0},
               .step = {.02, 0, 0, 0, 0, 0},
               .steps = 60,
               .max_shell = 0.05,
               .desired_distance = 0.01};
    /* Standard Denavit-Hartenberg parameters (Corke and Armstrong-Helouvry 1994); metres and radians. Link i's mesh is
     * in frame i, so each link is a joint followed by a fixed frame. */
    const double d[6] = {0.67183, 0, 0.15005, 0.4318, 0, 0};
    const double a[6] = {0, 0.4318, 0.0203, 0, 0, 0};
    const double alpha[6] = {PI / 2, 0, -PI / 2, PI / 2, -PI / 2, 0};
    const double limit[6] = {160, 110, 135, 266, 100, 266};
    const double here[6] = {0};
    cstk_range ranges[6];
    uint32_t links[6];
    cstk_robot_builder *builder = NULL;
    check(cstk_robot_builder_create(3, &builder));
    uint32_t parent =
        add_link(builder, "base", load_body(meshes, "link0.stl"), -1, CSTK_JOINT_FIXED, here);
    for (int i = 0; i < 6; ++i) {
        char name[16], file[16];
        snprintf(name, sizeof name, "joint%d", i + 1);
        parent = add_link(builder, name, NULL, (int32_t)parent, CSTK_JOINT_REVOLUTE, here);
        snprintf(name, sizeof name, "link%d", i + 1);
        snprintf(file, sizeof file, "link%d.stl", i + 1);
        const double at[6] = {a[i], 0, d[i], 0, 0, alpha[i]};
        parent =
            add_link(builder, name, load_body(meshes, file), (int32_t)parent, CSTK_JOINT_FIXED, at);
        links[i] = parent;
        memset(&ranges[i], 0, sizeof ranges[i]);
        ranges[i].kind = CSTK_RANGE_INTERVAL;
        ranges[i].lower = -limit[i] * PI / 180;
        ranges[i].upper = limit[i] * PI / 180;
    }
    finish_robot(&s, builder, ranges, 6, NULL);

    check(cstk_environment_create(&s.environment));
    const double table[6] = {0.75, 0, 0.3, 0, 0, 0};
    const double post[6] = {0.66, 0.08, 0.94, -0.8, -0.14, 0.91};
    const double crate[6] = {0.9, -0.35, 0.42, 0, 0, 0};
    const double shelf[6] = {-0.6, 0.7, 1.1, 0, 0, 0};
    add_object(s.environment, box_body(0.9, 1.4, 0.04), table);
    add_object(s.environment, box_body(0.1, 0.1, 0.9), post);
    add_object(s.environment, box_body(0.2, 0.2, 0.2), crate);
    add_object(s.environment, box_body(0.8, 0.3, 0.03), shelf);
    s.cobject = union_over_links(&s, links, 6);
    return s;
}

void release_scene(scene *s) {
    check(cstk_cobject_release(s->cobject));
    check(cstk_environment_release(s->environment));
    check(cstk_space_release(s->space));
    check(cstk_robot_release(s->robot));
}
