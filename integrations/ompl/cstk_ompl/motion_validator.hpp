// Whether a whole motion is free, proved.
#pragma once

#include "state_space.hpp"
#include "thread_query.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <utility>

namespace cstk_ompl {

/// A motion is valid if cstk_motion proves it free of the set `contact` and of places beyond the world box, and its last state is valid
/// for the space's StateValidityChecker, which may know of more than contacts. As OMPL has it, the first state of a motion is valid, and
/// the limits are an interval each, which a motion between two states does not leave.
class MotionValidator : public ompl::base::MotionValidator {
  public:
    MotionValidator(const ompl::base::SpaceInformationPtr &information, const cstk::CObject &contact)
        : ompl::base::MotionValidator(information), space_(*information->getStateSpace()->as<StateSpace>()),
          kept_out_of_(space_.with_world(contact)) {}

    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to) const override {
        cstk_motion_options any = cstk::motion_options();
        any.any_contact = 1;
        return counted(si_->isValid(to) && ask(from, to, any).outcome == CSTK_MOTION_FREE);
    }

    /// The last valid state is the end of what is proved free: two millionths of the motion before its first contact. Of a motion
    /// that leaves the limits, or whose last state alone is not valid, it is the first state.
    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to,
                     std::pair<ompl::base::State *, double> &last_valid) const override {
        const cstk_motion_options options = cstk::motion_options();
        const cstk_motion_result found = ask(from, to, options);
        const bool is_free = found.outcome == CSTK_MOTION_FREE;
        if (counted(is_free && si_->isValid(to))) {
            return true;
        }
        const bool ends_in_contact = !is_free && space_.satisfiesBounds(to);
        last_valid.second = ends_in_contact ? std::max(0.0, found.times[0] - options.tolerance) : 0;
        if (last_valid.first != nullptr) {
            space_.interpolate(from, to, last_valid.second, last_valid.first);
        }
        return false;
    }

  private:
    cstk_motion_result ask(const ompl::base::State *from, const ompl::base::State *to,
                           const cstk_motion_options &options) const {
        return thread_query().motion(kept_out_of_, space_.configuration(from), space_.configuration(to), options);
    }

    /// OMPL's benchmarks tell how many motions were valid.
    bool counted(bool is_valid) const {
        ++(is_valid ? valid_ : invalid_);
        return is_valid;
    }

    const StateSpace &space_;
    cstk::CObject kept_out_of_;
};

} // namespace cstk_ompl
