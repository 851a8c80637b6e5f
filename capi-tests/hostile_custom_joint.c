/* Hostile input to joints by functions of the caller, and hostile functions. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "wrist.h"

#define CULPRIT "link 1 (\"wrist\")"

static void refuse_link(const fixture *f, const cstk_link_def *def, cstk_status status,
                        const char *culprit) {
    uint32_t out;
    CHECK_REFUSED(out, cstk_robot_builder_add_link(f->robot_builder, def, &out), status, culprit);
}

/* None of these links is added, and so none gives its user data back. */
static void bad_joints(const fixture *f) {
    wrist w = {0};
    const cstk_custom_joint good = good_joint(&w);
    cstk_custom_joint joint = good;
    cstk_link_def def = wrist_link(&joint, f->body);
    EACH_BAD_OPTIONS(good, bad) {
        def.custom = bad->options;
        refuse_link(f, &def, bad->status, "def->custom");
    }
    def.custom = NULL;
    refuse_link(f, &def, CSTK_ERROR_NULL_ARGUMENT, "def->custom");
    def.custom = &joint;
    for (int32_t kind = CSTK_JOINT_FIXED; kind < CSTK_JOINT_CUSTOM; ++kind) {
        def.joint = kind;
        refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "def->custom");
    }
    def.joint = CSTK_JOINT_CUSTOM;
    joint.pose = NULL;
    refuse_link(f, &def, CSTK_ERROR_NULL_ARGUMENT, "pose");
    joint = good;
    joint.jacobian = NULL;
    refuse_link(f, &def, CSTK_ERROR_NULL_ARGUMENT, "jacobian");
    joint = good;
    const uint32_t counts[] = {0, 65, UINT32_MAX};
    for (int i = 0; i < 3; ++i) {
        joint.coordinates = counts[i];
        refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinates");
    }
    EACH_NOT_FINITE(i) {
        joint = good;
        joint.linear_speed = not_finite[i];
        refuse_link(f, &def, CSTK_ERROR_NOT_FINITE, "linear_speed");
        joint = good;
        joint.angular_speed = not_finite[i];
        refuse_link(f, &def, CSTK_ERROR_NOT_FINITE, "angular_speed");
    }
    CHECK(w.destroyed == 0);
    fixture_unchanged(f);
}

/* A good joint in a link that is refused for something else. */
static void bad_links(const fixture *f) {
    wrist w = {0};
    uint32_t out;
    const cstk_custom_joint joint = good_joint(&w);
    const cstk_link_def good = wrist_link(&joint, f->body);
    cstk_link_def def = good;
    EACH_BAD_HANDLE(f, NOUN_ROBOT_BUILDER, bad) {
        CHECK_REFUSED(out, cstk_robot_builder_add_link(bad->handle, &def, &out), bad->status,
                      "builder");
    }
    def.name = "link1";
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "name");
    def = good;
    def.parent = FIXTURE_LINKS;
    refuse_link(f, &def, CSTK_ERROR_NOT_FOUND, "parent");
    def = good;
    def.at[0] = NAN;
    refuse_link(f, &def, CSTK_ERROR_NOT_FINITE, "def->at");
    def = good;
    def.body = f->live[NOUN_ROBOT];
    refuse_link(f, &def, CSTK_ERROR_WRONG_HANDLE, "def->body");
    def = good;
    def.coordinate = 0; /* another joint's */
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinate");
    def.coordinate = FIXTURE_NQ + 1;
    refuse_link(f, &def, CSTK_ERROR_INVALID_ARGUMENT, "coordinate");
    CHECK(w.destroyed == 0);
    fixture_unchanged(f);
}

/* Room for the output of any call that asks the joint. */
typedef union answer {
    double numbers[12 * 2];
    bool holds;
    cstk_class point_class;
    cstk_distance_result distance;
    cstk_witness_list list;
    cstk_pseudo_normal_result pseudo_normal;
    struct {
        double reached[1];
        cstk_slide_result result;
    } slide;
} answer;

typedef cstk_status (*ask_fn)(const scene *, answer *);

static const double origin[3] = {0, 0, 0};
static const char *picture = "hostile_custom_joint.glb";

static cstk_status link_pose(const scene *s, answer *out) {
    return cstk_robot_link_pose(s->robot, s->q, 1, WRIST, out->numbers);
}

static cstk_status base_pose(const scene *s, answer *out) {
    return cstk_robot_link_pose(s->robot, s->q, 1, BASE, out->numbers);
}

static cstk_status robot_jacobian(const scene *s, answer *out) {
    return cstk_robot_jacobian(s->robot, s->q, 1, WRIST, origin, out->numbers);
}

static cstk_status link_poses(const scene *s, answer *out) {
    return cstk_space_link_poses(s->space, s->q, 1, out->numbers);
}

static cstk_status space_jacobian(const scene *s, answer *out) {
    return cstk_space_jacobian(s->space, s->q, 1, WRIST, origin, out->numbers);
}

static cstk_status contains(const scene *s, answer *out) {
    return cstk_space_contains(s->space, s->q, 1, &out->holds);
}

static cstk_status within_world(const scene *s, answer *out) {
    return cstk_space_within_world(s->space, s->q, 1, &out->holds, NULL);
}

static cstk_status classify(const scene *s, answer *out) {
    return cstk_classify(s->query, s->cobject, s->q, 1, &out->point_class);
}

static cstk_status within(const scene *s, answer *out) {
    return cstk_within(s->query, s->cobject, s->q, 1, 0.1, &out->holds);
}

static cstk_status distance(const scene *s, answer *out) {
    return cstk_distance(s->query, s->cobject, s->q, 1, INFINITY, &out->distance);
}

static cstk_status witnesses(const scene *s, answer *out) {
    return cstk_witnesses(s->query, s->cobject, s->q, 1, 10.0, 16, &out->list);
}

static cstk_status gradients(const scene *s, answer *out) {
    return cstk_gradients(s->query, s->cobject, s->q, 1, 10.0, 16, &out->list);
}

static cstk_status pseudo_normal(const scene *s, answer *out) {
    return cstk_pseudo_normal(s->query, s->cobject, s->q, 1, 10.0, 16, true, &out->pseudo_normal);
}

static cstk_status slide(const scene *s, answer *out) {
    const double step[1] = {0.01};
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = 10.0;
    return cstk_slide(s->query, s->cobject, s->q, 1, step, 1, &options, out->slide.reached,
                      &out->slide.result);
}

static cstk_status show(const scene *s, answer *out) {
    (void)out;
    return cstk_show(s->cobject, s->q, 1, picture);
}

typedef struct form {
    const char *name;
    ask_fn ask;
    bool asks_jacobian;
} form;

static const form forms[] = {
    {"robot_link_pose", link_pose, false},
    {"robot_link_pose", base_pose, false},
    {"robot_jacobian", robot_jacobian, true},
    {"space_link_poses", link_poses, false},
    {"space_jacobian", space_jacobian, true},
    {"space_contains", contains, false},
    {"space_within_world", within_world, false},
    {"classify", classify, false},
    {"within", within, false},
    {"distance", distance, false},
    {"witnesses", witnesses, false},
    {"gradients", gradients, true},
    {"pseudo_normal", pseudo_normal, true},
    {"slide", slide, true},
    {"show", show, true},
};

enum { FORMS = sizeof forms / sizeof forms[0] };

/* All calls that ask the function that misbehaves are refused, and name the link. */
static void refuse(const scene *s, bool by_jacobian, cstk_status status, const char *culprit) {
    for (int i = 0; i < FORMS; ++i) {
        if (by_jacobian && !forms[i].asks_jacobian) {
            continue;
        }
        answer out;
        const int before = check_failures;
        CHECK_REFUSED(out, forms[i].ask(s, &out), status, CULPRIT);
        CHECK_REFUSED(out, forms[i].ask(s, &out), status, culprit);
        if (check_failures > before) {
            fprintf(stderr, "  (cstk_%s)\n", forms[i].name);
        }
    }
    if (remove(picture) == 0) {
        fprintf(stderr, "cstk_show failed, but wrote a file\n");
        ++check_failures;
    }
}

/* Once the functions behave again, all answer; to the last bit as before. */
static void answers(const scene *s, const double *expected) {
    answer out;
    for (int i = 0; i < FORMS; ++i) {
        CHECK_OK(forms[i].ask(s, &out));
    }
    CHECK(remove(picture) == 0);
    CHECK_OK(distance(s, &out));
    CHECK(memcmp(&out.distance.distance, expected, sizeof *expected) == 0);
}

static void bad_poses_given(const scene *s, wrist *w) {
    const int32_t statuses[] = {1, CSTK_ERROR_INVALID_ARGUMENT, CSTK_ERROR_CALLBACK_FAILED, -1, INT32_MIN};
    for (int i = 0; i < 5; ++i) {
        char returned[32];
        snprintf(returned, sizeof returned, "returned %d", (int)statuses[i]);
        w->pose_status = statuses[i];
        refuse(s, false, CSTK_ERROR_CALLBACK_FAILED, returned);
        refuse(s, false, CSTK_ERROR_CALLBACK_FAILED, "pose");
    }
    w->pose_status = CSTK_OK;
    w->leaves_unwritten = true;
    refuse(s, false, CSTK_ERROR_NOT_A_ROTATION, "pose");
    w->leaves_unwritten = false;
    EACH_BAD_POSE(bad) {
        w->pose = bad->pose;
        refuse(s, false, bad->status, "pose");
    }
    w->pose = NULL;
}

static void bad_jacobians_given(const scene *s, wrist *w) {
    w->jacobian_status = 7;
    refuse(s, true, CSTK_ERROR_CALLBACK_FAILED, "returned 7");
    w->jacobian_status = CSTK_OK;
    for (int entry = 0; entry < 6; ++entry) {
        double bad[6] = {0, 0, 0, 0, 0, 1};
        w->jacobian = bad;
        EACH_NOT_FINITE(i) {
            bad[entry] = not_finite[i];
            refuse(s, true, CSTK_ERROR_NOT_FINITE, "Jacobian");
        }
        bad[entry] = 1.7e308;
        refuse(s, true, CSTK_ERROR_INVALID_ARGUMENT, "Jacobian");
    }
    w->jacobian = NULL;
}

/* Writes the pose, but not the Jacobian. */
static int32_t no_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    (void)q, (void)n, (void)jacobian, (void)user;
    return CSTK_OK;
}

static void bad_functions(const fixture *f) {
    wrist w = {0};
    scene s;
    answer out;
    cstk_custom_joint joint = good_joint(&w);
    scene_create(f, &joint, &s);
    /* It was copied. */
    memset(&joint, CHECK_SENTINEL, sizeof joint);
    CHECK_OK(distance(&s, &out));
    const double expected = out.distance.distance;
    CHECK(expected > 0.0);
    bad_poses_given(&s, &w);
    answers(&s, &expected);
    bad_jacobians_given(&s, &w);
    answers(&s, &expected);
    scene_release(&s);
    CHECK(w.destroyed == 1);
    joint = good_joint(&w);
    joint.jacobian = no_jacobian;
    scene_create(f, &joint, &s);
    refuse(&s, true, CSTK_ERROR_NOT_FINITE, "Jacobian");
    scene_release(&s);
    CHECK(w.destroyed == 2);
    fixture_unchanged(f);
}

/* Slides are refused where the speed of a joint that moves is not known. */
static void unknown_speeds(const fixture *f) {
    const double speeds[][2] = {{-1, -1}, {-1, 1}, {0, -1}, {-1e-300, 1}};
    for (int i = 0; i < 4; ++i) {
        wrist w = {0};
        scene s;
        answer out;
        cstk_custom_joint joint = good_joint(&w);
        joint.linear_speed = speeds[i][0];
        joint.angular_speed = speeds[i][1];
        joint.destroy = NULL;
        scene_create(f, &joint, &s);
        CHECK_REFUSED(out, slide(&s, &out), CSTK_ERROR_UNSUPPORTED, "speed");
        CHECK_OK(gradients(&s, &out));
        scene_release(&s);
        CHECK(w.destroyed == 0);
    }
    fixture_unchanged(f);
}

/* In the plane a joint must not lead out of it. */
static void planar_joint(const fixture *f) {
    double out[12];
    const double q[1] = {0.1};
    double above[12];
    const double tilted[12] = {1, 0, 0, 0, 0, 0.8, -0.6, 0, 0, 0.6, 0.8, 0};
    wrist w = {0};
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    const cstk_custom_joint joint = good_joint(&w);
    const cstk_link_def def = wrist_link(&joint, NULL);
    CHECK_OK(cstk_robot_builder_create(2, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_link_pose(robot, q, 1, 0, out));
    translation(0.0, 0.0, 0.1, above);
    w.pose = above;
    CHECK_REFUSED(out, cstk_robot_link_pose(robot, q, 1, 0, out), CSTK_ERROR_INVALID_ARGUMENT, "plane");
    w.pose = tilted;
    CHECK_REFUSED(out, cstk_robot_link_pose(robot, q, 1, 0, out), CSTK_ERROR_INVALID_ARGUMENT, "plane");
    CHECK_OK(cstk_robot_release(robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    CHECK(w.destroyed == 1);
    fixture_unchanged(f);
}

static void ask_same_query(wrist *w) {
    const scene *s = w->scene;
    answer out;
    CHECK_REFUSED(out, distance(s, &out), CSTK_ERROR_BUSY, "query");
    CHECK_REFUSED(out, gradients(s, &out), CSTK_ERROR_BUSY, "query");
    CHECK_REFUSED(out, slide(s, &out), CSTK_ERROR_BUSY, "query");
    w->answered = distance(s, &out);
}

static void ask_other_query(wrist *w) {
    cstk_query *other = NULL;
    cstk_class answered;
    const scene *s = w->scene;
    w->call = NULL;
    CHECK_OK(cstk_query_create(&other));
    w->answered = cstk_classify(other, s->cobject, s->q, 1, &answered);
    CHECK_OK(cstk_query_release(other));
}

/* The pose function calls the library. */
static void calls_back(const fixture *f) {
    wrist w = {0};
    scene s;
    answer out;
    const cstk_custom_joint joint = good_joint(&w);
    scene_create(f, &joint, &s);
    CHECK_OK(distance(&s, &out));
    const double expected = out.distance.distance;
    w.scene = &s;
    w.call = ask_same_query;
    CHECK_OK(distance(&s, &out));
    CHECK(w.answered == CSTK_ERROR_BUSY &&
          memcmp(&out.distance.distance, &expected, sizeof expected) == 0);
    /* It hands on what it was answered. */
    w.pose_status = CSTK_ERROR_BUSY;
    CHECK_REFUSED(out, distance(&s, &out), CSTK_ERROR_CALLBACK_FAILED, CULPRIT);
    w.pose_status = CSTK_OK;
    w.call = ask_other_query;
    CHECK_OK(distance(&s, &out));
    CHECK(w.answered == CSTK_OK && memcmp(&out.distance.distance, &expected, sizeof expected) == 0);
    w.call = NULL;
    answers(&s, &expected);
    scene_release(&s);
    CHECK(w.destroyed == 1);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    bad_joints(&f);
    bad_links(&f);
    bad_functions(&f);
    unknown_speeds(&f);
    planar_joint(&f);
    calls_back(&f);
    fixture_release(&f);
    return check_result();
}
