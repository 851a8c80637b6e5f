/* The user data of joints by functions: given back once, when nothing uses them any more. */
#include "bodies.h"
#include "check.h"
#include "fixture.h"
#include "wrist.h"

/* User data are given back once, with the last of all that uses them, whichever that is. */
static void destroyed_last(const fixture *f) {
    for (int last = 0; last < 4; ++last) {
        wrist w = {0};
        scene s;
        const cstk_custom_joint joint = good_joint(&w);
        scene_create(f, &joint, &s);
        CHECK_OK(cstk_query_release(s.query));
        for (int i = 0; i < 4; ++i) {
            CHECK(w.destroyed == 0);
            switch ((last + 1 + i) % 4) {
            case 0:
                CHECK_OK(cstk_robot_builder_release(s.builder));
                break;
            case 1:
                CHECK_OK(cstk_robot_release(s.robot));
                break;
            case 2:
                CHECK_OK(cstk_space_release(s.space));
                break;
            default:
                CHECK_OK(cstk_cobject_release(s.cobject));
            }
        }
        CHECK(w.destroyed == 1);
    }
    fixture_unchanged(f);
}

/* Several robots of one builder share the data; more references to one of them do not count. */
static void destroyed_once(const fixture *f) {
    wrist w = {0};
    scene s;
    cstk_robot *other = NULL;
    const cstk_custom_joint joint = good_joint(&w);
    scene_create(f, &joint, &s);
    CHECK_OK(cstk_robot_build(s.builder, &other));
    CHECK_OK(cstk_robot_retain(other));
    scene_release(&s);
    CHECK_OK(cstk_robot_release(other));
    CHECK(w.destroyed == 0);
    double pose[12];
    CHECK_OK(cstk_robot_link_pose(other, s.q, 1, WRIST, pose));
    CHECK_OK(cstk_robot_release(other));
    CHECK(w.destroyed == 1);
    CHECK_FAILS(cstk_robot_release(other), CSTK_ERROR_WRONG_HANDLE, "robot");
    CHECK(w.destroyed == 1);
    fixture_unchanged(f);
}

typedef struct keeper {
    cstk_body *body;
    int destroyed;
} keeper;

static int32_t keeper_pose(const double *q, size_t n, double *pose, void *user) {
    (void)q, (void)n, (void)user;
    memcpy(pose, identity_pose, sizeof identity_pose);
    return CSTK_OK;
}

static int32_t keeper_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    (void)q, (void)n, (void)user;
    memset(jacobian, 0, 6 * sizeof *jacobian);
    return CSTK_OK;
}

static void keeper_destroy(void *user) {
    keeper *k = user;
    CHECK_OK(cstk_body_release(k->body));
    ++k->destroyed;
}

/* User data may hold objects of the library, and release them when they go. */
static void destroy_calls_back(const fixture *f) {
    keeper k = {make_box(1.0, 1.0, 1.0), 0};
    scene s;
    wrist unused = {0};
    cstk_custom_joint joint = good_joint(&unused);
    joint.pose = keeper_pose;
    joint.jacobian = keeper_jacobian;
    joint.destroy = keeper_destroy;
    joint.user = &k;
    scene_create(f, &joint, &s);
    scene_release(&s);
    CHECK(k.destroyed == 1);
    CHECK_FAILS(cstk_body_retain(k.body), CSTK_ERROR_WRONG_HANDLE, "body");
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    destroyed_last(&f);
    destroyed_once(&f);
    destroy_calls_back(&f);
    fixture_release(&f);
    return check_result();
}
