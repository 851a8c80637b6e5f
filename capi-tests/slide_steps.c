/* The two halves of a slide, of lists of contacts. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

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
    cstk_induced_options options;
    cstk_link_def def = link_of(CSTK_JOINT_FREE);
    def.body = cube;
    cstk_robot *robot = make_robot(&def);
    CHECK_OK(cstk_environment_create(&environment));
    add_object(environment, floor, 0.0, 0.0, -0.5);
    CHECK_OK(cstk_induced_options_default(&options, sizeof options));
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

int main(void) {
    steps_of_lists();
    spring_between();
    return check_result();
}
