#include "obstacles.hpp"

#include <cmath>
#include <cstddef>

namespace {

// Closed: rows of vertices between two poles.
Surface bumpy_ball(std::array<double, 3> center, double radius, std::size_t rows,
                   std::size_t columns) {
    const double pi = std::acos(-1.0);
    Surface made;
    const auto add = [&](double down, double around) {
        const double r = radius * (1 + 0.12 * std::sin(7 * down) * std::cos(5 * around));
        made.vertices.insert(made.vertices.end(),
                             {center[0] + r * std::sin(down) * std::cos(around),
                              center[1] + r * std::sin(down) * std::sin(around),
                              center[2] + r * std::cos(down)});
    };
    add(0, 0);
    for (std::size_t i = 1; i <= rows; ++i) {
        for (std::size_t k = 0; k < columns; ++k) {
            add(pi * static_cast<double>(i) / static_cast<double>(rows + 1),
                2 * pi * static_cast<double>(k) / static_cast<double>(columns));
        }
    }
    add(pi, 0);
    const auto at = [&](std::size_t row, std::size_t column) {
        return static_cast<std::uint32_t>(1 + row * columns + column % columns);
    };
    const auto last = static_cast<std::uint32_t>(1 + rows * columns);
    for (std::size_t k = 0; k < columns; ++k) {
        made.triangles.insert(made.triangles.end(), {0, at(0, k), at(0, k + 1)});
        made.triangles.insert(made.triangles.end(),
                              {last, at(rows - 1, k + 1), at(rows - 1, k)});
        for (std::size_t i = 0; i + 1 < rows; ++i) {
            made.triangles.insert(made.triangles.end(), {at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            made.triangles.insert(made.triangles.end(),
                                  {at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    }
    return made;
}

} // namespace

Obstacles boxes_around() {
    return {{{{0.6, 0, -0.05}, {0.4, 0.6, 0.04}},
             {{0.45, 0.45, 0.4}, {0.05, 0.05, 0.4}},
             {{0.45, -0.45, 0.4}, {0.05, 0.05, 0.4}},
             {{0.6, 0, 0.85}, {0.3, 0.5, 0.02}},
             {{-0.75, 0, 0.5}, {0.02, 0.8, 0.55}}},
            {}};
}

Obstacles boxes_and_ball() {
    Obstacles all = boxes_around();
    all.surfaces.push_back(bumpy_ball({0.62, 0.1, 0.3}, 0.15, 32, 32));
    return all;
}

Obstacles box_out_of_reach() { return {{{{100, 0, 0}, {0.1, 0.1, 0.1}}}, {}}; }
