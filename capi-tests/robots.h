/* Robots, joints and comparisons that the tests of kinematics share. */
#ifndef CSTK_TESTS_ROBOTS_H
#define CSTK_TESTS_ROBOTS_H

#include <cstk.h>

/* The sizes of a free joint. */
enum { FREE_NQ = 7, FREE_NV = 6 };

/* Whether all entries differ by at most this. */
bool near(const double *a, const double *b, size_t count, double tolerance);

double length_of(const double *v, size_t count);

/* A pose turned about z by an angle, and shifted. */
void turned(double angle, double x, double y, double z, double pose[12]);

/* A joint of the caller's: by one coordinate a screw about z, whose pitch is its user data. */
cstk_custom_joint screw(double *pitch);

/* A joint of the caller's that moves as CSTK_JOINT_PLANAR does. */
cstk_custom_joint plane(void);

/* A robot of one link. */
cstk_robot *make_robot(const cstk_link_def *def);

/* The space of one robot; no ranges for the defaults. */
cstk_space *space_of(const cstk_robot *robot, const cstk_range *ranges, size_t count);

/* The default link with a joint of this kind. */
cstk_link_def link_of(int32_t joint);

#endif
