// Samples of a motion in order, until the first that hits.
#pragma once

#include "variant.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// How far apart samples are.
struct Step {
    const char *name;
    /// In C-space; 0 for a step that moves no point by more than `metres`.
    double length, metres;

    std::size_t count(const Segment &segment) const {
        const double parts = length > 0 ? segment.length / length : segment.speed / metres;
        // A length of 0.3 has 6 steps of 0.05, whatever rounding says.
        return static_cast<std::size_t>(std::max(std::ceil(parts - 1e-9), 1.0));
    }
};

const Step steps[] = {
    {"sampled 0.05", 0.05, 0}, {"sampled 0.01", 0.01, 0}, {"sampled 1 mm", 0, 1e-3}};

/// Both ends are looked at. `meets` takes a configuration.
template <class Meets>
Verdict sampled(const cstk::Space &space, const Segment &segment, const Step &step, Numbers &q,
                Meets meets) {
    const std::size_t count = step.count(segment);
    const Ends &ends = segment.ends;
    q.resize(ends.q0.size());
    for (std::size_t i = 0; i <= count; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(count);
        cstk::check(cstk_space_interpolate(space.get(), ends.q0.data(), ends.q1.data(), q.size(), t,
                                           q.data()));
        if (meets(q)) {
            return {true, i + 1, t};
        }
    }
    return {false, count + 1, {}};
}
