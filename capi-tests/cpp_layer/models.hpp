// The bodies, robots and spaces that several tests of the C++ layer use.
#ifndef CSTK_TESTS_CPP_LAYER_MODELS_HPP
#define CSTK_TESTS_CPP_LAYER_MODELS_HPP

#include <cstk.hpp>

/// The corners of the unit cube.
inline constexpr double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                  0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

/// A sliding joint, one that mimics it, one that moves freely, and one of the caller's.
cstk::Robot make_robot(int &calls);

/// A cube that a rail moves along x, between -5 and 5; a wheel turns nothing.
cstk::Space make_space(const cstk::Body &body);

/// For user data that is a count: adds 100.
void count(void *calls);

#endif
