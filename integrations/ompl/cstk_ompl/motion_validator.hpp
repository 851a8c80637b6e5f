// Whether a whole motion is free, proved.
#pragma once

#include "state_space.hpp"
#include "thread_query.hpp"

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <utility>

namespace cstk_ompl {

/// A motion is valid if cstk_motion proves it free of the set `contact`. OMPL's samples come first, since one that is not valid
/// spares a proof; they may be far apart (SpaceInformation::setStateValidityCheckingResolution). As OMPL has it, the first state of
/// a motion is valid, and the limits are an interval each, which a motion between two states does not leave.
class MotionValidator : public ompl::base::DiscreteMotionValidator {
  public:
    MotionValidator(const ompl::base::SpaceInformationPtr &information, const cstk::CObject &contact)
        : DiscreteMotionValidator(information), space_(*information->getStateSpace()->as<StateSpace>()), contact_(contact) {}

    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to) const override {
        // The base class counts valid motions and others.
        if (!DiscreteMotionValidator::checkMotion(from, to)) {
            return false;
        }
        cstk_motion_options any = cstk::motion_options();
        any.any_contact = 1;
        return counted(ask(from, to, any).outcome == CSTK_MOTION_FREE);
    }

    /// The last valid state is the end of what is proved free: two millionths of the motion before its first contact. Of a motion
    /// that leaves the limits it is the first state.
    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to,
                     std::pair<ompl::base::State *, double> &last_valid) const override {
        const cstk_motion_options options = cstk::motion_options();
        const cstk_motion_result found = ask(from, to, options);
        const bool stays_within_limits = space_.satisfiesBounds(to);
        if (found.outcome == CSTK_MOTION_FREE && stays_within_limits) {
            ++valid_;
            return true;
        }
        ++invalid_;
        last_valid.second = stays_within_limits ? std::max(0.0, found.times[0] - options.tolerance) : 0;
        if (last_valid.first != nullptr) {
            space_.interpolate(from, to, last_valid.second, last_valid.first);
        }
        return false;
    }

  private:
    cstk_motion_result ask(const ompl::base::State *from, const ompl::base::State *to,
                           const cstk_motion_options &options) const {
        return thread_query().motion(contact_, space_.configuration(from), space_.configuration(to), options);
    }

    /// A motion whose samples were counted as valid.
    bool counted(bool is_free) const {
        if (!is_free) {
            --valid_;
            ++invalid_;
        }
        return is_free;
    }

    const StateSpace &space_;
    cstk::CObject contact_;
};

} // namespace cstk_ompl
