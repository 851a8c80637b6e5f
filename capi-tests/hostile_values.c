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
    CHECK(strcmp(cstk_status_name(CSTK_INTERNAL), "CSTK_INTERNAL") == 0);
    const int32_t none[] = {-1, CSTK_INTERNAL + 1, INT32_MIN, INT32_MAX};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; ++i) {
        CHECK(strcmp(cstk_status_name(none[i]), "unknown status") == 0);
    }
    /* Success leaves the message of the last failure alone. */
    char before[256];
    double pose[12];
    const double here[6] = {0};
    CHECK_FAILS(cstk_pose_from_euler(NULL, pose), CSTK_NULL_ARGUMENT, "xyz_ypr");
    snprintf(before, sizeof before, "%s", cstk_last_error_message());
    CHECK_OK(cstk_pose_from_euler(here, pose));
    CHECK(strcmp(before, cstk_last_error_message()) == 0);
}

static void pose_from_euler(void) {
    double good[6] = {1, 2, 3, 0.1, 0.2, 0.3};
    double pose[12];
    CHECK_REFUSED(pose, cstk_pose_from_euler(NULL, pose), CSTK_NULL_ARGUMENT, "xyz_ypr");
    CHECK_FAILS(cstk_pose_from_euler(good, NULL), CSTK_NULL_ARGUMENT, "pose");
    for (int entry = 0; entry < 6; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[6];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(pose, cstk_pose_from_euler(bad, pose), CSTK_NOT_FINITE, "xyz_ypr");
        }
    }
}

static void pose_from_quaternion(void) {
    double good[7] = {1, 2, 3, 0.6, 0, 0, 0.8};
    double pose[12];
    CHECK_REFUSED(pose, cstk_pose_from_quaternion(NULL, pose), CSTK_NULL_ARGUMENT,
                  "xyz_quaternion");
    CHECK_FAILS(cstk_pose_from_quaternion(good, NULL), CSTK_NULL_ARGUMENT, "pose");
    for (int entry = 0; entry < 7; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[7];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(pose, cstk_pose_from_quaternion(bad, pose), CSTK_NOT_FINITE,
                          "xyz_quaternion");
        }
    }
    double off[7] = {1, 2, 3, 0.6, 0, 0, 0.80001};
    CHECK_REFUSED(pose, cstk_pose_from_quaternion(off, pose), CSTK_NOT_A_ROTATION, "norm");
    double zero[7] = {1, 2, 3, 0, 0, 0, 0};
    CHECK_REFUSED(pose, cstk_pose_from_quaternion(zero, pose), CSTK_NOT_A_ROTATION, "norm");
}

static void pose_to_euler(void) {
    double out[6];
    CHECK_REFUSED(out, cstk_pose_to_euler(NULL, out), CSTK_NULL_ARGUMENT, "pose_12");
    CHECK_FAILS(cstk_pose_to_euler(identity_pose, NULL), CSTK_NULL_ARGUMENT, "xyz_ypr");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_to_euler(bad->pose, out), bad->status, "pose_12");
    }
}

static void pose_compose(void) {
    double out[12];
    const double *good = identity_pose;
    CHECK_REFUSED(out, cstk_pose_compose(NULL, good, out), CSTK_NULL_ARGUMENT, "a is NULL");
    CHECK_REFUSED(out, cstk_pose_compose(good, NULL, out), CSTK_NULL_ARGUMENT, "b is NULL");
    CHECK_FAILS(cstk_pose_compose(good, good, NULL), CSTK_NULL_ARGUMENT, "out is NULL");
    EACH_BAD_POSE(bad) {
        CHECK_REFUSED(out, cstk_pose_compose(bad->pose, good, out), bad->status, "a: ");
        CHECK_REFUSED(out, cstk_pose_compose(good, bad->pose, out), bad->status, "b: ");
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
    CHECK_REFUSED(out, cstk_euler_to_rotation(NULL, out), CSTK_NULL_ARGUMENT, "yaw_pitch_roll");
    CHECK_FAILS(cstk_euler_to_rotation(good, NULL), CSTK_NULL_ARGUMENT, "rotation");
    for (int entry = 0; entry < 3; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[3];
            memcpy(bad, good, sizeof bad);
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_euler_to_rotation(bad, out), CSTK_NOT_FINITE, "yaw_pitch_roll");
        }
    }
}

static void euler_from_rotation(void) {
    const double good[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double out[3];
    CHECK_REFUSED(out, cstk_euler_from_rotation(NULL, out), CSTK_NULL_ARGUMENT, "rotation");
    CHECK_FAILS(cstk_euler_from_rotation(good, NULL), CSTK_NULL_ARGUMENT, "yaw_pitch_roll");
    EACH_BAD_POSE(bad) {
        const double *p = bad->pose;
        const double rotation[9] = {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]};
        if (memcmp(rotation, good, sizeof good) != 0) {
            CHECK_REFUSED(out, cstk_euler_from_rotation(rotation, out), bad->status, "rotation");
        }
    }
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
        CHECK_FAILS(write(NULL, sizeof(type)), CSTK_NULL_ARGUMENT, "out");                         \
        for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {                              \
            CHECK_REFUSED(out, write(&out.options, wrong[i]), CSTK_WRONG_SIZE, "size");            \
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
DEFAULTS_OF(cstk_environment_change, cstk_environment_change_default)
DEFAULTS_OF(cstk_cobject_options, cstk_cobject_options_default)
DEFAULTS_OF(cstk_slide_options, cstk_slide_options_default)

int main(void) {
    texts();
    pose_from_euler();
    pose_from_quaternion();
    pose_to_euler();
    pose_compose();
    nearly_a_rotation();
    euler_to_rotation();
    euler_from_rotation();
    cstk_hierarchy_options_trials();
    cstk_link_def_trials();
    cstk_environment_change_trials();
    cstk_cobject_options_trials();
    cstk_slide_options_trials();
    return check_result();
}
