// C-space cut into cells, coordinate by coordinate.
#ifndef SANDROS_GRID_HPP
#define SANDROS_GRID_HPP

#include "problem.hpp"

namespace sandros {

/// A set of configurations: the coordinates of the first axes are within one cell each, the others
/// are free. No cells stand for the whole of C-space.
using Cells = std::vector<std::size_t>;

/// Throws std::invalid_argument unless there is one axis for each coordinate, and no quaternion.
void require_axes(const Problem &problem);

class Grid {
  public:
    /// Every coordinate's cells are halved `halvings` times.
    Grid(const Problem &problem, unsigned halvings);

    std::size_t axis_count() const { return axes_.size(); }
    std::size_t cell_count(std::size_t axis) const { return axes_[axis].count; }

    std::size_t cell_of(std::size_t axis, const Configuration &q) const;

    /// The two sets have a face in common.
    bool adjacent(const Cells &a, const Cells &b) const;

    /// The least and the greatest configuration of the set; coordinates that are free have the
    /// value of `rest`.
    Configuration low(const Cells &cells, const Configuration &rest) const;
    Configuration high(const Cells &cells, const Configuration &rest) const;

    /// The least and the greatest of a box within the set, a quarter of a cell from its faces: free
    /// coordinates reach from -infinity to infinity.
    Configuration inner_low(const Cells &cells) const;
    Configuration inner_high(const Cells &cells) const;

  private:
    struct CutAxis {
        std::size_t coordinate, count;
        double low, width;
        bool circle;
    };

    /// The configuration that is so far along each cell: at part 0 its least, at 1 its greatest.
    Configuration within(const Cells &cells, double part, const Configuration &rest) const;

    std::vector<CutAxis> axes_;
};

} // namespace sandros

#endif
