/* Joints by functions of the caller: those that move as built-in ones are answered alike. */
#include "check.h"
#include "fixture.h"
#include "robots.h"

enum { ARM_LINKS = 3 };

/* An arm of links of one kind in front of a box. */
typedef struct arm {
    cstk_robot *robot;
    cstk_space *space;
    cstk_cobject *cobject;
    cstk_query *query;
    size_t n;
} arm;

static arm make_posed_arm(int32_t kind, const cstk_custom_joint *custom, const cstk_body *body,
                          const cstk_environment *environment) {
    arm a;
    cstk_robot_builder *builder = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    for (int i = 0; i < ARM_LINKS; ++i) {
        const double at[6] = {1.0, 0.1 * i, 0, 0.3 * i, 0.2, 0.1};
        cstk_link_def def = link_of(custom != NULL ? CSTK_JOINT_CUSTOM : kind);
        def.custom = custom;
        def.body = body;
        def.parent = i - 1;
        CHECK_OK(cstk_pose_from_euler(at, def.at));
        CHECK_OK(cstk_robot_builder_add_link(builder, &def, NULL));
    }
    CHECK_OK(cstk_robot_build(builder, &a.robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    CHECK_OK(cstk_robot_get_size(a.robot, &a.n, NULL, NULL));
    a.space = space_of(a.robot, NULL, 0);
    CHECK_OK(cstk_cobject_induced(a.space, NULL, 0, environment, NULL, 0, NULL, &a.cobject));
    CHECK_OK(cstk_query_create(&a.query));
    return a;
}

static void arm_release(const arm *a) {
    CHECK_OK(cstk_query_release(a->query));
    CHECK_OK(cstk_cobject_release(a->cobject));
    CHECK_OK(cstk_space_release(a->space));
    CHECK_OK(cstk_robot_release(a->robot));
}

static void same_kinematics(const arm *a, const arm *b, const double *q) {
    double poses_a[12 * ARM_LINKS];
    double poses_b[12 * ARM_LINKS];
    double matrix_a[6 * 9];
    double matrix_b[6 * 9];
    const double point[3] = {0.1, 0.2, 0.3};
    CHECK_OK(cstk_space_link_poses(a->space, q, a->n, poses_a));
    CHECK_OK(cstk_space_link_poses(b->space, q, a->n, poses_b));
    CHECK(near(poses_a, poses_b, 12 * ARM_LINKS, 1e-14));
    for (uint32_t link = 0; link < ARM_LINKS; ++link) {
        CHECK_OK(cstk_space_jacobian(a->space, q, a->n, link, point, matrix_a));
        CHECK_OK(cstk_space_jacobian(b->space, q, a->n, link, point, matrix_b));
        CHECK(near(matrix_a, matrix_b, 6 * a->n, 1e-14));
    }
}

static void same_answers(const arm *a, const arm *b, const double *q) {
    cstk_witness_list list_a;
    cstk_witness_list list_b;
    CHECK_OK(cstk_gradients(a->query, a->cobject, q, a->n, 10.0, 16, &list_a));
    CHECK_OK(cstk_gradients(b->query, b->cobject, q, a->n, 10.0, 16, &list_b));
    CHECK(list_a.contact_count >= ARM_LINKS && list_a.contact_count == list_b.contact_count);
    CHECK(list_a.nv == a->n && list_b.nv == a->n);
    CHECK(near(list_a.gradients, list_b.gradients, list_a.contact_count * a->n, 1e-12));
    double step[9];
    double reached_a[9];
    double reached_b[9];
    cstk_slide_result result_a;
    cstk_slide_result result_b;
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = 0.5;
    /* Towards the box. */
    for (size_t i = 0; i < a->n; ++i) {
        step[i] = -0.02 * list_a.gradients[i];
    }
    CHECK_OK(cstk_slide(a->query, a->cobject, q, a->n, step, a->n, &options, reached_a, &result_a));
    CHECK_OK(cstk_slide(b->query, b->cobject, q, a->n, step, a->n, &options, reached_b, &result_b));
    CHECK(result_a.outcome == CSTK_SLIDE_MOVED && result_b.outcome == CSTK_SLIDE_MOVED);
    CHECK(near(reached_a, reached_b, a->n, 1e-12));
}

/* A joint of the caller's that moves as a built-in one is answered alike. */
static void imitate(int32_t kind, const cstk_custom_joint *custom) {
    cstk_body *body = make_box(0.3, 0.1, 0.1);
    cstk_environment *environment = NULL;
    uint64_t seed = 3;
    CHECK_OK(cstk_environment_create(&environment));
    add_object(environment, body, 2.0, 1.5, 0.5);
    const arm built_in = make_posed_arm(kind, NULL, body, environment);
    const arm own = make_posed_arm(kind, custom, body, environment);
    CHECK(built_in.n == own.n && own.n <= 9);
    for (int i = 0; i < 20; ++i) {
        double q[9];
        for (size_t k = 0; k < own.n; ++k) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            q[k] = 0.3 * ((double)(seed >> 11) / 4503599627370496.0 - 1.0);
        }
        same_kinematics(&built_in, &own, q);
        same_answers(&built_in, &own, q);
    }
    arm_release(&built_in);
    arm_release(&own);
    CHECK_OK(cstk_environment_release(environment));
    CHECK_OK(cstk_body_release(body));
}

static void custom_joints(void) {
    double pitch = 0.0;
    cstk_custom_joint custom = screw(&pitch);
    imitate(CSTK_JOINT_REVOLUTE, &custom);
    custom = plane();
    imitate(CSTK_JOINT_PLANAR, &custom);
}

int main(void) {
    custom_joints();
    return check_result();
}
