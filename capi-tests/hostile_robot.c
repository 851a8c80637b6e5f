/* Hostile input to robots and their builders. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void builder_create(const fixture *f) {
    cstk_robot_builder *out;
    const uint32_t wrong[] = {0, 1, 4, UINT32_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_REFUSED(out, cstk_robot_builder_create(wrong[i], &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "dimension");
    }
    CHECK_FAILS(cstk_robot_builder_create(3, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
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
    refuse_link(f, NULL, CSTK_ERROR_NULL_ARGUMENT, "def");
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
    const int32_t joints[] = {-1, CSTK_JOINT_CUSTOM + 1, INT32_MIN, INT32_MAX};
    const int32_t negative[] = {-2, INT32_MIN};
    cstk_link_def def = good_link(f);
    for (int i = 0; i < 4; ++i) {
        def.joint = joints[i];
        refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "joint");
    }
    for (int i = 0; i < 2; ++i) {
        def = good_link(f);
        def.parent = negative[i];
        refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "parent");
        def = good_link(f);
        def.coordinate = negative[i];
        refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinate");
    }
    def = good_link(f);
    def.parent = FIXTURE_LINKS; /* itself */
    refuse_link(f, &def, CSTK_ERROR_NOT_FOUND, "parent");
    def.parent = INT32_MAX;
    refuse_link(f, &def, CSTK_ERROR_NOT_FOUND, "parent");
    def = good_link(f);
    def.coordinate = FIXTURE_NQ + 1; /* would leave a gap */
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinate");
    def.coordinate = INT32_MAX;
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinate");
    def = good_link(f);
    def.name = "link1"; /* the default name of another link */
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "name");
    def.name = "\xff\xfe";
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "name");
    def = good_link(f);
    def.joint_name = "\xff\xfe";
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "joint_name");
    fixture_unchanged(f);
}

/* Two links without bodies, with names; the builder is released. */
static cstk_robot *make_named(void) {
    uint32_t out;
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.name = "forearm";
    def.joint_name = "elbow";
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.name = "other";
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "elbow");
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    return robot;
}

static void add_link_followers(const fixture *f) {
    const int32_t joints[2] = {CSTK_JOINT_REVOLUTE, CSTK_JOINT_PRISMATIC};
    cstk_link_def def = good_link(f);
    for (int i = 0; i < 6; ++i) {
        const double wrong = i < 3 ? not_finite[i] : i == 3 ? 1e51 : i == 4 ? -1e51 : 1e300;
        const cstk_status status = i < 3 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT;
        for (int k = 0; k < 2; ++k) {
            def = good_link(f);
            def.joint = joints[k];
            def.multiplier = wrong;
            refuse_link(f, &def, status, "multiplier");
            def = good_link(f);
            def.joint = joints[k];
            def.offset = wrong;
            refuse_link(f, &def, status, "offset");
        }
    }
    const struct {
        double lower;
        double upper;
        cstk_status status;
    } limits[] = {
        {NAN, 1, CSTK_ERROR_NOT_FINITE},
        {-1, NAN, CSTK_ERROR_NOT_FINITE},
        {1, -1, CSTK_ERROR_INVALID_ARGUMENT},
        {INFINITY, INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
        {-INFINITY, -INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
        {INFINITY, -INFINITY, CSTK_ERROR_INVALID_ARGUMENT},
    };
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; ++i) {
        def = good_link(f);
        def.joint = joints[i % 2];
        def.lower = limits[i].lower;
        def.upper = limits[i].upper;
        refuse_link(f, &def, limits[i].status, "limit");
    }
    fixture_unchanged(f);
}

/* Coordinates that only joints of one coordinate may share. */
static void add_link_shared(const fixture *f) {
    const int32_t joints[] = {CSTK_JOINT_PLANAR, CSTK_JOINT_SPHERICAL, CSTK_JOINT_FREE,
                              CSTK_JOINT_FREE_EULER};
    cstk_link_def def = good_link(f);
    for (int i = 0; i < 4; ++i) {
        for (int coordinate = 0; coordinate < FIXTURE_NQ; ++coordinate) {
            def.joint = joints[i];
            def.coordinate = coordinate;
            refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinate");
        }
    }
    /* Not with a quaternion, and not with the lengths that go with one. */
    uint32_t out;
    cstk_robot_builder *builder = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = CSTK_JOINT_FREE;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    def.joint = CSTK_JOINT_REVOLUTE;
    for (int coordinate = 0; coordinate < 7; ++coordinate) {
        def.coordinate = coordinate;
        CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "coordinate");
    }
    CHECK_OK(cstk_robot_builder_release(builder));
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
            refuse_link(f, &def, CSTK_ERROR_NOT_FINITE, "axis");
        }
    }
    def = good_link(f);
    def.axis[2] = 0.0;
    refuse_link(f, &def, CSTK_ERROR_DEGENERATE, "axis");
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
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "turn");
    def.joint = CSTK_JOINT_PRISMATIC;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "shift");
    const int32_t spatial[] = {CSTK_JOINT_SPHERICAL, CSTK_JOINT_FREE, CSTK_JOINT_FREE_EULER};
    for (int i = 0; i < 3; ++i) {
        def.joint = spatial[i];
        CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                      "planar");
    }
    def.joint = CSTK_JOINT_PRISMATIC;
    def.axis[2] = 0.0;
    def.at[11] = 0.1;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "plane");
    def.at[11] = 0.0;
    def.body = f->body;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(builder, &def, &out), CSTK_ERROR_INVALID_ARGUMENT,
                  "dimension");
    cstk_robot *robot;
    CHECK_REFUSED(robot, cstk_robot_build(builder, &robot), CSTK_ERROR_EMPTY, "link");
    CHECK_OK(cstk_robot_builder_release(builder));
}

static void build(const fixture *f) {
    cstk_robot *out;
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(out, cstk_robot_build(bad->handle, &out), bad->status, "builder");
    }
    CHECK_FAILS(cstk_robot_build(f->robot_builder, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

static void size(const fixture *f) {
    size_t out[3];
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_get_size(bad->handle, &out[0], &out[1], &out[2]), bad->status,
                      "robot");
    }
    CHECK_OK(cstk_robot_get_size(f->robot, NULL, NULL, NULL));
    fixture_unchanged(f);
}

static void get_body(const fixture *f) {
    cstk_body *out;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_get_body(bad->handle, FIXTURE_TIP, &out), bad->status,
                      "robot");
    }
    CHECK_FAILS(cstk_robot_get_body(f->robot, FIXTURE_TIP, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_robot_get_body(f->robot, FIXTURE_LINKS, &out), CSTK_ERROR_NOT_FOUND, "link");
    CHECK_REFUSED(out, cstk_robot_get_body(f->robot, FIXTURE_BASE, &out), CSTK_ERROR_EMPTY, "no body");
    CHECK_OK(cstk_robot_get_body(f->robot, FIXTURE_TIP, &out));
    CHECK_OK(cstk_body_release(out));
    fixture_unchanged(f);
}

static void find_link(const fixture *f) {
    uint32_t out;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_find_link(bad->handle, "link0", &out), bad->status, "robot");
    }
    CHECK_REFUSED(out, cstk_robot_find_link(f->robot, NULL, &out), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_FAILS(cstk_robot_find_link(f->robot, "link0", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    const char *missing[] = {"", "link", "link4", "LINK0", "link0 "};
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(out, cstk_robot_find_link(f->robot, missing[i], &out), CSTK_ERROR_NOT_FOUND,
                      missing[i]);
    }
    CHECK_REFUSED(out, cstk_robot_find_link(f->robot, "\xff", &out), CSTK_ERROR_INVALID_ARGUMENT, "name");
    fixture_unchanged(f);
}

static void find_joint(const fixture *f) {
    uint32_t out;
    cstk_robot *named = make_named();
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_find_joint(bad->handle, "elbow", &out), bad->status, "robot");
    }
    CHECK_REFUSED(out, cstk_robot_find_joint(named, NULL, &out), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_FAILS(cstk_robot_find_joint(named, "elbow", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    /* A joint without a name has not the empty one. */
    const char *missing[] = {"", "forearm", "ELBOW", "elbow ", "link0"};
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(out, cstk_robot_find_joint(named, missing[i], &out), CSTK_ERROR_NOT_FOUND,
                      missing[i]);
    }
    CHECK_REFUSED(out, cstk_robot_find_joint(named, "\xff", &out), CSTK_ERROR_INVALID_ARGUMENT, "name");
    CHECK_OK(cstk_robot_release(named));
    fixture_unchanged(f);
}

static void link_info(const fixture *f) {
    cstk_link_info out;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_get_link_info(bad->handle, 0, &out), bad->status, "robot");
    }
    CHECK_FAILS(cstk_robot_get_link_info(f->robot, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    const uint32_t links[] = {FIXTURE_LINKS, CSTK_NONE};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(out, cstk_robot_get_link_info(f->robot, links[i], &out), CSTK_ERROR_NOT_FOUND, "link");
    }
    fixture_unchanged(f);
}

typedef cstk_status (*name_fn)(const cstk_robot *, uint32_t, char *, size_t, size_t *);

static void names(const fixture *f, const char *name, name_fn name_of) {
    struct {
        char buffer[32];
        size_t length;
    } out;
    cstk_robot *r = make_named();
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, name_of(bad->handle, 1, out.buffer, sizeof out.buffer, &out.length),
                      bad->status, "robot");
    }
    const uint32_t links[] = {FIXTURE_LINKS, CSTK_NONE};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(out, name_of(r, links[i], out.buffer, sizeof out.buffer, &out.length),
                      CSTK_ERROR_NOT_FOUND, "link");
    }
    CHECK_REFUSED(out, name_of(r, 1, NULL, 1, &out.length), CSTK_ERROR_NULL_ARGUMENT, "buffer");
    CHECK_REFUSED(out, name_of(r, 1, NULL, SIZE_MAX, &out.length), CSTK_ERROR_NULL_ARGUMENT, "buffer");
    /* Room for the terminator is needed too. */
    const size_t capacities[] = {0, 1, strlen(name)};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out, name_of(r, 1, out.buffer, capacities[i], &out.length), CSTK_ERROR_WRONG_SIZE,
                      "name");
    }
    /* No byte beyond the terminator is written, whatever the capacity. */
    memset(&out, CHECK_SENTINEL, sizeof out);
    CHECK_OK(name_of(r, 1, out.buffer, SIZE_MAX, NULL));
    CHECK(strcmp(out.buffer, name) == 0);
    check_untouched(out.buffer + strlen(name) + 1, sizeof out - strlen(name) - 1, name, __FILE__,
                    __LINE__);
    CHECK_OK(name_of(r, 1, NULL, 0, NULL));
    CHECK_OK(cstk_robot_release(r));
    fixture_unchanged(f);
}

static void link_pose(const fixture *f) {
    double out[12];
    const cstk_robot *r = f->robot;
    EACH_BAD_HANDLE(f, NOUN_ROBOT, bad) {
        CHECK_REFUSED(out, cstk_robot_link_pose(bad->handle, f->q, FIXTURE_NQ, 0, out), bad->status,
                      "robot");
    }
    CHECK_REFUSED(out, cstk_robot_link_pose(r, NULL, FIXTURE_NQ, 0, out), CSTK_ERROR_NULL_ARGUMENT, "q");
    CHECK_FAILS(cstk_robot_link_pose(r, f->q, FIXTURE_NQ, 0, NULL), CSTK_ERROR_NULL_ARGUMENT, "pose");
    const size_t counts[] = {0, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out, cstk_robot_link_pose(r, f->q, counts[i], 0, out), CSTK_ERROR_WRONG_SIZE, "");
    }
    const uint32_t links[] = {FIXTURE_LINKS, CSTK_NONE};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(out, cstk_robot_link_pose(r, f->q, FIXTURE_NQ, links[i], out), CSTK_ERROR_NOT_FOUND,
                      "link");
    }
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            double q[FIXTURE_NQ] = {0};
            q[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_robot_link_pose(r, q, FIXTURE_NQ, 0, out), CSTK_ERROR_NOT_FINITE,
                          "configuration");
        }
    }
    const double far[FIXTURE_NQ] = {0, 1e300, 0};
    CHECK_REFUSED(out, cstk_robot_link_pose(r, far, FIXTURE_NQ, 0, out), CSTK_ERROR_INVALID_ARGUMENT,
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
    CHECK_REFUSED(out, cstk_robot_jacobian(r, NULL, FIXTURE_NQ, 1, point, out), CSTK_ERROR_NULL_ARGUMENT,
                  "q");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, NULL, out), CSTK_ERROR_NULL_ARGUMENT,
                  "point");
    CHECK_FAILS(cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, point, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "jacobian");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ - 1, 1, point, out), CSTK_ERROR_WRONG_SIZE,
                  "configuration");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, SIZE_MAX, 1, point, out), CSTK_ERROR_WRONG_SIZE, "q");
    CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, FIXTURE_LINKS, point, out),
                  CSTK_ERROR_NOT_FOUND, "link");
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[3] = {0};
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, bad, out), CSTK_ERROR_NOT_FINITE,
                          "point");
            CHECK_REFUSED(out, cstk_robot_jacobian(r, bad, FIXTURE_NQ, 1, point, out),
                          CSTK_ERROR_NOT_FINITE, "configuration");
        }
        double far[3] = {0};
        far[entry] = 1.7e308;
        CHECK_REFUSED(out, cstk_robot_jacobian(r, q, FIXTURE_NQ, 1, far, out),
                      CSTK_ERROR_INVALID_ARGUMENT, "point");
    }
    fixture_unchanged(f);
}

/* Configurations whose quaternion is none. */
static void quaternions(const fixture *f) {
    double out[6 * 3];
    const double point[3] = {0.1, 0.2, 0.3};
    const double wrong[][4] = {{0, 0, 0, 0}, {0, 0, 0, 1.00001}, {1, 1, 0, 0}, {0, 1e-200, 0, 0}};
    cstk_link_def def;
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = CSTK_JOINT_SPHERICAL;
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        CHECK_REFUSED(out, cstk_robot_link_pose(robot, wrong[i], 4, 0, out), CSTK_ERROR_NOT_A_ROTATION,
                      "entries 0 to 3");
        CHECK_REFUSED(out, cstk_robot_jacobian(robot, wrong[i], 4, 0, point, out),
                      CSTK_ERROR_NOT_A_ROTATION, "entries 0 to 3");
    }
    /* As many entries as velocities. */
    CHECK_REFUSED(out, cstk_robot_link_pose(robot, wrong[0], 3, 0, out), CSTK_ERROR_WRONG_SIZE,
                  "configuration");
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    builder_create(&f);
    references(&f);
    add_link_handles(&f);
    add_link_numbers(&f);
    add_link_followers(&f);
    add_link_shared(&f);
    add_link_geometry(&f);
    planar_links(&f);
    build(&f);
    size(&f);
    get_body(&f);
    find_link(&f);
    find_joint(&f);
    link_info(&f);
    names(&f, "forearm", cstk_robot_get_link_name);
    names(&f, "elbow", cstk_robot_get_joint_name);
    link_pose(&f);
    jacobian(&f);
    quaternions(&f);
    fixture_release(&f);
    return check_result();
}
