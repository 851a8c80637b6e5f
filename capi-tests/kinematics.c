/* Joints of every kind, steps and ranges of configurations, and steps along contacts. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static const double half_turn = 3.14159265358979323846;

static bool near(const double *a, const double *b, size_t count, double tolerance) {
    for (size_t i = 0; i < count; ++i) {
        if (!(fabs(a[i] - b[i]) <= tolerance)) {
            return false;
        }
    }
    return true;
}

static double length_of(const double *v, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
        sum += v[i] * v[i];
    }
    return sqrt(sum);
}

/* A pose turned about z by an angle, and shifted. */
static void turned(double angle, double x, double y, double z, double pose[12]) {
    translation(x, y, z, pose);
    pose[0] = pose[5] = cos(angle);
    pose[4] = sin(angle);
    pose[1] = -pose[4];
}

/* A joint of the caller's: by one coordinate a screw about z, whose pitch is its user data. */
static int32_t screw_pose(const double *q, size_t n, double *pose, void *user) {
    CHECK(n == 1);
    turned(q[0], 0.0, 0.0, *(const double *)user * q[0], pose);
    return CSTK_OK;
}

static int32_t screw_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    (void)q;
    CHECK(n == 1);
    memset(jacobian, 0, 6 * sizeof *jacobian);
    jacobian[2] = *(const double *)user;
    jacobian[5] = 1.0;
    return CSTK_OK;
}

static cstk_custom_joint screw(double *pitch) {
    cstk_custom_joint joint;
    CHECK_OK(cstk_custom_joint_default(&joint, sizeof joint));
    CHECK(joint.coordinates == 1 && joint.destroy == NULL && joint.linear_speed < 0.0);
    joint.pose = screw_pose;
    joint.jacobian = screw_jacobian;
    joint.user = pitch;
    joint.linear_speed = fabs(*pitch);
    joint.angular_speed = 1.0;
    return joint;
}

/* A joint of the caller's that moves as CSTK_JOINT_PLANAR does. */
static int32_t plane_pose(const double *q, size_t n, double *pose, void *user) {
    (void)user;
    CHECK(n == 3);
    turned(q[2], q[0], q[1], 0.0, pose);
    return CSTK_OK;
}

static int32_t plane_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    (void)q, (void)user;
    CHECK(n == 3);
    memset(jacobian, 0, 18 * sizeof *jacobian);
    jacobian[0] = jacobian[4] = jacobian[17] = 1.0;
    return CSTK_OK;
}

static cstk_custom_joint plane(void) {
    cstk_custom_joint joint;
    CHECK_OK(cstk_custom_joint_default(&joint, sizeof joint));
    joint.coordinates = 3;
    joint.pose = plane_pose;
    joint.jacobian = plane_jacobian;
    joint.linear_speed = 1.0;
    joint.angular_speed = 1.0;
    return joint;
}

/* A robot of one link. */
static cstk_robot *make_robot(const cstk_link_def *def) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    return robot;
}

static cstk_space *space_of(const cstk_robot *robot, const cstk_range *ranges, size_t count) {
    cstk_space *space = NULL;
    CHECK_OK(cstk_space_create(&robot, 1, ranges, count, NULL, &space));
    return space;
}

static cstk_link_def link_of(int32_t joint) {
    cstk_link_def def;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = joint;
    return def;
}

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
        CHECK_OK(cstk_robot_link_info(robot, link, &info));
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
    CHECK_OK(cstk_robot_size(robot, &size[0], &size[1], &size[2]));
    CHECK(size[0] == NQ && size[1] == NV && size[2] == KINDS);
    CHECK(coordinate == NQ && velocity == NV);
}

static void names(const cstk_robot *robot) {
    char buffer[16];
    size_t length = 0;
    uint32_t link = CSTK_NONE;
    CHECK_OK(cstk_robot_link_name(robot, CSTK_JOINT_FREE, NULL, 0, &length));
    CHECK(length == 5);
    CHECK_OK(cstk_robot_link_name(robot, CSTK_JOINT_FREE, buffer, 6, &length));
    CHECK(length == 5 && strcmp(buffer, "drone") == 0);
    CHECK_OK(cstk_robot_joint_name(robot, CSTK_JOINT_FREE, buffer, sizeof buffer, &length));
    CHECK(length == 0 && buffer[0] == '\0');
    CHECK_OK(cstk_robot_link_name(robot, CSTK_JOINT_PLANAR, buffer, sizeof buffer, NULL));
    CHECK(strcmp(buffer, "link3") == 0);
    CHECK_OK(cstk_robot_joint_name(robot, CSTK_JOINT_PLANAR, buffer, sizeof buffer, NULL));
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
    CHECK_OK(cstk_space_size(space, &size[0], &size[1], &size[2]));
    CHECK(size[0] == NQ + 4 && size[1] == NV + 3 && size[2] == KINDS + 1);
    CHECK_OK(cstk_space_get_offset(space, 0, &offset));
    CHECK(offset.link == 0 && offset.coordinate == 0 && offset.velocity == 0);
    CHECK_OK(cstk_space_get_offset(space, 1, &offset));
    CHECK(offset.link == KINDS && offset.coordinate == NQ && offset.velocity == NV);
    CHECK_OK(cstk_space_neutral(space, q));
    for (int i = 0; i < NQ + 4; ++i) {
        CHECK(q[i] == (i == 8 || i == 15 || i == NQ + 3 ? 1.0 : 0.0));
    }
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(ball));
    CHECK_OK(cstk_robot_release(chain));
}

enum { FREE_NQ = 7, FREE_NV = 6 };

static const double weights[FREE_NV] = {1, 2, 3, 4, 5, 6};

/* Back and forth between two configurations of a free joint. */
static void round_trip(const cstk_space *space, const double *q0, const double *q1) {
    double v[FREE_NV];
    double back[FREE_NV];
    double q[FREE_NQ];
    double distance = 0;
    CHECK_OK(cstk_space_difference(space, q0, q1, FREE_NQ, v));
    CHECK(length_of(v + 3, 3) <= half_turn + 1e-12);
    CHECK_OK(cstk_space_step(space, q0, FREE_NQ, v, FREE_NV, q));
    CHECK_OK(cstk_space_distance(space, q, q1, FREE_NQ, NULL, &distance));
    CHECK(distance < 1e-13);
    CHECK_OK(cstk_space_distance(space, q0, q1, FREE_NQ, NULL, &distance));
    CHECK(fabs(distance - length_of(v, FREE_NV)) < 1e-13);
    CHECK_OK(cstk_space_distance(space, q0, q1, FREE_NQ, weights, &distance));
    for (int i = 0; i < FREE_NV; ++i) {
        back[i] = v[i] * weights[i];
    }
    CHECK(fabs(distance - length_of(back, FREE_NV)) < 1e-13);
    CHECK_OK(cstk_space_difference(space, q1, q0, FREE_NQ, back));
    for (int i = 0; i < FREE_NV; ++i) {
        CHECK(fabs(back[i] + v[i]) < 1e-12);
    }
    /* Two halves of the way make the whole; outputs may be inputs. */
    CHECK_OK(cstk_space_interpolate(space, q0, q1, FREE_NQ, 0.5, q));
    for (int i = 0; i < FREE_NV; ++i) {
        back[i] = 0.5 * v[i];
    }
    CHECK_OK(cstk_space_step(space, q, FREE_NQ, back, FREE_NV, q));
    CHECK_OK(cstk_space_distance(space, q, q1, FREE_NQ, NULL, &distance));
    CHECK(distance < 1e-13);
    memcpy(q, q0, sizeof q);
    CHECK_OK(cstk_space_interpolate(space, q, q1, FREE_NQ, 1.0, q));
    CHECK_OK(cstk_space_distance(space, q, q1, FREE_NQ, NULL, &distance));
    CHECK(distance < 1e-13);
    memcpy(q, q1, sizeof q);
    CHECK_OK(cstk_space_interpolate(space, q0, q, FREE_NQ, 0.0, q));
    CHECK_OK(cstk_space_distance(space, q, q0, FREE_NQ, NULL, &distance));
    CHECK(distance < 1e-13);
}

static cstk_space *make_free_space(double reach) {
    cstk_range ranges[FREE_NQ];
    const cstk_link_def def = link_of(CSTK_JOINT_FREE);
    cstk_robot *robot = make_robot(&def);
    for (int i = 0; i < FREE_NQ; ++i) {
        ranges[i] =
            (cstk_range){i < 3 ? CSTK_RANGE_INTERVAL : CSTK_RANGE_DEFAULT, 0, -reach, reach};
    }
    cstk_space *space = space_of(robot, ranges, FREE_NQ);
    CHECK_OK(cstk_robot_release(robot));
    return space;
}

static void free_joint(void) {
    cstk_space *space = make_free_space(2.0);
    uint64_t state = 1;
    double q0[FREE_NQ];
    double q1[FREE_NQ];
    for (int i = 0; i < 200; ++i) {
        CHECK_OK(cstk_space_sample(space, &state, q0));
        CHECK_OK(cstk_space_sample(space, &state, q1));
        round_trip(space, q0, q1);
        round_trip(space, q0, q0);
        /* The two quaternions of a rotation are one configuration. */
        double other[FREE_NQ];
        double distance = 1;
        for (int k = 0; k < FREE_NQ; ++k) {
            other[k] = k < 3 ? q0[k] : -q0[k];
        }
        CHECK_OK(cstk_space_distance(space, q0, other, FREE_NQ, NULL, &distance));
        CHECK(distance < 1e-13);
    }
    /* A screw: a quarter turn about z while going forward leads round a quarter of a circle. */
    const double start[FREE_NQ] = {0, 0, 0, 0, 0, 0, 1};
    const double v[FREE_NV] = {0.5 * half_turn, 0, 0, 0, 0, 0.5 * half_turn};
    const double end[FREE_NQ] = {1, 1, 0, 0, 0, sqrt(0.5), sqrt(0.5)};
    CHECK_OK(cstk_space_step(space, start, FREE_NQ, v, FREE_NV, q0));
    CHECK(near(q0, end, FREE_NQ, 1e-15));
    CHECK_OK(cstk_space_release(space));
}

/* The space of three links: on a circle, on the line with limits, and on the line without. */
static cstk_space *make_mixed_space(void) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    const double world[6] = {-2, -2, -2, 2, 2, 2};
    cstk_space *space = NULL;
    cstk_link_def def = link_of(CSTK_JOINT_REVOLUTE);
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.lower = -0.5;
    def.upper = 0.3;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def = link_of(CSTK_JOINT_PRISMATIC);
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    const cstk_robot *robots[1] = {robot};
    CHECK_OK(cstk_space_create(robots, 1, NULL, 0, world, &space));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    return space;
}

static void ranges(const cstk_space *space) {
    cstk_range range;
    CHECK_OK(cstk_space_get_range(space, 0, &range));
    CHECK(range.kind == CSTK_RANGE_CIRCLE);
    CHECK_OK(cstk_space_get_range(space, 1, &range));
    CHECK(range.kind == CSTK_RANGE_INTERVAL && range.lower == -0.5 && range.upper == 0.3);
    CHECK_OK(cstk_space_get_range(space, 2, &range));
    CHECK(range.kind == CSTK_RANGE_INTERVAL);
    CHECK(range.lower == -INFINITY && range.upper == INFINITY);
    cstk_space *free_space = make_free_space(2.0);
    CHECK_OK(cstk_space_get_range(free_space, 6, &range));
    CHECK(range.kind == CSTK_RANGE_QUATERNION);
    CHECK_OK(cstk_space_release(free_space));
}

static void limits(const cstk_space *space) {
    const double inside[3] = {9.0, 0.3, 1.0};
    const double beyond[3] = {9.0, 0.31, 3.0};
    bool holds = false;
    uint32_t which = 0;
    CHECK_OK(cstk_space_within_limits(space, inside, 3, &holds, &which));
    CHECK(holds && which == CSTK_NONE);
    CHECK_OK(cstk_space_within_world(space, inside, 3, &holds, &which));
    CHECK(holds && which == CSTK_NONE);
    CHECK_OK(cstk_space_contains(space, inside, 3, &holds));
    CHECK(holds);
    CHECK_OK(cstk_space_within_limits(space, beyond, 3, &holds, &which));
    CHECK(!holds && which == 1);
    CHECK_OK(cstk_space_within_world(space, beyond, 3, &holds, &which));
    CHECK(!holds && which == 2);
    CHECK_OK(cstk_space_within_limits(space, beyond, 3, &holds, NULL));
    CHECK_OK(cstk_space_within_world(space, beyond, 3, &holds, NULL));
    CHECK(!holds);
}

static void clamp_and_wrap(const cstk_space *space) {
    double q[3] = {-1.0, 0.9, 7.0};
    const double clamped[3] = {-1.0, 0.3, 7.0};
    const double wrapped[3] = {2 * half_turn - 1.0, 0.3, 7.0};
    CHECK_OK(cstk_space_clamp(space, q, 3, q));
    CHECK(memcmp(q, clamped, sizeof q) == 0);
    CHECK_OK(cstk_space_wrap(space, q, 3, q));
    CHECK(near(q, wrapped, 3, 1e-15));
    /* A whole turn is none, and so is an angle that rounds to one. */
    const double angles[] = {2 * half_turn, -1e-300, -0.0, 0.0};
    for (int i = 0; i < 4; ++i) {
        q[0] = angles[i];
        CHECK_OK(cstk_space_wrap(space, q, 3, q));
        CHECK(q[0] == 0.0);
    }
    cstk_space *free_space = make_free_space(2.0);
    const double given[FREE_NQ] = {3, -1, -9, -0.6 * (1 + 5e-7), 0, 0, -0.8 * (1 + 5e-7)};
    const double near_by[FREE_NQ] = {2, -1, -2, -0.6, 0, 0, -0.8};
    const double turned_round[FREE_NQ] = {3, -1, -9, 0.6, 0, 0, 0.8};
    double p[FREE_NQ];
    CHECK_OK(cstk_space_clamp(free_space, given, FREE_NQ, p));
    CHECK(near(p, near_by, FREE_NQ, 1e-15));
    CHECK_OK(cstk_space_wrap(free_space, given, FREE_NQ, p));
    CHECK(near(p, turned_round, FREE_NQ, 1e-15));
    CHECK_OK(cstk_space_release(free_space));
}

static void circles(const cstk_space *space) {
    const double q0[3] = {0.1, 0.0, 0.0};
    const double q1[3] = {6.2, 0.25, -4.0};
    const double v[3] = {6.1 - 2 * half_turn, 0.25, -4.0};
    const double opposite[3] = {0.1 + half_turn, 0.0, 0.0};
    double found[3];
    CHECK_OK(cstk_space_difference(space, q0, q1, 3, found));
    CHECK(near(found, v, 3, 1e-14));
    CHECK_OK(cstk_space_difference(space, opposite, q0, 3, found));
    CHECK(fabs(found[0] + half_turn) < 1e-15);
    /* Steps do not wrap. */
    CHECK_OK(cstk_space_step(space, q0, 3, v, 3, found));
    CHECK(found[0] < 0.0);
}

/* Between configurations within the limits, the way and its ends are within them too. */
static void ways_keep_limits(const cstk_space *space) {
    for (int i = 0; i <= 80; ++i) {
        const double q0[3] = {0.0, -0.5 + 0.01 * i, 0.0};
        const double ends[2] = {-0.5, 0.3};
        for (int k = 0; k < 2; ++k) {
            const double q1[3] = {1.0, ends[k], 1.0};
            double q[3];
            bool holds = false;
            CHECK_OK(cstk_space_interpolate(space, q0, q1, 3, 1.0, q));
            CHECK_OK(cstk_space_within_limits(space, q, 3, &holds, NULL));
            if (!holds) {
                fprintf(stderr, "from %.17g to %.17g the way ends at %.17g\n", q0[1], q1[1], q[1]);
                ++check_failures;
            }
        }
    }
}

static void topology(void) {
    cstk_space *space = make_mixed_space();
    ranges(space);
    limits(space);
    clamp_and_wrap(space);
    circles(space);
    ways_keep_limits(space);
    CHECK_OK(cstk_space_release(space));
}

static void sampling(void) {
    cstk_space *space = make_free_space(2.0);
    uint64_t state = 42;
    uint64_t same = 42;
    double squares[4] = {0};
    const int count = 4000;
    for (int i = 0; i < count; ++i) {
        double q[FREE_NQ];
        double again[FREE_NQ];
        bool holds = false;
        CHECK_OK(cstk_space_sample(space, &state, q));
        CHECK_OK(cstk_space_sample(space, &same, again));
        CHECK(state == same && memcmp(q, again, sizeof q) == 0);
        CHECK_OK(cstk_space_within_limits(space, q, FREE_NQ, &holds, NULL));
        CHECK(holds && fabs(length_of(q + 3, 4) - 1.0) < 1e-15);
        for (int k = 0; k < 4; ++k) {
            squares[k] += q[3 + k] * q[3 + k];
        }
    }
    for (int k = 0; k < 4; ++k) {
        CHECK(fabs(squares[k] / count - 0.25) < 0.02);
    }
    CHECK_OK(cstk_space_release(space));
    /* SplitMix64 from state 0 begins with 0xE220A8397B1DCDAF, on every machine. */
    const cstk_link_def def = link_of(CSTK_JOINT_PRISMATIC);
    const cstk_range unit = {CSTK_RANGE_INTERVAL, 0, 0, 1};
    cstk_robot *robot = make_robot(&def);
    double q = 0;
    space = space_of(robot, &unit, 1);
    state = 0;
    CHECK_OK(cstk_space_sample(space, &state, &q));
    CHECK(q == (double)(0xE220A8397B1DCDAFu >> 11) / 9007199254740992.0);
    CHECK(state == 0x9E3779B97F4A7C15u);
    CHECK_OK(cstk_space_release(space));
    space = space_of(robot, NULL, 0);
    CHECK_STATUS(cstk_space_sample(space, &state, &q), CSTK_UNSUPPORTED);
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
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
    CHECK_OK(cstk_robot_size(robot, &nq, NULL, NULL));
    CHECK_OK(cstk_robot_link_info(robot, 1, &info));
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

enum { ARM_LINKS = 3 };

/* An arm of links of one kind in front of a box. */
typedef struct arm {
    cstk_robot *robot;
    cstk_space *space;
    cstk_cobject *cobject;
    cstk_query *query;
    size_t n;
} arm;

static arm make_posed_arm(int32_t kind, const cstk_custom_joint *custom, const cstk_body *body,
                          const cstk_environment *environment) {
    arm a;
    cstk_robot_builder *builder = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < ARM_LINKS; ++i) {
        const double at[6] = {1.0, 0.1 * i, 0, 0.3 * i, 0.2, 0.1};
        cstk_link_def def = link_of(custom != NULL ? CSTK_JOINT_CUSTOM : kind);
        def.custom = custom;
        def.body = body;
        def.parent = i - 1;
        CHECK_OK(cstk_pose_from_euler(at, def.at));
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    CHECK_OK(cstk_robot_build(builder, &a.robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    CHECK_OK(cstk_robot_size(a.robot, &a.n, NULL, NULL));
    a.space = space_of(a.robot, NULL, 0);
    CHECK_OK(cstk_cobject_induced(a.space, NULL, 0, environment, NULL, 0, NULL, &a.cobject));
    CHECK_OK(cstk_query_create(&a.query));
    return a;
}

static void arm_release(const arm *a) {
    CHECK_OK(cstk_query_release(a->query));
    CHECK_OK(cstk_cobject_release(a->cobject));
    CHECK_OK(cstk_space_release(a->space));
    CHECK_OK(cstk_robot_release(a->robot));
}

static void same_kinematics(const arm *a, const arm *b, const double *q) {
    double poses_a[12 * ARM_LINKS];
    double poses_b[12 * ARM_LINKS];
    double matrix_a[6 * 9];
    double matrix_b[6 * 9];
    const double point[3] = {0.1, 0.2, 0.3};
    CHECK_OK(cstk_space_link_poses(a->space, q, a->n, poses_a));
    CHECK_OK(cstk_space_link_poses(b->space, q, a->n, poses_b));
    CHECK(near(poses_a, poses_b, 12 * ARM_LINKS, 1e-14));
    for (uint32_t link = 0; link < ARM_LINKS; ++link) {
        CHECK_OK(cstk_space_jacobian(a->space, q, a->n, link, point, matrix_a));
        CHECK_OK(cstk_space_jacobian(b->space, q, a->n, link, point, matrix_b));
        CHECK(near(matrix_a, matrix_b, 6 * a->n, 1e-14));
    }
}

static void same_answers(const arm *a, const arm *b, const double *q) {
    cstk_witness_list list_a;
    cstk_witness_list list_b;
    CHECK_OK(cstk_gradients(a->query, a->cobject, q, a->n, 10.0, 16, &list_a));
    CHECK_OK(cstk_gradients(b->query, b->cobject, q, a->n, 10.0, 16, &list_b));
    CHECK(list_a.contact_count >= ARM_LINKS && list_a.contact_count == list_b.contact_count);
    CHECK(list_a.nv == a->n && list_b.nv == a->n);
    CHECK(near(list_a.gradients, list_b.gradients, list_a.contact_count * a->n, 1e-12));
    double step[9];
    double reached_a[9];
    double reached_b[9];
    cstk_slide_result result_a;
    cstk_slide_result result_b;
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = 0.5;
    /* Towards the box. */
    for (size_t i = 0; i < a->n; ++i) {
        step[i] = -0.02 * list_a.gradients[i];
    }
    CHECK_OK(cstk_slide(a->query, a->cobject, q, a->n, step, a->n, &options, reached_a, &result_a));
    CHECK_OK(cstk_slide(b->query, b->cobject, q, a->n, step, a->n, &options, reached_b, &result_b));
    CHECK(result_a.outcome == CSTK_SLIDE_MOVED && result_b.outcome == CSTK_SLIDE_MOVED);
    CHECK(near(reached_a, reached_b, a->n, 1e-12));
}

/* A joint of the caller's that moves as a built-in one is answered alike. */
static void imitate(int32_t kind, const cstk_custom_joint *custom) {
    cstk_body *body = make_box(0.3, 0.1, 0.1);
    cstk_environment *environment = NULL;
    uint64_t seed = 3;
    CHECK_OK(cstk_environment_create(&environment));
    add_object(environment, body, 2.0, 1.5, 0.5);
    const arm built_in = make_posed_arm(kind, NULL, body, environment);
    const arm own = make_posed_arm(kind, custom, body, environment);
    CHECK(built_in.n == own.n && own.n <= 9);
    for (int i = 0; i < 20; ++i) {
        double q[9];
        for (size_t k = 0; k < own.n; ++k) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            q[k] = 0.3 * ((double)(seed >> 11) / 4503599627370496.0 - 1.0);
        }
        same_kinematics(&built_in, &own, q);
        same_answers(&built_in, &own, q);
    }
    arm_release(&built_in);
    arm_release(&own);
    CHECK_OK(cstk_environment_release(environment));
    CHECK_OK(cstk_body_release(body));
}

static void custom_joints(void) {
    double pitch = 0.0;
    cstk_custom_joint custom = screw(&pitch);
    imitate(CSTK_JOINT_REVOLUTE, &custom);
    custom = plane();
    imitate(CSTK_JOINT_PLANAR, &custom);
}

/* A unit cube that moves freely above a floor whose surface is z = 0. */
typedef struct hover {
    cstk_space *space;
    cstk_cobject *cobject;
    cstk_query *query;
} hover;

static hover make_hover(double margin) {
    hover h;
    cstk_body *cube = make_box(0.5, 0.5, 0.5);
    cstk_body *floor = make_box(10.0, 10.0, 0.5);
    cstk_environment *environment = NULL;
    cstk_cobject_options options;
    cstk_link_def def = link_of(CSTK_JOINT_FREE);
    def.body = cube;
    cstk_robot *robot = make_robot(&def);
    CHECK_OK(cstk_environment_create(&environment));
    add_object(environment, floor, 0.0, 0.0, -0.5);
    CHECK_OK(cstk_cobject_options_default(&options, sizeof options));
    options.margin = margin;
    h.space = space_of(robot, NULL, 0);
    CHECK_OK(cstk_cobject_induced(h.space, NULL, 0, environment, NULL, 0, &options, &h.cobject));
    CHECK_OK(cstk_query_create(&h.query));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_environment_release(environment));
    CHECK_OK(cstk_body_release(floor));
    CHECK_OK(cstk_body_release(cube));
    return h;
}

static void hover_release(const hover *h) {
    CHECK_OK(cstk_query_release(h->query));
    CHECK_OK(cstk_cobject_release(h->cobject));
    CHECK_OK(cstk_space_release(h->space));
}

/* The contacts of the cube's lower face at a height of `gap`, turned by a quarter about z. */
static cstk_witness_list hover_at(const hover *h, double gap, double margin) {
    const double q[FREE_NQ] = {1.0, 2.0, 0.5 + gap, 0, 0, sqrt(0.5), sqrt(0.5)};
    cstk_witness_list list;
    CHECK_OK(cstk_gradients(h->query, h->cobject, q, FREE_NQ, 0.2, 16, &list));
    CHECK(list.contact_count == 4 && list.nv == FREE_NV);
    for (int i = 0; i < 4; ++i) {
        CHECK(fabs(list.contacts[i].clearance - (gap - margin)) < 1e-14);
        CHECK(fabs(list.contacts[i].distance - fmax(gap - margin, 0.0)) < 1e-14);
    }
    return list;
}

static void slide_step_over(const cstk_witness_list *list, double down, bool normalize,
                            double forward, double left) {
    const double step[FREE_NV] = {0.1, 0, -down, 0, 0, 0};
    const double expected[FREE_NV] = {forward, 0, -left, 0, 0, 0};
    double out[FREE_NV];
    bool found = false;
    memcpy(out, step, sizeof out);
    CHECK_OK(cstk_slide_step(list, out, FREE_NV, 0.05, normalize, out, &found));
    CHECK(found && near(out, expected, FREE_NV, 1e-9));
}

static void steps_of_lists(void) {
    const double still[FREE_NV] = {0};
    const double down[FREE_NV] = {0, 0, -0.1, 0, 0, 0};
    double out[FREE_NV];
    bool found = false;
    hover h = make_hover(0.0);
    cstk_witness_list list = hover_at(&h, 0.15, 0.0);
    /* Down to the desired distance, not beyond; and nearer than that, not at all. */
    slide_step_over(&list, 0.09, false, 0.1, 0.09);
    slide_step_over(&list, 0.2, false, 0.1, 0.1);
    CHECK_OK(cstk_spring_step(&list, FREE_NV, 0.05, out, &found));
    CHECK(!found && memcmp(out, still, sizeof out) == 0);
    list = hover_at(&h, 0.02, 0.0);
    slide_step_over(&list, 0.1, false, 0.1, 0.0);
    slide_step_over(&list, 0.1, true, 0.1 * sqrt(2.0), 0.0);
    slide_step_over(&list, -0.1, true, 0.1, -0.1);
    CHECK_OK(cstk_slide_step(&list, down, FREE_NV, 0.05, true, out, &found));
    CHECK(!found && memcmp(out, still, sizeof out) == 0);
    CHECK_OK(cstk_spring_step(&list, FREE_NV, 0.05, out, &found));
    const double up[FREE_NV] = {0, 0, 0.03, 0, 0, 0};
    CHECK(found && near(out, up, FREE_NV, 1e-9));
    hover_release(&h);
    /* Within the margin, the way out begins below 0. */
    h = make_hover(0.06);
    list = hover_at(&h, 0.02, 0.06);
    CHECK_OK(cstk_spring_step(&list, FREE_NV, 0.05, out, &found));
    const double out_of_margin[FREE_NV] = {0, 0, 0.09, 0, 0, 0};
    CHECK(found && near(out, out_of_margin, FREE_NV, 1e-9));
    slide_step_over(&list, 0.1, false, 0.1, 0.0);
    hover_release(&h);
}

/* Between a floor and a ceiling the best a step can do is the middle. */
static void spring_between(void) {
    cstk_body *cube = make_box(0.5, 0.5, 0.5);
    cstk_environment *environment = NULL;
    cstk_cobject *cobject = NULL;
    cstk_query *query = NULL;
    cstk_witness_list list;
    cstk_link_def def = link_of(CSTK_JOINT_PRISMATIC);
    def.body = cube;
    cstk_robot *robot = make_robot(&def);
    cstk_space *space = space_of(robot, NULL, 0);
    CHECK_OK(cstk_environment_create(&environment));
    add_object(environment, cube, 0.0, 0.0, -1.02);
    add_object(environment, cube, 0.0, 0.0, 1.06);
    CHECK_OK(cstk_cobject_induced(space, NULL, 0, environment, NULL, 0, NULL, &cobject));
    CHECK_OK(cstk_query_create(&query));
    const double q = 0.0;
    double out = 0.0;
    bool found = false;
    CHECK_OK(cstk_gradients(query, cobject, &q, 1, 0.2, 16, &list));
    CHECK(list.contact_count == 8);
    CHECK_OK(cstk_spring_step(&list, 1, 0.1, &out, &found));
    CHECK(found && fabs(out - 0.02) < 1e-6);
    CHECK_OK(cstk_spring_step(&list, 1, 0.03, &out, &found));
    CHECK(found && fabs(out - 0.01) < 1e-9);
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_cobject_release(cobject));
    CHECK_OK(cstk_environment_release(environment));
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_body_release(cube));
}

static void pose_functions(void) {
    const double placement[6] = {1, 2, 3, 2.4, -0.7, 1.1};
    const double point[3] = {-0.5, 0.25, 2.0};
    double pose[12];
    double inverse[12];
    double product[12];
    double quaternion[7];
    double there[3];
    CHECK_OK(cstk_pose_from_euler(placement, pose));
    CHECK_OK(cstk_pose_inverse(pose, inverse));
    CHECK_OK(cstk_pose_compose(pose, inverse, product));
    CHECK(near(product, identity_pose, 12, 1e-15));
    CHECK_OK(cstk_pose_transform_point(pose, point, there));
    for (int i = 0; i < 3; ++i) {
        const double *row = pose + 4 * i;
        CHECK(fabs(there[i] -
                   (row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3])) < 1e-15);
    }
    CHECK_OK(cstk_pose_transform_point(inverse, there, there));
    CHECK(near(there, point, 3, 1e-15));
    CHECK_OK(cstk_pose_to_quaternion(pose, quaternion));
    CHECK(quaternion[6] >= 0.0 && fabs(length_of(quaternion + 3, 4) - 1.0) < 1e-15);
    CHECK_OK(cstk_pose_from_quaternion(quaternion, product));
    CHECK(near(product, pose, 12, 1e-15));
    CHECK_OK(cstk_pose_inverse(inverse, inverse));
    CHECK(near(inverse, pose, 12, 1e-15));
}

static void euler_rates(void) {
    const double angles[3] = {0.4, -0.7, 1.1};
    const double step = 1e-5;
    double matrix[9];
    double inverse[9];
    for (int32_t frame = CSTK_ANGULAR_WORLD; frame <= CSTK_ANGULAR_BODY; ++frame) {
        CHECK_OK(cstk_euler_rates(angles, frame, matrix));
        CHECK_OK(cstk_euler_rates_inverse(angles, frame, inverse));
        for (int k = 0; k < 3; ++k) {
            double ahead[6] = {0, 0, 0, angles[0], angles[1], angles[2]};
            double behind[6] = {0, 0, 0, angles[0], angles[1], angles[2]};
            double a[12];
            double b[12];
            double turn[12];
            ahead[3 + k] += step;
            behind[3 + k] -= step;
            CHECK_OK(cstk_pose_from_euler(ahead, a));
            CHECK_OK(cstk_pose_from_euler(behind, b));
            CHECK_OK(cstk_pose_inverse(b, b));
            CHECK_OK(frame == CSTK_ANGULAR_WORLD ? cstk_pose_compose(a, b, turn)
                                                 : cstk_pose_compose(b, a, turn));
            const double measured[3] = {turn[9] - turn[6], turn[2] - turn[8], turn[4] - turn[1]};
            for (int row = 0; row < 3; ++row) {
                double product = 0;
                for (int i = 0; i < 3; ++i) {
                    product += matrix[3 * row + i] * inverse[3 * i + k];
                }
                CHECK(fabs(measured[row] / (4 * step) - matrix[3 * row + k]) < 1e-9);
                CHECK(fabs(product - (row == k)) < 1e-15);
            }
        }
    }
}

/* The Euler Jacobian of a link that Euler angles move is the identity. */
static void euler_jacobian(void) {
    const double q[6] = {0.1, 0.2, 0.3, 0.4, -0.7, 1.1};
    const double origin[3] = {0, 0, 0};
    const cstk_link_def def = link_of(CSTK_JOINT_FREE_EULER);
    cstk_robot *robot = make_robot(&def);
    double basic[36];
    double matrix[36];
    CHECK_OK(cstk_robot_jacobian(robot, q, 6, 0, origin, basic));
    memcpy(matrix, basic, sizeof matrix);
    CHECK_OK(cstk_jacobian_to_euler(q + 3, matrix, 6));
    for (int i = 0; i < 36; ++i) {
        CHECK(fabs(matrix[i] - (i % 7 == 0)) < 1e-15);
    }
    CHECK_OK(cstk_jacobian_from_euler(q + 3, matrix, 6));
    CHECK(near(matrix, basic, 36, 1e-15));
    CHECK_OK(cstk_robot_release(robot));
}

int main(void) {
    every_kind();
    offsets();
    free_joint();
    topology();
    sampling();
    mimic();
    custom_joints();
    steps_of_lists();
    spring_between();
    pose_functions();
    euler_rates();
    euler_jacobian();
    return check_result();
}
