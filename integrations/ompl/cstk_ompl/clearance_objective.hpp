// Paths that keep far from contact.
#pragma once

#include "state_space.hpp"
#include "thread_query.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>

namespace cstk_ompl {

/// The cost of a motion is its clearance: no state of it is nearer to the set `contact`, proved by cstk_motion_clearance. The
/// larger the better; a path costs as much as its nearest motion.
class ClearanceObjective : public ompl::base::MaximizeMinClearanceObjective {
  public:
    /// Clearances are known to within `tolerance`, a length.
    ClearanceObjective(const ompl::base::SpaceInformationPtr &information, const cstk::CObject &contact, double tolerance)
        : MaximizeMinClearanceObjective(information), space_(*information->getStateSpace()->as<StateSpace>()),
          contact_(contact), options_(cstk::clearance_options(tolerance)) {}

    ompl::base::Cost motionCost(const ompl::base::State *from, const ompl::base::State *to) const override {
        return ompl::base::Cost(
            thread_query()
                .motion_clearance(contact_, space_.configuration(from), space_.configuration(to), options_)
                .lower);
    }

  private:
    const StateSpace &space_;
    cstk::CObject contact_;
    cstk_clearance_options options_;
};

} // namespace cstk_ompl
