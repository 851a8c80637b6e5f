// Where a link is, for planners that cover the workspace by cells.
#pragma once

#include "state_space.hpp"

#include <ompl/base/ProjectionEvaluator.h>

#include <cstdint>
#include <vector>

namespace cstk_ompl {

/// Projects a state to the origin of a link's frame in the world: for KPIECE, EST or PDST, with the last link of an arm. Links are
/// numbered through the cstk_space.
class LinkProjection : public ompl::base::ProjectionEvaluator {
  public:
    /// Cells are cubes with this side, a length.
    LinkProjection(const StateSpace &space, std::uint32_t link, double cell)
        : ProjectionEvaluator(&space), state_space_(space), link_(link), cell_(cell) {
        // Of default projections OMPL keeps those alone whose cells a caller has set.
        setCellSizes({cell, cell, cell});
    }

    unsigned int getDimension() const override { return 3; }
    void defaultCellSizes() override { cellSizes_.assign(3, cell_); }

    void project(const ompl::base::State *state, Eigen::Ref<Eigen::VectorXd> projection) const override {
        const cstk::Pose pose = state_space_.space().link_poses(state_space_.configuration(state)).at(link_);
        projection << pose[3], pose[7], pose[11];
    }

  private:
    const StateSpace &state_space_;
    std::uint32_t link_;
    double cell_;
};

} // namespace cstk_ompl
