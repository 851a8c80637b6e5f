// A problem as OMPL takes it.
#pragma once

#include "cstk_ompl/motion_validator.hpp"
#include "cstk_ompl/state_space.hpp"
#include "cstk_ompl/validity_checker.hpp"
#include "problem.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>

#include <memory>
#include <vector>

inline ompl::base::ScopedState<> state_at(const ompl::base::StateSpacePtr &space, const problems::Configuration &q) {
    ompl::base::ScopedState<> state(space);
    space->as<cstk_ompl::StateSpace>()->set(state.get(), q);
    return state;
}

/// Valid is what cstk_classify and cstk_motion call free.
inline std::shared_ptr<ompl::geometric::SimpleSetup> proved_setup(const problems::Problem &problem) {
    const problems::Workcell &cell = *problem.workcell;
    const auto space = std::make_shared<cstk_ompl::StateSpace>(cell.space);
    auto setup = std::make_shared<ompl::geometric::SimpleSetup>(space);
    const ompl::base::SpaceInformationPtr &information = setup->getSpaceInformation();
    setup->setStateValidityChecker(std::make_shared<cstk_ompl::ValidityChecker>(information, cell.contact));
    information->setMotionValidator(std::make_shared<cstk_ompl::MotionValidator>(information, cell.contact));
    setup->setStartAndGoalStates(state_at(space, problem.start), state_at(space, problem.goal));
    return setup;
}

inline std::vector<problems::Configuration> configurations(ompl::geometric::PathGeometric &path) {
    const auto *space = path.getSpaceInformation()->getStateSpace()->as<cstk_ompl::StateSpace>();
    std::vector<problems::Configuration> found;
    for (const ompl::base::State *state : path.getStates()) {
        const cstk::Span<double> q = space->configuration(state);
        found.emplace_back(q.data(), q.data() + q.size());
    }
    return found;
}
