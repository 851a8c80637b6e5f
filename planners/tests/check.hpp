// What a test expects.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

inline void expect(bool holds, const std::string &what) {
    if (!holds) {
        std::fprintf(stderr, "FAILED: %s\n", what.c_str());
        std::exit(1);
    }
}
