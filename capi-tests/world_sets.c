/* The set beyond the world box, against closed forms of the links' origins, at configurations and
 * at link poses. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

enum { NQ = FIXTURE_NQ, LINKS = FIXTURE_LINKS };

/* The fixture's arm turns about z; the box is not in its plane's middle. */
static const double world_box[6] = {-1.2, -1.6, -1.0, 1.7, 1.4, 3.0};

typedef struct ground {
    fixture f;
    cstk_space *space;
    cstk_cobject *beyond;
    cstk_cobject *within;
    uint64_t number;
} ground;

static void ground_create(ground *g, const cstk_pure_options *options) {
    fixture_create(&g->f);
    const cstk_robot *robot = g->f.robot;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, world_box, &g->space));
    CHECK_OK(cstk_cobject_beyond_world(g->space, options, &g->beyond));
    CHECK_OK(cstk_cobject_complement(g->beyond, &g->within));
    CHECK_OK(cstk_cobject_get_data(g->beyond, NULL, &g->number));
}

static void ground_release(ground *g) {
    CHECK_OK(cstk_cobject_release(g->within));
    CHECK_OK(cstk_cobject_release(g->beyond));
    CHECK_OK(cstk_space_release(g->space));
    fixture_release(&g->f);
}

/* How far all origins are within the box, or minus how far the farthest of them is outside. */
static double clearance(const ground *g, const double *q) {
    double poses[12 * LINKS];
    double least = INFINITY;
    CHECK_OK(cstk_space_link_poses(g->space, q, NQ, poses));
    for (int link = 0; link < LINKS; ++link) {
        double clear = INFINITY;
        double out[3];
        for (int i = 0; i < 3; ++i) {
            const double x = poses[12 * link + 4 * i + 3];
            clear = fmin(clear, fmin(x - world_box[i], world_box[3 + i] - x));
            out[i] = fmax(0.0, fmax(world_box[i] - x, x - world_box[3 + i]));
        }
        const double beyond = length_of(out, 3);
        least = fmin(least, beyond > 0.0 ? -beyond : clear);
    }
    return least;
}

/* The derivative by central differences; false where it has a kink. */
static bool slope(const ground *g, const double *q, int k, double *out) {
    const double h = 1e-6;
    double v[NQ] = {0};
    double there[2][NQ];
    for (int side = 0; side < 2; ++side) {
        v[k] = side == 0 ? -h : h;
        CHECK_OK(cstk_space_step(g->space, q, NQ, v, NQ, there[side]));
    }
    const double before = clearance(g, there[0]);
    const double after = clearance(g, there[1]);
    *out = (after - before) / (2.0 * h);
    return fabs(after - 2.0 * clearance(g, q) + before) < 1e-3 * h;
}

static void check_class(const ground *g, const double *q, double epsilon) {
    cstk_class classes[4];
    double poses[12 * LINKS];
    const double clear = clearance(g, q);
    const cstk_class expected = clear < 0.0        ? CSTK_CLASS_INSIDE
                                : clear <= epsilon ? CSTK_CLASS_CONTACT
                                                   : CSTK_CLASS_OUTSIDE;
    CHECK_OK(cstk_space_link_poses(g->space, q, NQ, poses));
    CHECK_OK(cstk_classify(g->f.query, g->beyond, q, NQ, &classes[0]));
    CHECK_OK(cstk_classify_at_link_poses(g->f.query, g->beyond, poses, LINKS, &classes[1]));
    CHECK_OK(cstk_classify(g->f.query, g->within, q, NQ, &classes[2]));
    CHECK_OK(cstk_classify_at_link_poses(g->f.query, g->within, poses, LINKS, &classes[3]));
    for (int i = 0; i < 2; ++i) {
        CHECK(classes[i] == expected && classes[2 + i] == CSTK_CLASS_INSIDE - expected);
    }
}

/* Within the box the distance is exact; outside it is 0, and its complement's is not known. */
static void check_distance(const ground *g, const double *q) {
    cstk_distance_result d;
    cstk_distance_result at;
    double poses[12 * LINKS];
    bool within[2];
    const double clear = clearance(g, q);
    CHECK_OK(cstk_space_link_poses(g->space, q, NQ, poses));
    CHECK_OK(cstk_distance(g->f.query, g->beyond, q, NQ, INFINITY, &d));
    CHECK_OK(cstk_distance_at_link_poses(g->f.query, g->beyond, poses, LINKS, INFINITY, &at));
    CHECK(d.kind == CSTK_DISTANCE_EXACT && fabs(d.distance - fmax(0.0, clear)) < 1e-14);
    CHECK(d.lower <= d.distance && d.distance <= d.upper && d.has_witness);
    CHECK(d.has_contact == (clear > 0.0) && d.witness.overlapping == false);
    CHECK(at.distance == d.distance && at.lower == d.lower && at.upper == d.upper);
    const double thresholds[] = {0.9 * d.distance, 1.1 * d.distance};
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_within(g->f.query, g->beyond, q, NQ, thresholds[i], &within[0]));
        CHECK_OK(cstk_within_at_link_poses(g->f.query, g->beyond, poses, LINKS, thresholds[i], &within[1]));
        CHECK(within[0] == within[1] && within[0] == (clear < 0.0 || i == 1));
    }
    CHECK_OK(cstk_distance(g->f.query, g->within, q, NQ, INFINITY, &d));
    CHECK(d.kind == (clear > 0.0 ? CSTK_DISTANCE_EXACT : CSTK_DISTANCE_LOWER_BOUND));
    CHECK(d.distance == 0.0 && d.lower == 0.0 && (clear > 0.0 || d.upper == INFINITY));
}

/* The contact is where the nearest link's origin faces the wall. Returns how many entries of the
 * row were compared. */
static int check_contact(const ground *g, const double *q) {
    cstk_witness_list list;
    int compared = 0;
    const double clear = clearance(g, q);
    if (clear < 0.0) {
        CHECK_OK(cstk_gradients(g->f.query, g->beyond, q, NQ, 0.0, 16, &list));
        CHECK(list.witness_count == 1 && list.witnesses[0].overlapping);
        CHECK(list.contact_count == 0 && list.witnesses[0].distance == 0.0);
        return 0;
    }
    CHECK_OK(cstk_gradients(g->f.query, g->beyond, q, NQ, 0.9 * clear, 16, &list));
    CHECK(list.witness_count == 0);
    CHECK_OK(cstk_gradients(g->f.query, g->beyond, q, NQ, 1.1 * clear, 16, &list));
    CHECK(list.witness_count == 1 && list.contact_count == 1 && list.nv == NQ);
    CHECK(list.witnesses[0].cobject == g->number && !list.witnesses[0].overlapping);
    const cstk_contact *c = list.contacts;
    double apart[3];
    for (int i = 0; i < 3; ++i) {
        apart[i] = c->r_point[i] - c->s_point[i];
        CHECK(fabs(apart[i] - clear * c->normal[i]) < 1e-14);
    }
    CHECK(c->mode == CSTK_MODE_PURE_SET && fabs(c->clearance - clear) < 1e-14);
    CHECK(fabs(length_of(c->normal, 3) - 1.0) < 1e-14);
    for (int k = 0; k < NQ; ++k) {
        double expected;
        if (slope(g, q, k, &expected)) {
            CHECK(fabs(list.gradients[k] - expected) < 1e-7);
            ++compared;
        }
    }
    return compared;
}

static void closed_forms(const cstk_pure_options *options, double epsilon) {
    ground g;
    int outside = 0;
    int compared = 0;
    uint64_t state = 7;
    ground_create(&g, options);
    for (int i = 0; i < 200; ++i) {
        double q[NQ];
        for (int k = 0; k < NQ; ++k) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            q[k] = 3.1 * ((double)(state >> 11) / 4503599627370496.0 - 1.0);
        }
        outside += clearance(&g, q) < 0.0;
        check_class(&g, q, epsilon);
        check_distance(&g, q);
        compared += check_contact(&g, q);
    }
    CHECK(20 < outside && outside < 180 && compared > 2 * (200 - outside));
    ground_release(&g);
}

/* At the wall the robot is not out yet. */
static void at_the_wall(void) {
    ground g;
    const double box[6] = {-2.0, -1.0, -1.0, 2.0, 1.0, 1.0};
    const double q[NQ] = {0.0, 0.0, 0.0};
    cstk_cobject *beyond = NULL;
    cstk_space *space = NULL;
    cstk_class point_class;
    cstk_distance_result d;
    ground_create(&g, NULL);
    const cstk_robot *robot = g.f.robot;
    CHECK_OK(cstk_space_create(&robot, 1, NULL, 0, box, &space));
    CHECK_OK(cstk_cobject_beyond_world(space, NULL, &beyond));
    CHECK_OK(cstk_classify(g.f.query, beyond, q, NQ, &point_class));
    CHECK_OK(cstk_distance(g.f.query, beyond, q, NQ, INFINITY, &d));
    CHECK(point_class == CSTK_CLASS_OUTSIDE && d.kind == CSTK_DISTANCE_EXACT && d.distance == 0.0);
    CHECK_OK(cstk_cobject_release(beyond));
    CHECK_OK(cstk_space_release(space));
    ground_release(&g);
}

/* The contact is placed in all answers alike. */
static void placed_everywhere(void) {
    ground g;
    const double q[NQ] = {0.2, 1.2, 0.0};
    cstk_distance_result d;
    cstk_witness_list list;
    ground_create(&g, NULL);
    CHECK_OK(cstk_gradients(g.f.query, g.beyond, q, NQ, 10.0, 16, &list));
    const cstk_contact expected = list.contacts[0];
    CHECK(length_of(expected.normal, 3) > 0.9);
    CHECK_OK(cstk_distance(g.f.query, g.beyond, q, NQ, INFINITY, &d));
    CHECK_OK(cstk_witnesses(g.f.query, g.beyond, q, NQ, 10.0, 16, &list));
    const cstk_contact found[2] = {d.contact, list.contacts[0]};
    for (int i = 0; i < 2; ++i) {
        if (!near(found[i].normal, expected.normal, 3, 0.0) ||
            !near(found[i].r_point, expected.r_point, 3, 0.0) ||
            !near(found[i].s_point, expected.s_point, 3, 0.0)) {
            fprintf(stderr, "%s: the contact is not placed\n", i == 0 ? "distance" : "witnesses");
            ++check_failures;
        }
    }
    ground_release(&g);
}

/* In the plane z does not count, whatever the box says of it. */
static void planar(void) {
    const double boxes[3][6] = {
        {-5, -5, 0, 5, 5, 0}, {-5, -5, -1, 5, 5, 1}, {-5, -5, -INFINITY, 5, 5, INFINITY}};
    const double q[3] = {1.0, 0.5, 0.3};
    const cstk_link_def def = link_of(CSTK_JOINT_PLANAR);
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    cstk_query *query = NULL;
    CHECK_OK(cstk_robot_builder_create(2, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_query_create(&query));
    const cstk_robot *robots[1] = {robot};
    for (int i = 0; i < 3; ++i) {
        cstk_space *space = NULL;
        cstk_cobject *beyond = NULL;
        cstk_distance_result d;
        CHECK_OK(cstk_space_create(robots, 1, NULL, 0, boxes[i], &space));
        CHECK_OK(cstk_cobject_beyond_world(space, NULL, &beyond));
        CHECK_OK(cstk_distance(query, beyond, q, 3, INFINITY, &d));
        if (fabs(d.distance - 4.0) > 1e-14) {
            fprintf(stderr, "planar box %d: distance %g, not 4\n", i, d.distance);
            ++check_failures;
        }
        CHECK_OK(cstk_cobject_release(beyond));
        CHECK_OK(cstk_space_release(space));
    }
    CHECK_OK(cstk_query_release(query));
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(builder));
}

int main(void) {
    cstk_pure_options options;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    closed_forms(NULL, 0.0);
    options.contact_epsilon = 0.2;
    closed_forms(&options, 0.2);
    /* It measures in lengths, whatever the scale. */
    options.contact_epsilon = 0.0;
    options.scale = 3.0;
    closed_forms(&options, 0.0);
    at_the_wall();
    placed_everywhere();
    planar();
    return check_result();
}
