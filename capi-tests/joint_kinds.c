/* Joints of every kind: what a robot says of them, where they lead, and their Jacobians. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

enum { KINDS = CSTK_JOINT_CUSTOM + 1, NQ = 23, NV = 21 };

static const double offset_at[6] = {0.3, -0.2, 0.5, 0.4, -0.7, 1.1};

/* A chain with a joint of each kind, in the order of the kinds. */
static cstk_robot *make_chain(const cstk_body *body, double *pitch) {
    const cstk_custom_joint custom = screw(pitch);
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int32_t kind = 0; kind < KINDS; ++kind) {
        uint32_t number = CSTK_NONE;
        cstk_link_def def = link_of(kind);
        def.parent = kind - 1;
        def.body = kind % 2 == 0 ? body : NULL;
        def.name = kind == CSTK_JOINT_FREE ? "drone" : NULL;
        def.joint_name = kind == CSTK_JOINT_PLANAR ? "wheels" : NULL;
        def.custom = kind == CSTK_JOINT_CUSTOM ? &custom : NULL;
        def.axis[0] = 1.0;
        def.axis[1] = 2.0;
        def.axis[2] = 2.0;
        if (kind == CSTK_JOINT_REVOLUTE || kind == CSTK_JOINT_PRISMATIC) {
            def.multiplier = 2.0;
            def.offset = 0.1;
        }
        CHECK_OK(cstk_pose_from_euler(offset_at, def.at));
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, &number));
        CHECK(number == (uint32_t)kind);
    }
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    return robot;
}

static const double chain_q[NQ] = {
    0.4,                                /* revolute */
    0.7,                                /* prismatic */
    0.1, 0.2,  0.3,                     /* planar */
    0.5, -0.5, 0.5, 0.5,                /* spherical */
    1.0, 2.0,  3.0, 0.6, 0.0, 0.0, 0.8, /* free */
    0.1, 0.2,  0.3, 0.4, 0.5, 0.6,      /* free, Euler */
    0.9,                                /* custom */
};

static void infos(const cstk_robot *robot) {
    const uint32_t nq[KINDS] = {0, 1, 1, 3, 4, 7, 6, 1};
    const uint32_t nv[KINDS] = {0, 1, 1, 3, 3, 6, 6, 1};
    uint32_t coordinate = 0;
    uint32_t velocity = 0;
    double at[12];
    CHECK_OK(cstk_pose_from_euler(offset_at, at));
    for (uint32_t link = 0; link < KINDS; ++link) {
        cstk_link_info info;
        CHECK_OK(cstk_robot_get_link_info(robot, link, &info));
        CHECK(info.parent == (int32_t)link - 1 && info.joint == (cstk_joint_kind)link);
        CHECK(info.nq == nq[link] && info.nv == nv[link]);
        CHECK(info.nq == 0 || (info.coordinate == coordinate && info.velocity == velocity));
        CHECK(info.has_body == (link % 2 == 0));
        CHECK(near(info.at, at, 12, 1e-15));
        if (link == CSTK_JOINT_REVOLUTE || link == CSTK_JOINT_PRISMATIC) {
            const double axis[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
            CHECK(info.multiplier == 2.0 && info.offset == 0.1);
            CHECK(near(info.axis, axis, 3, 1e-15));
        }
        coordinate += info.nq;
        velocity += info.nv;
    }
    size_t size[3];
    CHECK_OK(cstk_robot_get_size(robot, &size[0], &size[1], &size[2]));
    CHECK(size[0] == NQ && size[1] == NV && size[2] == KINDS);
    CHECK(coordinate == NQ && velocity == NV);
}

static void names(const cstk_robot *robot) {
    char buffer[16];
    size_t length = 0;
    uint32_t link = CSTK_NONE;
    CHECK_OK(cstk_robot_get_link_name(robot, CSTK_JOINT_FREE, NULL, 0, &length));
    CHECK(length == 5);
    CHECK_OK(cstk_robot_get_link_name(robot, CSTK_JOINT_FREE, buffer, 6, &length));
    CHECK(length == 5 && strcmp(buffer, "drone") == 0);
    CHECK_OK(cstk_robot_get_joint_name(robot, CSTK_JOINT_FREE, buffer, sizeof buffer, &length));
    CHECK(length == 0 && buffer[0] == '\0');
    CHECK_OK(cstk_robot_get_link_name(robot, CSTK_JOINT_PLANAR, buffer, sizeof buffer, NULL));
    CHECK(strcmp(buffer, "link3") == 0);
    CHECK_OK(cstk_robot_get_joint_name(robot, CSTK_JOINT_PLANAR, buffer, sizeof buffer, NULL));
    CHECK(strcmp(buffer, "wheels") == 0);
    CHECK_OK(cstk_robot_find_joint(robot, "wheels", &link));
    CHECK(link == CSTK_JOINT_PLANAR);
    CHECK_OK(cstk_robot_find_link(robot, "drone", &link));
    CHECK(link == CSTK_JOINT_FREE);
}

/* The motion of each joint of the chain at chain_q, by the header's words. */
static void motion_of(int kind, double pitch, double pose[12]) {
    const double *q = chain_q;
    double placement[7] = {0};
    memcpy(pose, identity_pose, sizeof identity_pose);
    switch (kind) {
    case CSTK_JOINT_FIXED:
        break;
    case CSTK_JOINT_REVOLUTE: {
        const double half = 0.5 * (2.0 * q[0] + 0.1);
        placement[3] = sin(half) / 3;
        placement[4] = placement[5] = 2 * placement[3];
        placement[6] = cos(half);
        CHECK_OK(cstk_pose_from_quaternion(placement, pose));
        break;
    }
    case CSTK_JOINT_PRISMATIC: {
        const double shift = 2.0 * q[1] + 0.1;
        translation(shift / 3, 2 * shift / 3, 2 * shift / 3, pose);
        break;
    }
    case CSTK_JOINT_PLANAR:
        turned(q[4], q[2], q[3], 0.0, pose);
        break;
    case CSTK_JOINT_SPHERICAL:
        memcpy(placement + 3, q + 5, 4 * sizeof *q);
        CHECK_OK(cstk_pose_from_quaternion(placement, pose));
        break;
    case CSTK_JOINT_FREE:
        CHECK_OK(cstk_pose_from_quaternion(q + 9, pose));
        break;
    case CSTK_JOINT_FREE_EULER:
        CHECK_OK(cstk_pose_from_euler(q + 16, pose));
        break;
    default:
        turned(q[22], 0.0, 0.0, pitch * q[22], pose);
    }
}

static void poses(const cstk_robot *robot, const cstk_space *space, double pitch) {
    double all[12 * KINDS];
    double at[12];
    double expected[12];
    CHECK_OK(cstk_pose_from_euler(offset_at, at));
    CHECK_OK(cstk_space_link_poses(space, chain_q, NQ, all));
    memcpy(expected, identity_pose, sizeof expected);
    for (int link = 0; link < KINDS; ++link) {
        double motion[12];
        double pose[12];
        motion_of(link, pitch, motion);
        CHECK_OK(cstk_pose_compose(expected, at, expected));
        CHECK_OK(cstk_pose_compose(expected, motion, expected));
        CHECK_OK(cstk_robot_link_pose(robot, chain_q, NQ, (uint32_t)link, pose));
        CHECK(near(pose, expected, 12, 1e-13));
        CHECK(memcmp(pose, all + 12 * link, sizeof pose) == 0);
    }
}

/* Where velocity k, for a short time, takes a point of the last link; and how it turns the link. */
static void moved(const cstk_space *space, int k, double time, const double point[3],
                  double there[3], double pose[12]) {
    double v[NV] = {0};
    double q[NQ];
    double all[12 * KINDS];
    v[k] = time;
    CHECK_OK(cstk_space_step(space, chain_q, NQ, v, NV, q));
    CHECK_OK(cstk_space_link_poses(space, q, NQ, all));
    memcpy(pose, all + 12 * (KINDS - 1), 12 * sizeof *pose);
    CHECK_OK(cstk_pose_transform_point(pose, point, there));
}

/* The Jacobian is the derivative of the poses along the steps. */
static void jacobian(const cstk_robot *robot, const cstk_space *space) {
    const double point[3] = {0.2, -0.3, 0.4};
    const double time = 1e-5;
    double matrix[6 * NV];
    double same[6 * NV];
    CHECK_OK(cstk_space_jacobian(space, chain_q, NQ, KINDS - 1, point, matrix));
    CHECK_OK(cstk_robot_jacobian(robot, chain_q, NQ, KINDS - 1, point, same));
    CHECK(memcmp(matrix, same, sizeof matrix) == 0);
    for (int k = 0; k < NV; ++k) {
        double ahead[12];
        double behind[12];
        double turn[12];
        double p[3];
        double m[3];
        moved(space, k, time, point, p, ahead);
        moved(space, k, -time, point, m, behind);
        CHECK_OK(cstk_pose_inverse(behind, behind));
        CHECK_OK(cstk_pose_compose(ahead, behind, turn));
        const double measured[6] = {p[0] - m[0],       p[1] - m[1],       p[2] - m[2],
                                    turn[9] - turn[6], turn[2] - turn[8], turn[4] - turn[1]};
        for (int row = 0; row < 6; ++row) {
            const double rate = measured[row] / ((row < 3 ? 2 : 4) * time);
            CHECK(fabs(rate - matrix[row * NV + k]) < 1e-8);
        }
    }
}

static void every_kind(void) {
    double pitch = 0.25;
    cstk_body *body = make_box(0.1, 0.1, 0.1);
    cstk_robot *robot = make_chain(body, &pitch);
    cstk_space *space = space_of(robot, NULL, 0);
    infos(robot);
    names(robot);
    poses(robot, space, pitch);
    jacobian(robot, space);
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_body_release(body));
}

/* Two robots in one space: their numbers follow each other. */
static void offsets(void) {
    double pitch = 0.25;
    cstk_robot *chain = make_chain(NULL, &pitch);
    const cstk_link_def def = link_of(CSTK_JOINT_SPHERICAL);
    cstk_robot *ball = make_robot(&def);
    const cstk_robot *robots[2] = {chain, ball};
    cstk_space *space = NULL;
    cstk_space_offset offset;
    size_t size[3];
    double q[NQ + 4];
    CHECK_OK(cstk_space_create(robots, 2, NULL, 0, NULL, &space));
    CHECK_OK(cstk_space_get_size(space, &size[0], &size[1], &size[2]));
    CHECK(size[0] == NQ + 4 && size[1] == NV + 3 && size[2] == KINDS + 1);
    CHECK_OK(cstk_space_get_offset(space, 0, &offset));
    CHECK(offset.link == 0 && offset.coordinate == 0 && offset.velocity == 0);
    CHECK_OK(cstk_space_get_offset(space, 1, &offset));
    CHECK(offset.link == KINDS && offset.coordinate == NQ && offset.velocity == NV);
    CHECK_OK(cstk_space_get_neutral(space, q));
    for (int i = 0; i < NQ + 4; ++i) {
        CHECK(q[i] == (i == 8 || i == 15 || i == NQ + 3 ? 1.0 : 0.0));
    }
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(ball));
    CHECK_OK(cstk_robot_release(chain));
}

/* A gripper: the second finger mirrors the first. */
static void mimic(void) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    cstk_link_def def = link_of(CSTK_JOINT_PRISMATIC);
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    def.lower = 0.0;
    def.upper = 0.5;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.coordinate = 0;
    def.multiplier = -1.0;
    def.offset = 0.25;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    /* Carried by the first, it moves by the sum of both. */
    def.parent = 0;
    def.multiplier = 3.0;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    cstk_space *space = space_of(robot, NULL, 0);
    cstk_range range;
    cstk_link_info info;
    double all[12 * 3];
    const double q = 0.5;
    size_t nq = 0;
    CHECK_OK(cstk_robot_get_size(robot, &nq, NULL, NULL));
    CHECK_OK(cstk_robot_get_link_info(robot, 1, &info));
    CHECK(nq == 1 && info.coordinate == 0 && info.multiplier == -1.0 && info.offset == 0.25);
    CHECK_OK(cstk_space_get_range(space, 0, &range));
    CHECK(range.kind == CSTK_RANGE_INTERVAL && range.lower == 0.0 && range.upper == 0.5);
    CHECK_OK(cstk_space_link_poses(space, &q, 1, all));
    CHECK(all[11] == 0.5 && all[12 + 11] == -0.25 && all[24 + 11] == 2.25);
    for (uint32_t link = 0; link < 3; ++link) {
        const double rates[3] = {1.0, -1.0, 4.0};
        const double point[3] = {0, 0, 0};
        const double expected[6] = {0, 0, rates[link], 0, 0, 0};
        double matrix[6];
        CHECK_OK(cstk_space_jacobian(space, &q, 1, link, point, matrix));
        CHECK(near(matrix, expected, 6, 1e-15));
    }
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(builder));
}

int main(void) {
    every_kind();
    offsets();
    mimic();
    return check_result();
}
