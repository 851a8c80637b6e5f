#include "cube.h"

#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

enum { NQ = CUBE_NQ };

static const double half[3] = {0.3, 0.2, 0.4};
static const double obstacle_half[3] = {0.5, 0.3, 0.4};
static const double obstacles[2][3] = {{0.7, -0.3, 0.2}, {-0.8, 0.5, -0.4}};
static const double margin = 0.15;
static const double lower[NQ] = {-1.8, -1.5, -1.7};
static const double upper[NQ] = {1.8, 1.7, 1.5};
static const double world_box[6] = {-1.7, -1.9, -1.6, 1.7, 1.9, 1.6};
static const double center[NQ] = {0.4, 0.5, -0.2};
static const double radius = 0.8;
static const double low[NQ] = {-1.2, -1.0, -0.3};
static const double high[NQ] = {0.1, -0.2, 1.1};
static const double normal[NQ] = {1.0, -2.0, 2.0};
static const double offset = -1.2;
static const double pole_radius = 0.6;
/* Contact epsilons; that of a predicate is its own. */
static const double epsilons[LEAVES] = {0.2, 0.1, 0.25, 0.3, 0.15, 0.2, 0.4, 0.1};

/* The length of the positive entries; of none the largest entry. */
static double beyond(const double *each) {
    double out[3];
    for (int i = 0; i < 3; ++i) {
        out[i] = fmax(0.0, each[i]);
    }
    const double length = length_of(out, 3);
    return length > 0.0 ? length : fmax(each[0], fmax(each[1], each[2]));
}

/* How far q is beyond a box, or minus how deep within. */
static double beyond_box(const double *q, const double *from, const double *to) {
    double each[3];
    for (int i = 0; i < 3; ++i) {
        each[i] = fmax(from[i] - q[i], q[i] - to[i]);
    }
    return beyond(each);
}

/* How far the cube is from an obstacle. */
static double gap(const double *q, const double *obstacle) {
    double each[3];
    for (int i = 0; i < 3; ++i) {
        each[i] = fabs(q[i] - obstacle[i]) - half[i] - obstacle_half[i];
    }
    return beyond(each);
}

double leaf_distance(int leaf, const double *q) {
    const double from_center[3] = {q[0] - center[0], q[1] - center[1], q[2] - center[2]};
    const double along = normal[0] * q[0] + normal[1] * q[1] + normal[2] * q[2];
    switch (leaf) {
    case OBSTACLE:
        return gap(q, obstacles[0]);
    case GROWN_OBSTACLE:
        return gap(q, obstacles[1]) - margin;
    case LIMITS:
        return -beyond_box(q, lower, upper);
    case WORLD:
        return -beyond_box(q, world_box, world_box + 3);
    case BALL:
        return length_of(from_center, 3) - radius;
    case BOX:
        return beyond_box(q, low, high);
    case HALF_SPACE:
        return (along - offset) / length_of(normal, 3);
    default:
        return hypot(q[0], q[1]) - pole_radius;
    }
}

bool leaf_slope(int leaf, const double *q, int k, double *out) {
    const double h = 1e-6;
    double there[2][NQ];
    for (int side = 0; side < 2; ++side) {
        memcpy(there[side], q, sizeof there[side]);
        there[side][k] += side == 0 ? -h : h;
    }
    const double before = leaf_distance(leaf, there[0]);
    const double after = leaf_distance(leaf, there[1]);
    *out = (after - before) / (2.0 * h);
    return fabs(after - 2.0 * leaf_distance(leaf, q) + before) < 1e-3 * h;
}

cstk_class leaf_class(int leaf, const double *q) {
    const double away = leaf_distance(leaf, q);
    return away <= 0.0 ? CSTK_CLASS_INSIDE : away <= epsilons[leaf] ? CSTK_CLASS_CONTACT : CSTK_CLASS_OUTSIDE;
}

static int32_t pole_class(const double *q, size_t nq, int32_t *out, void *user) {
    CHECK(nq == NQ && user == NULL);
    const double away = leaf_distance(POLE, q);
    *out = away <= 0.0 ? CSTK_CLASS_INSIDE : away <= epsilons[POLE] ? CSTK_CLASS_CONTACT : CSTK_CLASS_OUTSIDE;
    return CSTK_OK;
}

static int32_t pole_distance(const double *q, size_t nq, double *out, void *user) {
    CHECK(nq == NQ && user == NULL);
    *out = leaf_distance(POLE, q);
    return CSTK_OK;
}

static int32_t pole_gradient(const double *q, size_t nq, double *row, size_t nv, void *user) {
    CHECK(nq == NQ && nv == NQ && user == NULL);
    row[0] = q[0] / hypot(q[0], q[1]);
    row[1] = q[1] / hypot(q[0], q[1]);
    row[2] = 0.0;
    return CSTK_OK;
}

bool leaf_is_pure(int leaf) { return leaf >= LIMITS; }

bool leaf_knows_depth(int leaf) { return leaf >= BALL || leaf == LIMITS; }

static void make_obstacle(cube *c, int i) {
    cstk_induced_options options;
    CHECK_OK(cstk_induced_options_default(&options, sizeof options));
    options.contact_epsilon = epsilons[i];
    options.margin = i == GROWN_OBSTACLE ? margin : 0.0;
    CHECK_OK(cstk_environment_create(&c->environments[i]));
    /* One body in two environments. */
    c->objects[i] = add_object(c->environments[i], c->obstacle_body, obstacles[i][0],
                               obstacles[i][1], obstacles[i][2]);
    CHECK_OK(cstk_cobject_induced(c->space, NULL, 0, c->environments[i], NULL, 0, &options,
                                  &c->leaves[i].set));
}

static void make_pure(cube *c, int i) {
    cstk_pure_options options;
    cstk_predicate pole;
    cstk_cobject **out = &c->leaves[i].set;
    const cstk_space *space = c->space;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    options.contact_epsilon = epsilons[i];
    options.scale = 1.0;
    switch (i) {
    case LIMITS:
        CHECK_OK(cstk_cobject_beyond_limits(space, &options, out));
        break;
    case WORLD:
        CHECK_OK(cstk_cobject_beyond_world(space, &options, out));
        break;
    case BALL:
        CHECK_OK(cstk_cobject_ball(space, center, NQ, radius, &options, out));
        break;
    case BOX:
        CHECK_OK(cstk_cobject_box(space, low, high, NQ, &options, out));
        break;
    case HALF_SPACE:
        CHECK_OK(cstk_cobject_halfspace(space, normal, NQ, offset, &options, out));
        break;
    default:
        CHECK_OK(cstk_predicate_default(&pole, sizeof pole));
        CHECK(pole.classify == NULL && pole.distance == NULL && pole.gradient == NULL);
        CHECK(pole.distance_is_bound == 0 && pole.knows_depth == 0 && pole.destroy == NULL);
        pole.classify = pole_class;
        pole.distance = pole_distance;
        pole.gradient = pole_gradient;
        pole.knows_depth = 1;
        CHECK_OK(cstk_cobject_predicate(space, &pole, &options, out));
    }
}

void cube_create(cube *c) {
    cstk_robot_builder *builder = NULL;
    memset(c, 0, sizeof *c);
    c->body = make_box(half[0], half[1], half[2]);
    c->obstacle_body = make_box(obstacle_half[0], obstacle_half[1], obstacle_half[2]);
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < NQ; ++i) {
        cstk_link_def def = link_of(CSTK_JOINT_PRISMATIC);
        def.axis[2] = 0.0;
        def.axis[i] = 1.0;
        def.parent = i - 1;
        def.body = i == CUBE_LINK ? c->body : NULL;
        def.lower = lower[i];
        def.upper = upper[i];
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    CHECK_OK(cstk_robot_build(builder, &c->robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    const cstk_robot *robot = c->robot;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, world_box, &c->space));
    CHECK_OK(cstk_query_create(&c->query));
    for (int i = 0; i < LEAVES; ++i) {
        leaf *l = &c->leaves[i];
        if (leaf_is_pure(i)) {
            make_pure(c, i);
        } else {
            make_obstacle(c, i);
        }
        if (i % 2 == 0) {
            cstk_cobject *without = l->set;
            CHECK_OK(cstk_cobject_with_data(without, l, NULL, &l->set));
            CHECK_OK(cstk_cobject_release(without));
        }
        CHECK_OK(cstk_cobject_get_data(l->set, &l->data, &l->number));
        CHECK(l->data == (i % 2 == 0 ? l : NULL));
    }
}

void cube_release(const cube *c) {
    for (int i = 0; i < LEAVES; ++i) {
        CHECK_OK(cstk_cobject_release(c->leaves[i].set));
    }
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_environment_release(c->environments[i]));
    }
    CHECK_OK(cstk_query_release(c->query));
    CHECK_OK(cstk_space_release(c->space));
    CHECK_OK(cstk_robot_release(c->robot));
    CHECK_OK(cstk_body_release(c->obstacle_body));
    CHECK_OK(cstk_body_release(c->body));
}
