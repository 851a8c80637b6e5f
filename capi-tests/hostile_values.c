/* Hostile input to the functions that take no handle: poses, angles, defaults, texts. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void texts(void) {
    char expected[32];
    snprintf(expected, sizeof expected, "%d.%d.%d", CSTK_VERSION_MAJOR, CSTK_VERSION_MINOR,
             CSTK_VERSION_PATCH);
    CHECK(strcmp(cstk_version(), expected) == 0);
    CHECK(cstk_last_error_message() != NULL);
    CHECK(strcmp(cstk_status_name(CSTK_OK), "CSTK_OK") == 0);
    CHECK(strcmp(cstk_status_name(CSTK_ERROR_INTERNAL), "CSTK_ERROR_INTERNAL") == 0);
    const int32_t none[] = {-1, CSTK_ERROR_NOT_PROVED + 1, INT32_MIN, INT32_MAX};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; ++i) {
        CHECK(strcmp(cstk_status_name(none[i]), "unknown status") == 0);
    }
    /* Success leaves the message of the last failure alone. */
    char before[256];
    double pose[12];
    const double here[6] = {0};
    CHECK_FAILS(cstk_pose_from_euler(NULL, pose), CSTK_ERROR_NULL_ARGUMENT, "xyz_ypr");
    snprintf(before, sizeof before, "%s", cstk_last_error_message());
    CHECK_OK(cstk_pose_from_euler(here, pose));
    CHECK(strcmp(before, cstk_last_error_message()) == 0);
}

static void pose_from_euler(void) {
    double good[6] = {1, 2, 3, 0.1, 0.2, 0.3};
    double pose[12];
    CHECK_REFUSED(pose, cstk_pose_from_euler(NULL, pose), CSTK_ERROR_NULL_ARGUMENT, "xyz_ypr");
    CHECK_FAILS(cstk_pose_from_euler(good, NULL), CSTK_ERROR_NULL_ARGUMENT, "pose");
    for (int entry = 0; entry < 6; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[6];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(pose, cstk_pose_from_euler(bad, pose), CSTK_ERROR_NOT_FINITE, "xyz_ypr");
        }
    }
}

static void pose_from_rpy(void) {
    const double good[6] = {1, 2, 3, 0.1, 0.2, 0.3};
    double pose[12];
    CHECK_REFUSED(pose, cstk_pose_from_rpy(NULL, pose), CSTK_ERROR_NULL_ARGUMENT, "xyz_rpy");
    CHECK_FAILS(cstk_pose_from_rpy(good, NULL), CSTK_ERROR_NULL_ARGUMENT, "pose");
    for (int entry = 0; entry < 6; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[6];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(pose, cstk_pose_from_rpy(bad, pose), CSTK_ERROR_NOT_FINITE, "xyz_rpy");
        }
    }
    /* The rows by hand, for roll a, pitch b, yaw c. */
    const double a = good[3], b = good[4], c = good[5];
    const double want[12] = {cos(c) * cos(b), cos(c) * sin(b) * sin(a) - sin(c) * cos(a),
                             cos(c) * sin(b) * cos(a) + sin(c) * sin(a), 1,
                             sin(c) * cos(b), sin(c) * sin(b) * sin(a) + cos(c) * cos(a),
                             sin(c) * sin(b) * cos(a) - cos(c) * sin(a), 2,
                             -sin(b), cos(b) * sin(a), cos(b) * cos(a), 3};
    CHECK_OK(cstk_pose_from_rpy(good, pose));
    for (int i = 0; i < 12; ++i) {
        CHECK(fabs(pose[i] - want[i]) < 1e-15);
    }
}

static void pose_from_quaternion(void) {
    double good[7] = {1, 2, 3, 0.6, 0, 0, 0.8};
    double pose[12];
    CHECK_REFUSED(pose, cstk_pose_from_quaternion(NULL, pose), CSTK_ERROR_NULL_ARGUMENT,
                  "xyz_quaternion");
    CHECK_FAILS(cstk_pose_from_quaternion(good, NULL), CSTK_ERROR_NULL_ARGUMENT, "pose");
    for (int entry = 0; entry < 7; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[7];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(pose, cstk_pose_from_quaternion(bad, pose), CSTK_ERROR_NOT_FINITE,
                          "xyz_quaternion");
        }
    }
    double off[7] = {1, 2, 3, 0.6, 0, 0, 0.80001};
    CHECK_REFUSED(pose, cstk_pose_from_quaternion(off, pose), CSTK_ERROR_NOT_A_ROTATION, "norm");
    double zero[7] = {1, 2, 3, 0, 0, 0, 0};
    CHECK_REFUSED(pose, cstk_pose_from_quaternion(zero, pose), CSTK_ERROR_NOT_A_ROTATION, "norm");
}

static void pose_to_euler(void) {
    double out[6];
    CHECK_REFUSED(out, cstk_pose_to_euler(NULL, out), CSTK_ERROR_NULL_ARGUMENT, "pose_12");
    CHECK_FAILS(cstk_pose_to_euler(identity_pose, NULL), CSTK_ERROR_NULL_ARGUMENT, "xyz_ypr");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_to_euler(bad->pose, out), bad->status, "pose_12");
    }
}

static void pose_compose(void) {
    double out[12];
    const double *good = identity_pose;
    CHECK_REFUSED(out, cstk_pose_compose(NULL, good, out), CSTK_ERROR_NULL_ARGUMENT, "a is NULL");
    CHECK_REFUSED(out, cstk_pose_compose(good, NULL, out), CSTK_ERROR_NULL_ARGUMENT, "b is NULL");
    CHECK_FAILS(cstk_pose_compose(good, good, NULL), CSTK_ERROR_NULL_ARGUMENT, "out is NULL");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_compose(bad->pose, good, out), bad->status, "a: ");
        CHECK_REFUSED(out, cstk_pose_compose(good, bad->pose, out), bad->status, "b: ");
    }
}

static void pose_inverse(void) {
    double out[12];
    CHECK_REFUSED(out, cstk_pose_inverse(NULL, out), CSTK_ERROR_NULL_ARGUMENT, "pose_12");
    CHECK_FAILS(cstk_pose_inverse(identity_pose, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_inverse(bad->pose, out), bad->status, "pose_12");
    }
}

static void pose_transform_point(void) {
    const double good[3] = {1, 2, 3};
    double out[3];
    CHECK_REFUSED(out, cstk_pose_transform_point(NULL, good, out), CSTK_ERROR_NULL_ARGUMENT, "pose_12");
    CHECK_REFUSED(out, cstk_pose_transform_point(identity_pose, NULL, out), CSTK_ERROR_NULL_ARGUMENT,
                  "point");
    CHECK_FAILS(cstk_pose_transform_point(identity_pose, good, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_transform_point(bad->pose, good, out), bad->status, "pose_12");
    }
    for (int entry = 0; entry < 3; ++entry) {
        double bad[3] = {1, 2, 3};
        EACH_NOT_FINITE(i) {
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_pose_transform_point(identity_pose, bad, out), CSTK_ERROR_NOT_FINITE,
                          "point");
        }
        bad[entry] = 1.7e308;
        CHECK_REFUSED(out, cstk_pose_transform_point(identity_pose, bad, out),
                      CSTK_ERROR_INVALID_ARGUMENT, "point");
    }
}

static void pose_to_quaternion(void) {
    double out[7];
    CHECK_REFUSED(out, cstk_pose_to_quaternion(NULL, out), CSTK_ERROR_NULL_ARGUMENT, "pose_12");
    CHECK_FAILS(cstk_pose_to_quaternion(identity_pose, NULL), CSTK_ERROR_NULL_ARGUMENT, "xyz_quaternion");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_to_quaternion(bad->pose, out), bad->status, "pose_12");
    }
}

/* Off by less than 1e-6, a matrix is taken for the nearest rotation. */
static void nearly_a_rotation(void) {
    double given[12];
    double out[12];
    memcpy(given, identity_pose, sizeof given);
    given[1] = 4e-7;
    given[10] = 1 - 3e-7;
    CHECK_OK(cstk_pose_compose(given, identity_pose, out));
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            double dot = 0;
            for (int j = 0; j < 3; ++j) {
                dot += out[4 * j + i] * out[4 * j + k];
            }
            CHECK(fabs(dot - (i == k)) < 1e-15);
            CHECK(fabs(out[4 * i + k] - given[4 * i + k]) < 1e-6);
        }
    }
}

static void euler_to_rotation(void) {
    double good[3] = {0.1, 0.2, 0.3};
    double out[9];
    CHECK_REFUSED(out, cstk_euler_to_rotation(NULL, out), CSTK_ERROR_NULL_ARGUMENT, "yaw_pitch_roll");
    CHECK_FAILS(cstk_euler_to_rotation(good, NULL), CSTK_ERROR_NULL_ARGUMENT, "rotation");
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[3];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_euler_to_rotation(bad, out), CSTK_ERROR_NOT_FINITE, "yaw_pitch_roll");
        }
    }
}

static void euler_from_rotation(void) {
    const double good[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double out[3];
    CHECK_REFUSED(out, cstk_euler_from_rotation(NULL, out), CSTK_ERROR_NULL_ARGUMENT, "rotation");
    CHECK_FAILS(cstk_euler_from_rotation(good, NULL), CSTK_ERROR_NULL_ARGUMENT, "yaw_pitch_roll");
    EACH_BAD_POSE(bad) {
        const double *p = bad->pose;
        const double rotation[9] = {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]};
        if (memcmp(rotation, good, sizeof good) != 0) {
            CHECK_REFUSED(out, cstk_euler_from_rotation(rotation, out), bad->status, "rotation");
        }
    }
}

static const double quarter_turn = 1.57079632679489661923;

typedef cstk_status (*rates_fn)(const double *, int32_t, double *);

static void rates(rates_fn rates_at) {
    const double good[3] = {0.1, 0.2, 0.3};
    const int32_t frames[] = {-1, CSTK_ANGULAR_BODY + 1, INT32_MIN, INT32_MAX};
    double out[9];
    CHECK_REFUSED(out, rates_at(NULL, CSTK_ANGULAR_WORLD, out), CSTK_ERROR_NULL_ARGUMENT,
                  "yaw_pitch_roll");
    CHECK_FAILS(rates_at(good, CSTK_ANGULAR_WORLD, NULL), CSTK_ERROR_NULL_ARGUMENT, "matrix");
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, rates_at(good, frames[i], out), CSTK_ERROR_INVALID_ARGUMENT, "frame");
    }
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[3] = {0.1, 0.2, 0.3};
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, rates_at(bad, CSTK_ANGULAR_BODY, out), CSTK_ERROR_NOT_FINITE,
                          "yaw_pitch_roll");
        }
    }
}

static void euler_rates(void) {
    rates(cstk_euler_rates);
    rates(cstk_euler_rates_inverse);
    double out[9];
    for (int32_t frame = CSTK_ANGULAR_WORLD; frame <= CSTK_ANGULAR_BODY; ++frame) {
        for (int turns = -3; turns <= 3; turns += 2) {
            const double singular[3] = {0.1, turns * quarter_turn, 0.3};
            CHECK_OK(cstk_euler_rates(singular, frame, out));
            CHECK_REFUSED(out, cstk_euler_rates_inverse(singular, frame, out), CSTK_ERROR_DEGENERATE,
                          "pitch");
        }
    }
}

typedef cstk_status (*convert_fn)(const double *, double *, size_t);

/* Jacobians are converted in place: one that is refused stays as it is. */
static void refuse_jacobian(convert_fn convert, const double *angles, const double given[12],
                            size_t nv, cstk_status status, const char *culprit) {
    double jacobian[12];
    memcpy(jacobian, given, sizeof jacobian);
    CHECK_FAILS(convert(angles, jacobian, nv), status, culprit);
    if (memcmp(jacobian, given, sizeof jacobian) != 0) {
        fprintf(stderr, "  and changed the Jacobian\n");
        ++check_failures;
    }
}

static void jacobians(convert_fn convert) {
    const double angles[3] = {0.1, 1.5, 0.3};
    double given[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    refuse_jacobian(convert, NULL, given, 2, CSTK_ERROR_NULL_ARGUMENT, "yaw_pitch_roll");
    CHECK_FAILS(convert(angles, NULL, 2), CSTK_ERROR_NULL_ARGUMENT, "jacobian");
    const size_t counts[] = {SIZE_MAX, SIZE_MAX / 6 + 1, SIZE_MAX / 48 + 1};
    for (int i = 0; i < 3; ++i) {
        refuse_jacobian(convert, angles, given, counts[i], CSTK_ERROR_WRONG_SIZE, "jacobian");
    }
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[3] = {0.1, 0.2, 0.3};
            bad[entry] = not_finite[i];
            refuse_jacobian(convert, bad, given, 2, CSTK_ERROR_NOT_FINITE, "yaw_pitch_roll");
        }
    }
    for (int entry = 0; entry < 12; ++entry) {
        const double good = given[entry];
        EACH_NOT_FINITE(i) {
            given[entry] = not_finite[i];
            refuse_jacobian(convert, angles, given, 2, CSTK_ERROR_NOT_FINITE, "jacobian");
        }
        given[entry] = good;
    }
    /* Entries that are finite, but of which the conversion would make infinite ones. */
    for (int entry = 6; entry < 12; ++entry) {
        given[entry] = 1.7e308;
    }
    refuse_jacobian(convert, angles, given, 2, CSTK_ERROR_INVALID_ARGUMENT, "jacobian");
}

static void euler_jacobians(void) {
    jacobians(cstk_jacobian_to_euler);
    jacobians(cstk_jacobian_from_euler);
    const double singular[3] = {0.1, -quarter_turn, 0.3};
    double given[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    refuse_jacobian(cstk_jacobian_to_euler, singular, given, 2, CSTK_ERROR_DEGENERATE, "pitch");
    CHECK_OK(cstk_jacobian_from_euler(singular, given, 2));
    /* A Jacobian by no coordinates has no entries. */
    CHECK_OK(cstk_jacobian_to_euler(identity_pose, NULL, 0));
    CHECK_OK(cstk_jacobian_from_euler(identity_pose, NULL, 0));
}

/* The same trials for every _default function: NULL, sizes that are none; a larger size is a later
 * version's. */
#define DEFAULTS_OF(type, write)                                                                   \
    static void type##_trials(void) {                                                              \
        union {                                                                                    \
            type options;                                                                          \
            unsigned char bytes[sizeof(type) + 16];                                                \
        } out;                                                                                     \
        const size_t wrong[] = {0, 1, 4, 8, sizeof(type) - 1, SIZE_MAX, (size_t)UINT32_MAX + 1};   \
        CHECK_FAILS(write(NULL, sizeof(type)), CSTK_ERROR_NULL_ARGUMENT, "out");                         \
        for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {                              \
            CHECK_REFUSED(out, write(&out.options, wrong[i]), CSTK_ERROR_WRONG_SIZE, "size");            \
        }                                                                                          \
        memset(&out, CHECK_SENTINEL, sizeof out);                                                  \
        CHECK_OK(write(&out.options, sizeof(type) + 8));                                           \
        CHECK(out.options.size == sizeof(type) + 8);                                               \
        for (size_t i = 0; i < 16; ++i) {                                                          \
            CHECK(out.bytes[sizeof(type) + i] == (i < 8 ? 0 : CHECK_SENTINEL));                    \
        }                                                                                          \
    }

DEFAULTS_OF(cstk_hierarchy_options, cstk_hierarchy_options_default)
DEFAULTS_OF(cstk_link_def, cstk_link_def_default)
DEFAULTS_OF(cstk_custom_joint, cstk_custom_joint_default)
DEFAULTS_OF(cstk_environment_change, cstk_environment_change_default)
DEFAULTS_OF(cstk_induced_options, cstk_induced_options_default)
DEFAULTS_OF(cstk_pure_options, cstk_pure_options_default)
DEFAULTS_OF(cstk_predicate, cstk_predicate_default)
DEFAULTS_OF(cstk_slide_options, cstk_slide_options_default)
DEFAULTS_OF(cstk_motion_options, cstk_motion_options_default)
DEFAULTS_OF(cstk_clearance_options, cstk_clearance_options_default)
DEFAULTS_OF(cstk_shortcut_options, cstk_shortcut_options_default)
DEFAULTS_OF(cstk_slide_to_options, cstk_slide_to_options_default)

/* Callers compiled with an earlier header have smaller structures. */
static void earlier_sizes(void) {
    enum { LINK_DEF = 160, SLIDE_OPTIONS = 32 };
    union {
        cstk_link_def def;
        cstk_slide_options slide;
        unsigned char bytes[sizeof(cstk_link_def)];
    } out;
    memset(&out, CHECK_SENTINEL, sizeof out);
    CHECK_OK(cstk_slide_options_default(&out.slide, SLIDE_OPTIONS));
    check_untouched(out.bytes + SLIDE_OPTIONS, sizeof out - SLIDE_OPTIONS, "slide_options",
                    __FILE__, __LINE__);
    memset(&out, CHECK_SENTINEL, sizeof out);
    CHECK_OK(cstk_link_def_default(&out.def, LINK_DEF));
    check_untouched(out.bytes + LINK_DEF, sizeof out - LINK_DEF, "link_def", __FILE__, __LINE__);
    /* The sentinels would be a bad joint name, multiplier and so on, if they were read. */
    cstk_robot_builder *builder = NULL;
    out.def.joint = CSTK_JOINT_REVOLUTE;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, &out.def, NULL));
    CHECK_OK(cstk_robot_builder_release(builder));
}

int main(void) {
    texts();
    pose_from_euler();
    pose_from_rpy();
    pose_from_quaternion();
    pose_to_euler();
    pose_compose();
    pose_inverse();
    pose_transform_point();
    pose_to_quaternion();
    nearly_a_rotation();
    euler_to_rotation();
    euler_from_rotation();
    euler_rates();
    euler_jacobians();
    cstk_hierarchy_options_trials();
    cstk_link_def_trials();
    cstk_custom_joint_trials();
    cstk_environment_change_trials();
    cstk_induced_options_trials();
    cstk_pure_options_trials();
    cstk_predicate_trials();
    cstk_slide_options_trials();
    cstk_motion_options_trials();
    cstk_clearance_options_trials();
    cstk_shortcut_options_trials();
    cstk_slide_to_options_trials();
    earlier_sizes();
    return check_result();
}
