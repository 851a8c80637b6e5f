/* A whole motion proved, where sampling sees nothing: an arm of two links sweeps past a thin plate.
 *
 *   cc motion.c motion_picture.c svg.c $(pkg-config --cflags --libs cstk) -lm -o motion && ./motion motion.svg
 *
 * With the name of a file it draws the sweep.
 */
#include "motion_picture.h"

#include <cstk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Where the plate stands, in radians: between two samples. */
#define PLATE_ANGLE 0.475

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

/* A box about a point of its own frame. */
static cstk_body *box(double x, double y, double z, double half_x, double half_y, double half_z) {
    const double pose[12] = {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z};
    const double half_extents[3] = {half_x, half_y, half_z};
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    check(cstk_body_builder_create(3, &builder));
    check(cstk_body_builder_add_box(builder, pose, half_extents, 0));
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

/* Two links of a metre that turn about z. */
static cstk_space *arm(void) {
    cstk_robot_builder *builder = NULL;
    cstk_body *link = box(0.5, 0, 0, 0.5, 0.03, 0.03);
    check(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < 2; ++i) {
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        def.parent = i - 1;
        def.joint = CSTK_JOINT_REVOLUTE;
        def.axis[0] = def.axis[1] = 0;
        def.axis[2] = 1;
        def.at[3] = i;
        def.body = link;
        check(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    cstk_robot *robot = NULL;
    cstk_space *space = NULL;
    check(cstk_robot_build(builder, &robot));
    const cstk_robot *robots[1] = {robot};
    check(cstk_space_create(robots, 1, NULL, 0, NULL, &space));
    check(cstk_robot_release(robot));
    check(cstk_robot_builder_release(builder));
    check(cstk_body_release(link));
    return space;
}

/* An obstacle that reaches a little into the circle that the arm's tip sweeps: 2 mm thick, on a radius. */
static cstk_environment *plate(double angle) {
    cstk_environment *environment = NULL;
    cstk_environment_change add;
    cstk_body *body = box(2.09, 0, 0, 0.1, 0.001, 0.2);
    check(cstk_environment_create(&environment));
    check(cstk_environment_change_default(&add, sizeof add));
    add.kind = CSTK_CHANGE_ADD;
    add.body = body;
    add.pose[0] = add.pose[5] = cos(angle);
    add.pose[1] = -sin(angle);
    add.pose[4] = sin(angle);
    check(cstk_environment_apply(environment, &add, 1, NULL, NULL));
    check(cstk_body_release(body));
    return environment;
}

int main(int count, char **arguments) {
    cstk_space *space = arm();
    cstk_environment *environment = plate(PLATE_ANGLE);
    cstk_cobject *obstacles = NULL;
    cstk_query *query = NULL;
    check(cstk_cobject_induced(space, NULL, 0, environment, NULL, 0, NULL, &obstacles));
    check(cstk_query_create(&query));

    const double from[2] = {0, 0}, to[2] = {1, 0};
    int inside = 0;
    for (int i = 0; i <= 20; ++i) {
        double q[2];
        cstk_class place;
        check(cstk_space_interpolate(space, from, to, 2, i / 20.0, q));
        check(cstk_classify(query, obstacles, q, 2, &place));
        inside += place == CSTK_CLASS_INSIDE;
    }
    printf("sampled every 0.05 rad: %d of 21 inside\n", inside);

    cstk_motion_result found;
    double contact[2];
    check(cstk_motion(query, obstacles, from, to, 2, NULL, contact, &found));
    const int hits = found.outcome == CSTK_MOTION_HIT;
    if (hits) {
        const cstk_witness *witness = &found.distance.witness;
        printf("the whole motion: link %u meets object %llu at %.4f of the way\n",
               (unsigned)witness->r_link, (unsigned long long)witness->s_object, found.times[1]);
        if (count > 1) {
            const motion_picture picture = {
                space, from, to, 20, contact, {0.5, 0.03}, PLATE_ANGLE, 2.09, {0.1, 0.001},
            };
            if (!draw_motion(&picture, arguments[1])) {
                fprintf(stderr, "%s could not be written\n", arguments[1]);
                return 1;
            }
        }
    }
    /* Folded a little, the arm passes. */
    const double folded_from[2] = {-0.3, 0.6}, folded_to[2] = {0.7, 0.6};
    check(cstk_motion(query, obstacles, folded_from, folded_to, 2, NULL, NULL, &found));
    const int passes = found.outcome == CSTK_MOTION_FREE;
    printf("folded: %s\n", passes ? "proved free" : "not free");

    check(cstk_query_release(query));
    check(cstk_cobject_release(obstacles));
    check(cstk_environment_release(environment));
    check(cstk_space_release(space));
    return hits && passes ? 0 : 1;
}
