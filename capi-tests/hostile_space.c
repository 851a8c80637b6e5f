/* Hostile input to spaces. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void create_ranges(const fixture *f) {
    cstk_space *out;
    const cstk_robot *robot = f->robot;
    const cstk_range circle = {CSTK_RANGE_CIRCLE, 0, 0, 0};
    const struct {
        cstk_range range;
        cstk_status status;
    } wrong[] = {
        {{-1, 0, 0, 1}, CSTK_ERROR_INVALID_ARGUMENT},
        {{CSTK_RANGE_QUATERNION + 1, 0, 0, 1}, CSTK_ERROR_INVALID_ARGUMENT},
        {{INT32_MIN, 0, 0, 1}, CSTK_ERROR_INVALID_ARGUMENT},
        {{INT32_MAX, 0, 0, 1}, CSTK_ERROR_INVALID_ARGUMENT},
        {{CSTK_RANGE_QUATERNION, 0, 0, 1}, CSTK_ERROR_INVALID_ARGUMENT},
        {{CSTK_RANGE_INTERVAL, 0, NAN, 1}, CSTK_ERROR_NOT_FINITE},
        {{CSTK_RANGE_INTERVAL, 0, 0, NAN}, CSTK_ERROR_NOT_FINITE},
        {{CSTK_RANGE_INTERVAL, 0, 1, 0}, CSTK_ERROR_INVALID_ARGUMENT},
        {{CSTK_RANGE_INTERVAL, 0, INFINITY, INFINITY}, CSTK_ERROR_INVALID_ARGUMENT},
        {{CSTK_RANGE_INTERVAL, 0, -INFINITY, -INFINITY}, CSTK_ERROR_INVALID_ARGUMENT},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        const cstk_range ranges[FIXTURE_NQ] = {circle, wrong[i].range, circle};
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, ranges, FIXTURE_NQ, NULL, &out),
                      wrong[i].status, "range");
        CHECK(strstr(cstk_last_error_message(), "1") != NULL);
    }
    const cstk_range ranges[FIXTURE_NQ + 1] = {circle, circle, circle, circle};
    CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, FIXTURE_NQ, NULL, &out),
                  CSTK_ERROR_NULL_ARGUMENT, "ranges");
    const size_t counts[] = {1, FIXTURE_NQ - 1, FIXTURE_NQ + 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, ranges, counts[i], NULL, &out),
                      CSTK_ERROR_WRONG_SIZE, "ranges");
    }
    fixture_unchanged(f);
}

/* Ranges that the joint of the coordinate does not allow. */
static void create_ranges_of_joints(const fixture *f) {
    cstk_space *out;
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *made = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = CSTK_JOINT_PRISMATIC;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.joint = CSTK_JOINT_REVOLUTE;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    /* Half a turn of this one, where the last makes a whole one. */
    def.coordinate = 1;
    def.multiplier = 0.5;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.coordinate = -1;
    def.joint = CSTK_JOINT_SPHERICAL;
    /* A turn by three angles has no multiple. */
    CHECK_FAILS(cstk_robot_builder_add_link(builder, &def, NULL), CSTK_ERROR_INVALID_ARGUMENT,
                "multiplier");
    def.multiplier = 1.0;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &made));
    const cstk_robot *robot = made;
    const cstk_range interval = {CSTK_RANGE_INTERVAL, 0, -1, 1};
    const cstk_range circle = {CSTK_RANGE_CIRCLE, 0, 0, 0};
    const struct {
        int coordinate;
        cstk_range range;
        const char *culprit;
    } wrong[] = {
        {0, circle, "range 0"},   {1, circle, "range 1"}, {2, circle, "range 2"},
        {2, interval, "range 2"}, {5, circle, "range 5"}, {5, interval, "range 5"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_range ranges[6];
        for (int k = 0; k < 6; ++k) {
            ranges[k] = (cstk_range){CSTK_RANGE_DEFAULT, 0, 0, 0};
        }
        ranges[wrong[i].coordinate] = wrong[i].range;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, ranges, 6, NULL, &out),
                      CSTK_ERROR_INVALID_ARGUMENT, wrong[i].culprit);
    }
    CHECK_OK(cstk_robot_release(made));
    CHECK_OK(cstk_robot_builder_release(builder));
    fixture_unchanged(f);
}

static void create(const fixture *f) {
    cstk_space *out;
    const cstk_robot *robot = f->robot;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        const cstk_robot *robots[2] = {robot, bad->handle};
        CHECK_REFUSED(out, cstk_space_create(robots, 2, NULL, 0, NULL, &out), bad->status,
                      "robots[1]");
    }
    CHECK_REFUSED(out, cstk_space_create(NULL, 1, NULL, 0, NULL, &out), CSTK_ERROR_NULL_ARGUMENT,
                  "robots");
    CHECK_FAILS(cstk_space_create(&robot, 1, NULL, 0, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_space_create(&robot, 0, NULL, 0, NULL, &out), CSTK_ERROR_EMPTY, "robot");
    CHECK_REFUSED(out, cstk_space_create(NULL, 0, NULL, 0, NULL, &out), CSTK_ERROR_EMPTY, "robot");
    CHECK_REFUSED(out, cstk_space_create(&robot, SIZE_MAX, NULL, 0, NULL, &out), CSTK_ERROR_WRONG_SIZE,
                  "robots");
    for (int entry = 0; entry < 6; ++entry) {
        double box[6] = {-1, -1, -1, 1, 1, 1};
        box[entry] = NAN;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, 0, box, &out), CSTK_ERROR_NOT_FINITE,
                      "box");
        box[entry] = entry < 3 ? 2.0 : -2.0;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, 0, box, &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "box");
        /* An end at infinity is none, but on the wrong side it shuts everything out. */
        box[entry] = entry < 3 ? INFINITY : -INFINITY;
        CHECK_REFUSED(out, cstk_space_create(&robot, 1, NULL, 0, box, &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "box");
    }
    fixture_unchanged(f);
}

/* A robot of the plane does not fit a spatial one. */
static void two_dimensions(const fixture *f) {
    cstk_space *out;
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *planar = NULL;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    CHECK_OK(cstk_robot_builder_create(2, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &planar));
    const cstk_robot *robots[2] = {f->robot, planar};
    CHECK_REFUSED(out, cstk_space_create(robots, 2, NULL, 0, NULL, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "robots");
    CHECK_OK(cstk_robot_release(planar));
    CHECK_OK(cstk_robot_builder_release(builder));
}

static void references(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_FAILS(cstk_space_retain(bad->handle), bad->status, "space");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_space_release(bad->handle), bad->status, "space");
        }
    }
    fixture_unchanged(f);
}

static void sizes(const fixture *f) {
    size_t out[3];
    cstk_space_offset offset;
    cstk_range range;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_space_get_size(bad->handle, &out[0], &out[1], &out[2]), bad->status,
                      "space");
        CHECK_REFUSED(offset, cstk_space_get_offset(bad->handle, 0, &offset), bad->status, "space");
        CHECK_REFUSED(range, cstk_space_get_range(bad->handle, 0, &range), bad->status, "space");
    }
    CHECK_OK(cstk_space_get_size(f->space, NULL, NULL, NULL));
    CHECK_FAILS(cstk_space_get_offset(f->space, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_space_get_range(f->space, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    const size_t robots[] = {1, (size_t)UINT32_MAX + 1, SIZE_MAX};
    const size_t coordinates[] = {FIXTURE_NQ, (size_t)UINT32_MAX + 1, SIZE_MAX};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(offset, cstk_space_get_offset(f->space, robots[i], &offset), CSTK_ERROR_NOT_FOUND,
                      "robot");
        CHECK_REFUSED(range, cstk_space_get_range(f->space, coordinates[i], &range), CSTK_ERROR_NOT_FOUND,
                      "coordinate");
    }
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    create_ranges(&f);
    create_ranges_of_joints(&f);
    create(&f);
    two_dimensions(&f);
    references(&f);
    sizes(&f);
    fixture_release(&f);
    return check_result();
}
