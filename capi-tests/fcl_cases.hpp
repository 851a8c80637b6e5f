// Poses at which FCL 0.7 was seen to answer wrongly, with the true answers (long double brute
// force).
//
// Both are two discs of radius 1.2 and thickness 0.01 whose caps are 1e-9 apart along z or x. FCL's
// distance is 0, though its own collide says that they do not meet; the truth is the gap. FCL takes
// a pair of triangles to overlap when none of the separating directions it tries shows a gap, and
// the caps' triangles are slivers (64 sides), where that test rounds.
#ifndef CSTK_FCL_CASES_HPP
#define CSTK_FCL_CASES_HPP

#include <vector>

namespace cases {

struct Kept {
    const char *name;
    const char *body_a;
    const char *body_b;
    double pose_a[12];
    double pose_b[12];
    double distance;
};

inline std::vector<Kept> kept() {
    return {
        {"discs 1e-9 apart along z",
         "disc",
         "disc",
         {1, 0, 0, -0.5, 0, -1, 0, 0.25, 0, 0, -1, -1},
         {0, 1, 0, -0.5, 1, 0, 0, 0.24999999999999994, 0, 0, -1, -0.98999999900000013},
         9.9999986936938345e-10},
        {"discs 1e-9 apart along x",
         "disc",
         "disc",
         {0, 0, -1, 0.25, -1, 0, 0, 0.75, 0, 1, 0, 0},
         {0, 0, -1, 0.26000000099999987, 0, 1, 0, 0.75, 1, 0, 0, 2.204364237451219e-16},
         9.9999986936938345e-10},
    };
}

} // namespace cases

#endif
