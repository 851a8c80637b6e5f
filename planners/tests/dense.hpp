// Paths judged by many samples.
#pragma once

#include "problem.hpp"

#include <cstddef>
#include <vector>

/// Calls `look` with so many configurations of each segment, its end among them. Returns false as soon as `look` does.
template <class Look>
bool everywhere(const cstk::Space &space, const std::vector<problems::Configuration> &path, std::size_t samples, Look look) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        for (std::size_t k = 1; k <= samples; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(samples);
            if (!look(space.interpolate(path[i], path[i + 1], t))) {
                return false;
            }
        }
    }
    return true;
}
