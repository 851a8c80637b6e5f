// Whether a configuration is free, and how far it is from contact.
#pragma once

#include "state_space.hpp"
#include "thread_query.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

namespace cstk_ompl {

/// States outside of the set `contact`, within the limits and within the world box are valid. Of a StateSpace.
class ValidityChecker : public ompl::base::StateValidityChecker {
  public:
    ValidityChecker(const ompl::base::SpaceInformationPtr &information, const cstk::CObject &contact)
        : StateValidityChecker(information), space_(*information->getStateSpace()->as<StateSpace>()), contact_(contact),
          kept_out_of_(space_.with_world(contact)) {
        specs_.clearanceComputationType = ompl::base::StateValidityCheckerSpecs::EXACT;
    }

    bool isValid(const ompl::base::State *state) const override {
        return space_.satisfiesBounds(state) &&
               thread_query().classify(kept_out_of_, space_.configuration(state)) != CSTK_CLASS_INSIDE;
    }

    /// The distance from contact; 0 inside. The world box is not counted.
    double clearance(const ompl::base::State *state) const override {
        return thread_query().distance(contact_, space_.configuration(state)).distance;
    }

    bool isValid(const ompl::base::State *state, double &distance) const override {
        distance = clearance(state);
        return isValid(state);
    }

  private:
    const StateSpace &space_;
    cstk::CObject contact_;
    cstk::CObject kept_out_of_;
};

} // namespace cstk_ompl
