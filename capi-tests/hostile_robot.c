/* Hostile input to robots and their builders. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void builder_create(const fixture *f) {
    cstk_robot_builder *out;
    const uint32_t wrong[] = {0, 1, 4, UINT32_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_REFUSED(out, cstk_robot_builder_create(wrong[i], &out), CSTK_INVALID_ARGUMENT,
                      "dimension");
    }
    CHECK_FAILS(cstk_robot_builder_create(3, NULL), CSTK_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

static void references(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_FAILS(cstk_robot_builder_retain(bad->handle), bad->status, "builder");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_robot_builder_release(bad->handle), bad->status, "builder");
        }
    }
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_FAILS(cstk_robot_retain(bad->handle), bad->status, "robot");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_robot_release(bad->handle), bad->status, "robot");
        }
    }
    fixture_unchanged(f);
}

static cstk_link_def good_link(const fixture *f) {
    cstk_link_def def;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.body = f->body;
    def.parent = FIXTURE_TIP;
    def.joint = CSTK_JOINT_REVOLUTE;
    return def;
}

static void refuse_link(const fixture *f, const cstk_link_def *def, cstk_status status,
                        const char *culprit) {
    uint32_t out;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(f->robot_builder, def, &out), status, culprit);
}

static void add_link_handles(const fixture *f) {
    uint32_t out;
    cstk_link_def def = good_link(f);
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(out, cstk_robot_builder_add_link(bad->handle, &def, &out), bad->status,
                      "builder");
    }
    refuse_link(f, NULL, CSTK_NULL_ARGUMENT, "def");
    EACH_BAD_OPTIONS(def, bad) { refuse_link(f, bad->options, bad->status, "def"); }
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        /* NULL is no body, and welcome. */
        if (bad->handle != NULL) {
            def.body = bad->handle;
            refuse_link(f, &def, bad->status, "def->body");
        }
    }
    fixture_unchanged(f);
}

static void add_link_numbers(const fixture *f) {
    const int32_t joints[] = {-1, 3, INT32_MIN, INT32_MAX};
    const int32_t negative[] = {-2, INT32_MIN};
    cstk_link_def def = good_link(f);
    for (int i = 0; i < 4; ++i) {
        def.joint = joints[i];
        refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "joint");
    }
    for (int i = 0; i < 2; ++i) {
        def = good_link(f);
        def.parent = negative[i];
        refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "parent");
        def = good_link(f);
        def.coordinate = negative[i];
        refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "coordinate");
    }
    def = good_link(f);
    def.parent = FIXTURE_LINKS; /* itself */
    refuse_link(f, &def, CSTK_NOT_FOUND, "parent");
    def.parent = INT32_MAX;
    refuse_link(f, &def, CSTK_NOT_FOUND, "parent");
    def = good_link(f);
    def.coordinate = FIXTURE_NQ + 1; /* would leave a gap */
    refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "coordinate");
    def.coordinate = INT32_MAX;
    refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "coordinate");
    def = good_link(f);
    def.name = "link1"; /* the default name of another link */
    refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "name");
    def.name = "\xff\xfe";
    refuse_link(f, &def, CSTK_INVALID_ARGUMENT, "name");
    fixture_unchanged(f);
}

static void add_link_geometry(const fixture *f) {
    cstk_link_def def = good_link(f);
    EACH_BAD_POSE(bad) {
        memcpy(def.at, bad->pose, sizeof def.at);
        refuse_link(f, &def, bad->status, "def->at");
    }
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            def = good_link(f);
            def.axis[entry] = not_finite[i];
            refuse_link(f, &def, CSTK_NOT_FINITE, "axis");
        }
    }
    def = good_link(f);
    def.axis[2] = 0.0;
    refuse_link(f, &def, CSTK_DEGENERATE, "axis");
    fixture_unchanged(f);
}

/* Only what keeps the plane fits a planar robot. */
static void planar_links(const fixture *f) {
    uint32_t out;
    cstk_robot_builder *builder = NULL;
    cstk_link_def def;
    CHECK_OK(cstk_robot_builder_create(2, &builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = CSTK_JOINT_REVOLUTE;
    def.axis[0] = 1.0;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_INVALID_ARGUMENT,
                  "turn");
    def.joint = CSTK_JOINT_PRISMATIC;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_INVALID_ARGUMENT,
                  "shift");
    def.axis[2] = 0.0;
    def.at[11] = 0.1;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_INVALID_ARGUMENT,
                  "plane");
    def.at[11] = 0.0;
    def.body = f->body;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_INVALID_ARGUMENT,
                  "dimension");
    cstk_robot *robot;
    CHECK_REFUSED(robot, cstk_robot_build(builder, &robot), CSTK_EMPTY, "link");
    CHECK_OK(cstk_robot_builder_release(builder));
}

static void build(const fixture *f) {
    cstk_robot *out;
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(out, cstk_robot_build(bad->handle, &out), bad->status, "builder");
    }
    CHECK_FAILS(cstk_robot_build(f->robot_builder, NULL), CSTK_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

static void size(const fixture *f) {
    size_t out[2];
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_size(bad->handle, &out[0], &out[1]), bad->status, "robot");
    }
    CHECK_OK(cstk_robot_size(f->robot, NULL, NULL));
    fixture_unchanged(f);
}

static void find_link(const fixture *f) {
    uint32_t out;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_find_link(bad->handle, "link0", &out), bad->status, "robot");
    }
    CHECK_REFUSED(out, cstk_robot_find_link(f->robot, NULL, &out), CSTK_NULL_ARGUMENT, "name");
    CHECK_FAILS(cstk_robot_find_link(f->robot, "link0", NULL), CSTK_NULL_ARGUMENT, "out");
    const char *missing[] = {"", "link", "link4", "LINK0", "link0 "};
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(out, cstk_robot_find_link(f->robot, missing[i], &out), CSTK_NOT_FOUND,
                      missing[i]);
    }
    CHECK_REFUSED(out, cstk_robot_find_link(f->robot, "\xff", &out), CSTK_INVALID_ARGUMENT, "name");
    fixture_unchanged(f);
}

static void link_pose(const fixture *f) {
    double out[12];
    const cstk_robot *r = f->robot;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_link_pose(bad->handle, f->q, FIXTURE_NQ, 0, out), bad->status,
                      "robot");
    }
    CHECK_REFUSED(out, cstk_robot_link_pose(r, NULL, FIXTURE_NQ, 0, out), CSTK_NULL_ARGUMENT, "q");
    CHECK_FAILS(cstk_robot_link_pose(r, f->q, FIXTURE_NQ, 0, NULL), CSTK_NULL_ARGUMENT, "pose");
    const size_t counts[] = {0, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out, cstk_robot_link_pose(r, f->q, counts[i], 0, out), CSTK_WRONG_SIZE, "");
    }
    const uint32_t links[] = {FIXTURE_LINKS, CSTK_NONE};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(out, cstk_robot_link_pose(r, f->q, FIXTURE_NQ, links[i], out), CSTK_NOT_FOUND,
                      "link");
    }
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            double q[FIXTURE_NQ] = {0};
            q[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_robot_link_pose(r, q, FIXTURE_NQ, 0, out), CSTK_NOT_FINITE,
                          "configuration");
        }
    }
    const double far[FIXTURE_NQ] = {0, 1e300, 0};
    CHECK_REFUSED(out, cstk_robot_link_pose(r, far, FIXTURE_NQ, 0, out), CSTK_INVALID_ARGUMENT,
                  "configuration");
    fixture_unchanged(f);
}

static void jacobian(const fixture *f) {
    double out[6 * FIXTURE_NQ];
    const cstk_robot *r = f->robot;
    const double *q = f->q;
    const double point[3] = {0.1, 0.2, 0.3};
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_jacobian(bad->handle, q, FIXTURE_NQ, 1, point, out),
                      bad->status, "robot");
    }
    CHECK_REFUSED(out, cstk_robot_jacobian(r, NULL, FIXTURE_NQ, 1, point, out), CSTK_NULL_ARGUMENT,
                  "q");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, NULL, out), CSTK_NULL_ARGUMENT,
                  "point");
    CHECK_FAILS(cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, point, NULL), CSTK_NULL_ARGUMENT,
                "jacobian");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ - 1, 1, point, out), CSTK_WRONG_SIZE,
                  "configuration");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, SIZE_MAX, 1, point, out), CSTK_WRONG_SIZE, "q");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, FIXTURE_LINKS, point, out),
                  CSTK_NOT_FOUND, "link");
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[3] = {0};
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, bad, out), CSTK_NOT_FINITE,
                          "point");
            CHECK_REFUSED(out, cstk_robot_jacobian(r, bad, FIXTURE_NQ, 1, point, out),
                          CSTK_NOT_FINITE, "configuration");
        }
    }
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    builder_create(&f);
    references(&f);
    add_link_handles(&f);
    add_link_numbers(&f);
    add_link_geometry(&f);
    planar_links(&f);
    build(&f);
    size(&f);
    find_link(&f);
    link_pose(&f);
    jacobian(&f);
    fixture_release(&f);
    return check_result();
}
