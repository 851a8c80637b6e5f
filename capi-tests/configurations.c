/* Configurations: steps and differences, ranges, and samples. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

static const double half_turn = 3.14159265358979323846;

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
    CHECK_OK(cstk_space_difference(space, q0, opposite, 3, found));
    CHECK(fabs(found[0] - half_turn) < 1e-15);
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
    CHECK_STATUS(cstk_space_sample(space, &state, &q), CSTK_ERROR_UNSUPPORTED);
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
}

int main(void) {
    free_joint();
    topology();
    sampling();
    return check_result();
}
