#include "wrist.h"

#include <math.h>

#include "check.h"

static int32_t wrist_pose(const double *q, size_t n, double *pose, void *user) {
    wrist *w = user;
    CHECK(n == 1 && isfinite(q[0]));
    if (w->call != NULL) {
        w->call(w);
    }
    const double right[12] = {cos(q[0]), -sin(q[0]), 0, 0, sin(q[0]), cos(q[0]), 0, 0, 0, 0, 1, 0};
    if (!w->leaves_unwritten) {
        memcpy(pose, w->pose != NULL ? w->pose : right, sizeof right);
    }
    return w->pose_status;
}

static int32_t wrist_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    const wrist *w = user;
    CHECK(n == 1 && isfinite(q[0]));
    const double right[6] = {0, 0, 0, 0, 0, 1};
    if (!w->leaves_unwritten) {
        memcpy(jacobian, w->jacobian != NULL ? w->jacobian : right, sizeof right);
    }
    return w->jacobian_status;
}

static void wrist_destroy(void *user) { ++((wrist *)user)->destroyed; }

cstk_custom_joint good_joint(wrist *w) {
    cstk_custom_joint joint;
    CHECK_OK(cstk_custom_joint_default(&joint, sizeof joint));
    joint.pose = wrist_pose;
    joint.jacobian = wrist_jacobian;
    joint.user = w;
    joint.destroy = wrist_destroy;
    joint.linear_speed = 0.0;
    joint.angular_speed = 1.0;
    return joint;
}

cstk_link_def wrist_link(const cstk_custom_joint *joint, const cstk_body *body) {
    cstk_link_def def;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.name = "wrist";
    def.body = body;
    def.joint = CSTK_JOINT_CUSTOM;
    def.custom = joint;
    return def;
}

void scene_create(const fixture *f, const cstk_custom_joint *joint, scene *s) {
    cstk_link_def def;
    cstk_induced_options options;
    memset(s, 0, sizeof *s);
    CHECK_OK(cstk_robot_builder_create(3, &s->builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    CHECK_OK(cstk_robot_builder_add_link(s->builder, &def, NULL));
    def = wrist_link(joint, f->body);
    def.parent = BASE;
    translation(2.0, 0.0, 0.0, def.at);
    CHECK_OK(cstk_robot_builder_add_link(s->builder, &def, NULL));
    CHECK_OK(cstk_robot_build(s->builder, &s->robot));
    const cstk_robot *robot = s->robot;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, NULL, &s->space));
    /* Pictures show gradients of the contacts within the epsilon. */
    CHECK_OK(cstk_induced_options_default(&options, sizeof options));
    options.contact_epsilon = 10.0;
    CHECK_OK(
        cstk_cobject_induced(s->space, NULL, 0, f->environment, NULL, 0, &options, &s->cobject));
    CHECK_OK(cstk_query_create(&s->query));
    s->q[0] = 0.1;
}

void scene_release(const scene *s) {
    CHECK_OK(cstk_query_release(s->query));
    CHECK_OK(cstk_cobject_release(s->cobject));
    CHECK_OK(cstk_space_release(s->space));
    CHECK_OK(cstk_robot_release(s->robot));
    CHECK_OK(cstk_robot_builder_release(s->builder));
}
