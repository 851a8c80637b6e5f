/* Sets given by coordinates, against closed forms that are computed here: classes, distances,
 * witnesses and gradients; from the set and from its complement. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

/* A robot with a joint of every kind of coordinates: a rail with limits, a wheel, a hinge with
 * limits, a ball joint, a drone; and where their coordinates and velocities begin. */
enum { NQ = 14, NV = 12, RAIL = 0, WHEEL = 1, HINGE = 2, BALL = 3, DRONE = 7, DRONE_TURN = 10 };

static const double two_pi = 6.283185307179586;

typedef struct ground {
    cstk_robot *robot;
    cstk_space *space;
    cstk_query *query;
} ground;

/* Whether a coordinate belongs to a quaternion. */
static bool is_turn(int i) { return (BALL <= i && i < DRONE) || i >= DRONE_TURN; }

static ground make_ground(void) {
    ground g;
    cstk_robot_builder *builder = NULL;
    const int32_t kinds[] = {CSTK_JOINT_PRISMATIC, CSTK_JOINT_REVOLUTE, CSTK_JOINT_REVOLUTE,
                             CSTK_JOINT_SPHERICAL, CSTK_JOINT_FREE};
    const cstk_range limits[NQ] = {
        [RAIL] = {CSTK_RANGE_INTERVAL, 0, -1.0, 2.0},
        [WHEEL] = {CSTK_RANGE_CIRCLE, 0, 0.0, 0.0},
        [HINGE] = {CSTK_RANGE_INTERVAL, 0, -0.5, 1.5},
        [DRONE] = {CSTK_RANGE_INTERVAL, 0, -INFINITY, 1.0},
        [DRONE + 1] = {CSTK_RANGE_INTERVAL, 0, -2.0, 2.0},
        [DRONE + 2] = {CSTK_RANGE_INTERVAL, 0, -INFINITY, INFINITY},
    };
    cstk_range ranges[NQ];
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < 5; ++i) {
        const cstk_link_def def = link_of(kinds[i]);
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    CHECK_OK(cstk_robot_build(builder, &g.robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    for (int i = 0; i < NQ; ++i) {
        ranges[i] = is_turn(i) ? (cstk_range){CSTK_RANGE_DEFAULT, 0, 0, 0} : limits[i];
    }
    g.space = space_of(g.robot, ranges, NQ);
    CHECK_OK(cstk_query_create(&g.query));
    return g;
}

static void ground_release(const ground *g) {
    CHECK_OK(cstk_query_release(g->query));
    CHECK_OK(cstk_space_release(g->space));
    CHECK_OK(cstk_robot_release(g->robot));
}

static uint64_t random_state = 0x9E3779B97F4A7C15u;

static double random_between(double low, double high) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return low + (high - low) * (double)(random_state >> 11) / 9007199254740992.0;
}

static void random_turn(double quaternion[4]) {
    double length = 0.0;
    while (!(length > 0.1)) {
        for (int i = 0; i < 4; ++i) {
            quaternion[i] = random_between(-1.0, 1.0);
        }
        length = length_of(quaternion, 4);
    }
    for (int i = 0; i < 4; ++i) {
        quaternion[i] /= length;
    }
}

static void random_configuration(double q[NQ]) {
    /* Now and then near the middle, where no limit is broken. */
    const double reach = random_between(0.0, 1.0) < 0.3 ? 0.5 : 3.0;
    for (int i = 0; i < NQ; ++i) {
        q[i] = random_between(-reach, reach);
    }
    q[WHEEL] = random_between(-12.0, 12.0);
    random_turn(&q[BALL]);
    random_turn(&q[DRONE_TURN]);
}

/* An angle within half a turn, up to whole ones. */
static double short_way(double angle) { return atan2(sin(angle), cos(angle)); }

/* By how much the turns of two unit quaternions differ: a chord of the unit sphere's two points, or
 * of one and the other's antipode, spans a quarter of it. */
static double turn_between(const double *a, const double *b) {
    double apart = 0.0;
    double together = 0.0;
    for (int i = 0; i < 4; ++i) {
        apart += (a[i] - b[i]) * (a[i] - b[i]);
        together += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return 4.0 * atan2(sqrt(fmin(apart, together)), sqrt(fmax(apart, together)));
}

typedef enum kind { LIMITS, BOX, HALF_SPACE, ROUND, KINDS } kind;

/* A set with all that any kind of it is made of. */
typedef struct shape {
    kind kind;
    double low[NQ];
    double high[NQ];
    double normal[NQ];
    double offset;
    double center[NQ];
    double radius;
    cstk_pure_options options;
} shape;

static shape random_shape(kind kind) {
    shape s;
    memset(&s, 0, sizeof s);
    s.kind = kind;
    CHECK_OK(cstk_pure_options_default(&s.options, sizeof s.options));
    CHECK(s.options.contact_epsilon == 0.0 && s.options.scale == 0.0);
    s.options.contact_epsilon = random_between(0.0, 1.0);
    s.options.scale = random_between(0.0, 1.0) < 0.5 ? 0.0 : random_between(0.1, 5.0);
    for (int i = 0; i < NQ; ++i) {
        s.low[i] = random_between(-3.0, 1.0);
        s.high[i] = s.low[i] + random_between(0.5, 4.0);
        s.normal[i] = i == WHEEL || is_turn(i) ? 0.0 : random_between(-3.0, 3.0);
        if (is_turn(i) || (i != WHEEL && random_between(0.0, 1.0) < 0.6)) {
            s.low[i] = -INFINITY;
        }
        if (is_turn(i) || (i != WHEEL && random_between(0.0, 1.0) < 0.6)) {
            s.high[i] = INFINITY;
        }
    }
    s.offset = random_between(-5.0, 5.0);
    random_configuration(s.center);
    s.radius = random_between(0.0, 7.0);
    return s;
}

static cstk_cobject *make_set(const ground *g, const shape *s) {
    cstk_cobject *set = NULL;
    switch (s->kind) {
    case LIMITS:
        CHECK_OK(cstk_cobject_beyond_limits(g->space, &s->options, &set));
        break;
    case BOX:
        CHECK_OK(cstk_cobject_box(g->space, s->low, s->high, NQ, &s->options, &set));
        break;
    case HALF_SPACE:
        CHECK_OK(cstk_cobject_halfspace(g->space, s->normal, NQ, s->offset, &s->options, &set));
        break;
    default:
        CHECK_OK(cstk_cobject_ball(g->space, s->center, NQ, s->radius, &s->options, &set));
    }
    return set;
}

/* How far q is beyond an interval, or minus how deep within. */
static double beyond(double q, double low, double high) { return fmax(low - q, q - high); }

/* The same on the circle, where the arc runs from `low` upwards. */
static double beyond_arc(double q, double low, double high) {
    const double width = high - low;
    const double from_low = q - low - two_pi * floor((q - low) / two_pi);
    if (from_low <= width) {
        return -fmin(from_low, width - from_low);
    }
    return fmin(from_low - width, two_pi - from_low);
}

/* From how far each coordinate is beyond: outside the length of all, inside the least depth. */
static double beyond_all(const double *each, int count) {
    double most = -INFINITY;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        most = fmax(most, each[i]);
        sum += each[i] > 0.0 ? each[i] * each[i] : 0.0;
    }
    return most > 0.0 ? sqrt(sum) : most;
}

static double beyond_limits(const double *q) {
    const double each[] = {beyond(q[RAIL], -1.0, 2.0), beyond(q[HINGE], -0.5, 1.5), q[DRONE] - 1.0,
                           beyond(q[DRONE + 1], -2.0, 2.0)};
    return -beyond_all(each, 4);
}

static double beyond_box(const shape *s, const double *q) {
    double each[NQ];
    for (int i = 0; i < NQ; ++i) {
        each[i] = beyond(q[i], s->low[i], s->high[i]);
    }
    each[WHEEL] = beyond_arc(q[WHEEL], s->low[WHEEL], s->high[WHEEL]);
    return beyond_all(each, NQ);
}

static double beyond_plane(const shape *s, const double *q) {
    double along = 0.0;
    for (int i = 0; i < NQ; ++i) {
        along += s->normal[i] * q[i];
    }
    return (along - s->offset) / length_of(s->normal, NQ);
}

static double beyond_ball(const shape *s, const double *q) {
    const double each[] = {
        q[RAIL] - s->center[RAIL],           short_way(q[WHEEL] - s->center[WHEEL]),
        q[HINGE] - s->center[HINGE],         turn_between(&q[BALL], &s->center[BALL]),
        q[DRONE] - s->center[DRONE],         q[DRONE + 1] - s->center[DRONE + 1],
        q[DRONE + 2] - s->center[DRONE + 2], turn_between(&q[DRONE_TURN], &s->center[DRONE_TURN])};
    return length_of(each, 8) - s->radius;
}

/* The distance in units of C-space; inside minus the depth. */
static double signed_distance(const shape *s, const double *q) {
    switch (s->kind) {
    case LIMITS:
        return beyond_limits(q);
    case BOX:
        return beyond_box(s, q);
    case HALF_SPACE:
        return beyond_plane(s, q);
    default:
        return beyond_ball(s, q);
    }
}

static double scale_of(const shape *s) { return s->options.scale == 0.0 ? 1.0 : s->options.scale; }

static cstk_class class_at(double distance, double epsilon) {
    return distance <= 0.0 ? CSTK_CLASS_INSIDE : distance <= epsilon ? CSTK_CLASS_CONTACT : CSTK_CLASS_OUTSIDE;
}

/* The distance, all that comes with it, and the questions that are answered by it. `away` is the
 * truth, negative inside. */
static void check_distance(const ground *g, const cstk_cobject *set, const double *q, double away) {
    cstk_distance_result d;
    bool within = false;
    const double truth = fmax(0.0, away);
    CHECK_OK(cstk_distance(g->query, set, q, NQ, INFINITY, &d));
    CHECK(d.kind == CSTK_DISTANCE_EXACT && fabs(d.distance - truth) < 1e-12 * fmax(1.0, truth));
    CHECK(d.lower <= d.distance && d.distance <= d.upper && d.upper - d.lower < 1e-12);
    CHECK((d.distance == 0.0) == (away < 0.0) && (d.lower == 0.0) == (d.distance == 0.0));
    CHECK(d.has_witness && d.has_contact && d.environment_version == 0);
    CHECK(d.witness.distance == d.distance && d.contact.distance == d.distance);
    CHECK(fabs(d.contact.clearance - away) < 1e-12 * fmax(1.0, fabs(away)));
    if (truth > 0.0) {
        CHECK_OK(cstk_distance(g->query, set, q, NQ, 0.9 * truth, &d));
        CHECK(d.kind == CSTK_DISTANCE_BEYOND_MAX && d.lower == 0.9 * truth && d.upper == INFINITY);
        CHECK_OK(cstk_within(g->query, set, q, NQ, 0.9 * truth, &within));
        CHECK(!within);
    }
    CHECK_OK(cstk_distance(g->query, set, q, NQ, 1.1 * truth, &d));
    CHECK(d.kind == CSTK_DISTANCE_EXACT);
    CHECK_OK(cstk_within(g->query, set, q, NQ, 1.1 * truth, &within));
    CHECK(within);
}

/* The derivative of the set's distance along one velocity by central differences of the closed
 * form; false where it has a kink. */
static bool slope(const ground *g, const shape *s, const double *q, int k, double *out) {
    const double h = 1e-6;
    double v[NV] = {0};
    double there[2][NQ];
    for (int side = 0; side < 2; ++side) {
        v[k] = side == 0 ? -h : h;
        CHECK_OK(cstk_space_step(g->space, q, NQ, v, NV, there[side]));
    }
    const double before = signed_distance(s, there[0]);
    const double here = signed_distance(s, q);
    const double after = signed_distance(s, there[1]);
    *out = (after - before) / (2.0 * h);
    return fabs(after - 2.0 * here + before) < 1e-3 * h;
}

/* The one witness, its contact and its row; `sign` is -1 of a complement. Returns how many entries
 * of the row were compared. */
static int check_witness(const ground *g, const shape *s, const cstk_cobject *set, uint64_t leaf,
                         const double *q, double sign) {
    cstk_witness_list list;
    int compared = 0;
    const double away = sign * scale_of(s) * signed_distance(s, q);
    if (away > 0.0) {
        CHECK_OK(cstk_witnesses(g->query, set, q, NQ, 0.9 * away, 16, &list));
        CHECK(list.witness_count == 0 && list.contact_count == 0 && !list.truncated);
    }
    CHECK_OK(cstk_gradients(g->query, set, q, NQ, 1.1 * fmax(0.0, away), 16, &list));
    CHECK(list.witness_count == 1 && list.contact_count == 1 && list.nv == NV && !list.truncated);
    const cstk_witness *w = list.witnesses;
    CHECK(w->r_link == CSTK_NONE && w->s_link == CSTK_NONE && w->s_object == 0 && w->r_object == 0);
    CHECK(w->cobject == leaf && w->cobject_data == NULL && w->r_data == NULL && w->s_data == NULL);
    CHECK(w->first_contact == 0 && w->contact_count == 1 && !w->overlapping);
    CHECK(w->r_primitive == 0 && w->s_primitive == 0 && w->r_tag == 0 && w->s_tag == 0);
    const cstk_contact *c = list.contacts;
    const double zero[3] = {0};
    CHECK(c->mode == CSTK_MODE_PURE_SET && fabs(c->clearance - away) < 1e-12 * fmax(1.0, fabs(away)));
    CHECK(c->distance == w->distance && near(c->r_point, zero, 3, 0.0));
    CHECK(near(c->s_point, zero, 3, 0.0) && near(c->normal, zero, 3, 0.0));
    for (int k = 0; k < NV; ++k) {
        double expected;
        if (slope(g, s, q, k, &expected)) {
            CHECK(fabs(list.gradients[k] - sign * scale_of(s) * expected) < 1e-6);
            ++compared;
        }
    }
    return compared;
}

/* All in one pass gives the same. */
static void check_pseudo_normal(const ground *g, const cstk_cobject *set, const double *q) {
    cstk_class point_class;
    cstk_distance_result d;
    cstk_witness_list list;
    cstk_pseudo_normal_result all;
    double row[NV];
    CHECK_OK(cstk_classify(g->query, set, q, NQ, &point_class));
    CHECK_OK(cstk_distance(g->query, set, q, NQ, INFINITY, &d));
    CHECK_OK(cstk_gradients(g->query, set, q, NQ, 100.0, 16, &list));
    memcpy(row, list.gradients, sizeof row);
    CHECK_OK(cstk_pseudo_normal(g->query, set, q, NQ, 100.0, 16, false, &all));
    CHECK(all.point_class == point_class && all.distance.distance == d.distance);
    CHECK(all.list.witness_count == 1 && near(all.list.gradients, row, NV, 0.0));
    CHECK_OK(cstk_pseudo_normal(g->query, set, q, NQ, 100.0, 16, true, &all));
    const double length = length_of(row, NV);
    CHECK(length == 0.0 || fabs(length_of(all.list.gradients, NV) - 1.0) < 1e-14);
}

/* A set and its complement at one configuration. */
static int check_set(const ground *g, const shape *s, const cstk_cobject *set, const double *q) {
    cstk_cobject *complement = NULL;
    cstk_class classes[2];
    uint64_t leaf = 0;
    const double away = scale_of(s) * signed_distance(s, q);
    const cstk_class expected = class_at(away, scale_of(s) * s->options.contact_epsilon);
    CHECK_OK(cstk_cobject_get_data(set, NULL, &leaf));
    CHECK_OK(cstk_cobject_complement(set, &complement));
    CHECK_OK(cstk_classify(g->query, set, q, NQ, &classes[0]));
    CHECK_OK(cstk_classify(g->query, complement, q, NQ, &classes[1]));
    CHECK(classes[0] == expected && classes[0] + classes[1] == CSTK_CLASS_INSIDE);
    check_distance(g, set, q, away);
    check_distance(g, complement, q, -away);
    check_pseudo_normal(g, set, q);
    check_pseudo_normal(g, complement, q);
    const int compared =
        check_witness(g, s, set, leaf, q, 1.0) + check_witness(g, s, complement, leaf, q, -1.0);
    CHECK_OK(cstk_cobject_release(complement));
    return compared;
}

static void closed_forms(const ground *g) {
    for (int kind = 0; kind < KINDS; ++kind) {
        int inside = 0;
        int compared = 0;
        for (int i = 0; i < 40; ++i) {
            const shape s = random_shape(kind);
            cstk_cobject *set = make_set(g, &s);
            for (int k = 0; k < 5; ++k) {
                double q[NQ];
                random_configuration(q);
                inside += signed_distance(&s, q) <= 0.0;
                compared += check_set(g, &s, set, q);
            }
            CHECK_OK(cstk_cobject_release(set));
        }
        /* Neither side is rare, and neither are derivatives. */
        CHECK(5 < inside && inside < 195 && compared > 4000);
    }
}

static void expect(const ground *g, const cstk_cobject *set, const double *q, cstk_class expected,
                   double distance) {
    cstk_class point_class;
    cstk_distance_result d;
    CHECK_OK(cstk_classify(g->query, set, q, NQ, &point_class));
    CHECK_OK(cstk_distance(g->query, set, q, NQ, INFINITY, &d));
    CHECK(point_class == expected && d.distance == distance);
    CHECK(d.kind == (distance == INFINITY ? CSTK_DISTANCE_EMPTY : CSTK_DISTANCE_EXACT));
    CHECK(d.has_witness == (distance < INFINITY) && (d.lower == 0.0) == (distance == 0.0));
}

/* A set and its complement, where the numbers have no rounding. */
static void expect_both(const ground *g, const shape *s, const double *q, cstk_class in_set,
                        double distance, cstk_class in_complement, double from_complement) {
    cstk_cobject *complement = NULL;
    cstk_cobject *set = make_set(g, s);
    CHECK_OK(cstk_cobject_complement(set, &complement));
    expect(g, set, q, in_set, distance);
    expect(g, complement, q, in_complement, from_complement);
    CHECK_OK(cstk_cobject_release(complement));
    CHECK_OK(cstk_cobject_release(set));
}

/* Closed sets hold their boundaries; the sets beyond limits do not, and neither do complements. At
 * all of them the distance is 0. */
static void boundaries(const ground *g) {
    double q[NQ];
    shape s = random_shape(HALF_SPACE);
    CHECK_OK(cstk_pure_options_default(&s.options, sizeof s.options));
    CHECK_OK(cstk_space_get_neutral(g->space, q));
    q[RAIL] = 2.0;
    memset(s.normal, 0, sizeof s.normal);
    s.normal[RAIL] = -4.0;
    s.offset = -8.0;
    expect_both(g, &s, q, CSTK_CLASS_INSIDE, 0.0, CSTK_CLASS_OUTSIDE, 0.0);
    s.kind = BOX;
    for (int i = 0; i < NQ; ++i) {
        s.low[i] = -INFINITY;
        s.high[i] = INFINITY;
    }
    /* All there is: nothing is left for the complement. */
    expect_both(g, &s, q, CSTK_CLASS_INSIDE, 0.0, CSTK_CLASS_OUTSIDE, INFINITY);
    s.low[WHEEL] = 1.0;
    s.high[WHEEL] = 8.0;
    expect_both(g, &s, q, CSTK_CLASS_INSIDE, 0.0, CSTK_CLASS_OUTSIDE, INFINITY);
    s.low[RAIL] = s.high[RAIL] = 2.0;
    expect_both(g, &s, q, CSTK_CLASS_INSIDE, 0.0, CSTK_CLASS_OUTSIDE, 0.0);
    s.kind = ROUND;
    memcpy(s.center, q, sizeof q);
    s.radius = 0.0;
    expect_both(g, &s, q, CSTK_CLASS_INSIDE, 0.0, CSTK_CLASS_OUTSIDE, 0.0);
    s.kind = LIMITS;
    q[HINGE] = 0.5;
    expect_both(g, &s, q, CSTK_CLASS_OUTSIDE, 0.0, CSTK_CLASS_INSIDE, 0.0);
    s.options.contact_epsilon = 1e-300;
    expect_both(g, &s, q, CSTK_CLASS_CONTACT, 0.0, CSTK_CLASS_CONTACT, 0.0);
    q[RAIL] = 1.5;
    expect_both(g, &s, q, CSTK_CLASS_OUTSIDE, 0.5, CSTK_CLASS_INSIDE, 0.0);
    q[RAIL] = 2.5;
    expect_both(g, &s, q, CSTK_CLASS_INSIDE, 0.0, CSTK_CLASS_OUTSIDE, 0.5);
}

/* Without limits, and without a world box, nothing is beyond them. */
static void without_limits(void) {
    double q[4];
    const cstk_link_def def = link_of(CSTK_JOINT_SPHERICAL);
    cstk_robot *robot = make_robot(&def);
    cstk_query *query = NULL;
    cstk_space *space = space_of(robot, NULL, 0);
    cstk_cobject *sets[4] = {NULL};
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_space_get_neutral(space, q));
    CHECK_OK(cstk_cobject_beyond_limits(space, NULL, &sets[0]));
    CHECK_OK(cstk_cobject_beyond_world(space, NULL, &sets[1]));
    for (int i = 0; i < 4; ++i) {
        cstk_class point_class;
        cstk_distance_result d;
        cstk_witness_list list;
        if (i >= 2) {
            CHECK_OK(cstk_cobject_complement(sets[i - 2], &sets[i]));
        }
        CHECK_OK(cstk_classify(query, sets[i], q, 4, &point_class));
        CHECK_OK(cstk_distance(query, sets[i], q, 4, INFINITY, &d));
        CHECK_OK(cstk_gradients(query, sets[i], q, 4, INFINITY, 16, &list));
        CHECK(point_class == (i < 2 ? CSTK_CLASS_OUTSIDE : CSTK_CLASS_INSIDE));
        CHECK(d.kind == (i < 2 ? CSTK_DISTANCE_EMPTY : CSTK_DISTANCE_EXACT));
        CHECK(d.distance == (i < 2 ? INFINITY : 0.0) && d.has_witness == (i >= 2));
        CHECK(list.witness_count == (i < 2 ? 0 : 1) && list.contact_count == 0);
    }
    for (int i = 0; i < 4; ++i) {
        CHECK_OK(cstk_cobject_release(sets[i]));
    }
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_robot_release(robot));
}

int main(void) {
    const ground g = make_ground();
    closed_forms(&g);
    boundaries(&g);
    without_limits();
    ground_release(&g);
    return check_result();
}
