#include "grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sandros {

namespace {

const double pi = 3.14159265358979323846;

/// The same angle between -pi and pi.
double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

} // namespace

void require_axes(const Problem &problem) {
    std::vector<bool> has_axis(problem.space.nq());
    bool is_one_each = problem.space.nq() == problem.space.nv() && problem.axes.size() == has_axis.size();
    for (const Axis &axis : problem.axes) {
        is_one_each = is_one_each && axis.coordinate < has_axis.size() && !has_axis[axis.coordinate];
        if (is_one_each) {
            has_axis[axis.coordinate] = true;
        }
    }
    if (!is_one_each) {
        throw std::invalid_argument(problem.name +
                                    ": there is one axis for each coordinate, and no quaternion");
    }
}

Grid::Grid(const Problem &problem, unsigned halvings) {
    require_axes(problem);
    for (const Axis &axis : problem.axes) {
        const cstk_range range = problem.space.range(axis.coordinate);
        const bool circle = range.kind == CSTK_RANGE_CIRCLE;
        const double low = circle ? -pi : range.lower;
        const double high = circle ? pi : range.upper;
        if (!std::isfinite(high - low) || axis.cells == 0) {
            throw std::invalid_argument(problem.name + ": coordinate " +
                                        std::to_string(axis.coordinate) +
                                        " has no range to cut into cells");
        }
        const std::size_t count = axis.cells << halvings;
        axes_.push_back(
            {axis.coordinate, count, low, (high - low) / static_cast<double>(count), circle});
    }
}

std::size_t Grid::cell_of(std::size_t axis, const Configuration &q) const {
    const CutAxis &cut = axes_[axis];
    const double value = cut.circle ? wrapped(q[cut.coordinate]) : q[cut.coordinate];
    const double place = std::floor((value - cut.low) / cut.width);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cut.count - 1)));
}

bool Grid::adjacent(const Cells &a, const Cells &b) const {
    const std::size_t common = std::min(a.size(), b.size());
    std::size_t faces = 0;
    for (std::size_t i = 0; i < common; ++i) {
        const std::size_t apart = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
        if (apart == 0) {
            continue;
        }
        const bool around = axes_[i].circle && apart + 1 == axes_[i].count;
        if (++faces > 1 || (apart > 1 && !around)) {
            return false;
        }
    }
    return faces == 1;
}

Configuration Grid::within(const Cells &cells, double part, const Configuration &rest) const {
    Configuration q = rest;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const CutAxis &cut = axes_[i];
        q[cut.coordinate] = cut.low + cut.width * (static_cast<double>(cells[i]) + part);
    }
    return q;
}

Configuration Grid::low(const Cells &cells, const Configuration &rest) const {
    return within(cells, 0, rest);
}

Configuration Grid::high(const Cells &cells, const Configuration &rest) const {
    return within(cells, 1, rest);
}

Configuration Grid::inner_low(const Cells &cells) const {
    return within(cells, 0.25, Configuration(axes_.size(), -INFINITY));
}

Configuration Grid::inner_high(const Cells &cells) const {
    return within(cells, 0.75, Configuration(axes_.size(), INFINITY));
}

} // namespace sandros
