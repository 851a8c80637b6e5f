/* Slides look at each pair for itself: bodies that one joint carries along are not in the way, a base
 * that creeps over a floor does not hold its arm, and sets have shells of their own. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

enum { NQ = 2 };

static cstk_slide_options options_with(double max_shell) {
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = max_shell;
    return options;
}

/* A space of two links with the same body, each moved by a joint of this kind; the second is carried
 * by the first, and sits at x of it. */
static cstk_space *two_links(cstk_body *body, const int32_t kinds[NQ], double x) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int32_t i = 0; i < NQ; ++i) {
        cstk_link_def def = link_of(kinds[i]);
        def.body = body;
        def.parent = i - 1;
        if (kinds[i] == CSTK_JOINT_PRISMATIC) {
            def.axis[0] = 1.0;
            def.axis[1] = def.axis[2] = 0.0;
        }
        translation(i == 0 ? 3.0 : x, 0.0, 0.0, def.at);
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    cstk_space *space = space_of(robot, NULL, 0);
    CHECK_OK(cstk_robot_release(robot));
    return space;
}

static cstk_slide_result slide(const cstk_cobject *set, double q[NQ], const double step[NQ],
                               const cstk_slide_options *options) {
    cstk_query *query = NULL;
    cstk_slide_result result;
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_slide(query, set, q, NQ, step, NQ, options, q, &result));
    CHECK_OK(cstk_query_release(query));
    return result;
}

/* Only the base turns, by 2 rad, two bodies that are .014 apart: farther and nearer than the shell. */
static void carried_pair(void) {
    const int32_t kinds[NQ] = {CSTK_JOINT_REVOLUTE, CSTK_JOINT_PRISMATIC};
    const double shells[] = {0.001, 0.1};
    cstk_body *box = make_box(0.5, 1.5, 0.5);
    cstk_space *space = two_links(box, kinds, 1.014);
    const uint32_t pair[2] = {0, 1};
    cstk_cobject *set = NULL;
    CHECK_OK(cstk_cobject_induced_links(space, pair, 1, NULL, &set));
    for (size_t i = 0; i < sizeof shells / sizeof shells[0]; ++i) {
        const cstk_slide_options options = options_with(shells[i]);
        const double step[NQ] = {2.0, 0.0};
        double q[NQ] = {0.0, 0.0};
        const cstk_slide_result result = slide(set, q, step, &options);
        CHECK(result.outcome == CSTK_SLIDE_MOVED && near(q, step, NQ, 0.0));
        CHECK((result.contact_count > 0) == (shells[i] > 0.014));
        CHECK(fabs(result.distance_after - 0.014) < 1e-12);
    }
    CHECK_OK(cstk_cobject_release(set));
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_body_release(box));
}

/* The first link creeps over a floor at a height, the second turns high above it. */
static void creeping_base(void) {
    const int32_t kinds[NQ] = {CSTK_JOINT_PRISMATIC, CSTK_JOINT_REVOLUTE};
    const double heights[] = {0.0, 1e-7, 1e-6, 1e-4};
    cstk_body *box = make_box(0.5, 0.5, 0.5);
    cstk_body *plate = make_box(10.0, 10.0, 0.5);
    cstk_space *space = two_links(box, kinds, 2.0);
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; ++i) {
        const cstk_slide_options options = options_with(0.1);
        const uint32_t base = 0, arm = 1;
        const double step[NQ] = {1e-6, 0.5};
        double q[NQ] = {0.0, 0.0};
        cstk_environment *below = NULL;
        cstk_environment *aside = NULL;
        cstk_cobject *parts[2] = {NULL, NULL};
        cstk_cobject *all = NULL;
        CHECK_OK(cstk_environment_create(&below));
        CHECK_OK(cstk_environment_create(&aside));
        add_object(below, plate, 0.0, 0.0, -1.0 - heights[i]);
        add_object(aside, box, 0.0, 4.0, 0.0);
        CHECK_OK(cstk_cobject_induced(space, &base, 1, below, NULL, 0, NULL, &parts[0]));
        CHECK_OK(cstk_cobject_induced(space, &arm, 1, aside, NULL, 0, NULL, &parts[1]));
        CHECK_OK(cstk_cobject_union((const cstk_cobject *const *)parts, 2, &all));
        const cstk_slide_result result = slide(all, q, step, &options);
        CHECK(result.outcome == CSTK_SLIDE_MOVED && near(q, step, NQ, 0.0));
        CHECK_OK(cstk_cobject_release(all));
        CHECK_OK(cstk_cobject_release(parts[0]));
        CHECK_OK(cstk_cobject_release(parts[1]));
        CHECK_OK(cstk_environment_release(below));
        CHECK_OK(cstk_environment_release(aside));
    }
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_body_release(plate));
    CHECK_OK(cstk_body_release(box));
}

/* A cube slides towards a wall and stays at a tenth of the shell: that of the options, or its own. */
static void own_shells(void) {
    const int32_t kinds[NQ] = {CSTK_JOINT_PRISMATIC, CSTK_JOINT_PRISMATIC};
    const double shells[] = {0.0, 0.05, 1.0};
    const cstk_slide_options options = options_with(0.2);
    cstk_body *box = make_box(0.5, 0.5, 0.5);
    cstk_space *space = two_links(box, kinds, 10.0);
    const uint32_t link = 0;
    cstk_environment *environment = NULL;
    cstk_cobject *set = NULL;
    CHECK_OK(cstk_environment_create(&environment));
    add_object(environment, box, 5.0, 0.0, 0.0);
    CHECK_OK(cstk_cobject_induced(space, &link, 1, environment, NULL, 0, NULL, &set));
    for (size_t i = 0; i < sizeof shells / sizeof shells[0]; ++i) {
        const double shell = shells[i] > 0.0 ? shells[i] : options.max_shell;
        const double step[NQ] = {0.03, 0.0};
        double q[NQ] = {0.0, 0.0};
        cstk_cobject *shelled = set;
        cstk_slide_result result;
        if (shells[i] > 0.0) {
            CHECK_OK(cstk_cobject_with_shell(set, shells[i], &shelled));
        }
        int steps = 0;
        do {
            const double before = 1.0 - q[0];
            result = slide(shelled, q, step, &options);
            CHECK(fabs(result.distance_before - before) < 1e-12);
            CHECK((result.contact_count > 0) == (before <= shell));
        } while (result.outcome == CSTK_SLIDE_MOVED && ++steps < 200);
        CHECK(result.outcome == CSTK_SLIDE_BLOCKED && steps > 20);
        CHECK(fabs(result.distance_after - 0.1 * shell) < 1e-2 * shell);
        if (shells[i] > 0.0) {
            CHECK_OK(cstk_cobject_release(shelled));
        }
    }
    CHECK_OK(cstk_cobject_release(set));
    CHECK_OK(cstk_environment_release(environment));
    CHECK_OK(cstk_space_release(space));
    CHECK_OK(cstk_body_release(box));
}

int main(void) {
    carried_pair();
    creeping_base();
    own_shells();
    return check_result();
}
