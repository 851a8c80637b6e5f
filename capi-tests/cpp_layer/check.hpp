// Assertions of the tests of the C++ layer.
#ifndef CSTK_TESTS_CPP_LAYER_CHECK_HPP
#define CSTK_TESTS_CPP_LAYER_CHECK_HPP

#include <cstk.hpp>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

inline void require(bool condition, const char *what) {
    if (!condition) {
        std::fprintf(stderr, "failed: %s\n", what);
        std::exit(1);
    }
}

#define REQUIRE(condition) require(condition, #condition)

template <typename Action> cstk_status status_of(Action action) {
    try {
        action();
    } catch (const cstk::Error &error) {
        REQUIRE(std::string(error.what()).find(": ") != std::string::npos);
        return error.status();
    }
    return CSTK_OK;
}

/// The layer itself refuses what it could not hand on.
template <typename Action> bool is_invalid(Action action) {
    try {
        action();
    } catch (const std::invalid_argument &) {
        return true;
    }
    return false;
}

#endif
