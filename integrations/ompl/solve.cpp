// Solves a rigid body's problem and two arms' by three of OMPL's planners, on states and motions that this library proves free:
//
//     ompl_solve [PUMA_FOLDER]
//
// The folder is what scripts/fetch_puma560.sh prints; without it the Puma 560 is left out. Ends with 1 where a problem is not
// solved.
#include "built_in.hpp"
#include "cstk_ompl/link_projection.hpp"
#include "planning.hpp"

#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace og = ompl::geometric;

const double seconds = 20;
/// The side of the cells in which LBKPIECE1 counts where the last link has been.
const double cell = 0.1;

std::vector<ompl::base::PlannerPtr> planners(const ompl::base::SpaceInformationPtr &information) {
    const auto &space = *information->getStateSpace()->as<cstk_ompl::StateSpace>();
    const auto last_link = static_cast<std::uint32_t>(space.space().link_count() - 1);
    auto kpiece = std::make_shared<og::LBKPIECE1>(information);
    kpiece->setProjectionEvaluator(std::make_shared<cstk_ompl::LinkProjection>(space, last_link, cell));
    return {std::make_shared<og::RRTConnect>(information), kpiece, std::make_shared<og::PRM>(information)};
}

bool solve(const problems::Problem &problem) {
    bool all = true;
    const auto setup = proved_setup(problem);
    for (const ompl::base::PlannerPtr &planner : planners(setup->getSpaceInformation())) {
        setup->clear();
        setup->setPlanner(planner);
        const auto start = std::chrono::steady_clock::now();
        const bool solved = setup->solve(seconds) == ompl::base::PlannerStatus::EXACT_SOLUTION;
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        std::printf("%-18s %-12s %s in %8.1f ms, length %.1f\n", problem.scene.c_str(), planner->getName().c_str(),
                    solved ? "solved" : "no path", time.count(), solved ? setup->getSolutionPath().length() : 0.0);
        all &= solved;
    }
    return all;
}

} // namespace

int main(int count, char **arguments) {
    try {
        ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
        ompl::RNG::setSeed(1);
        bool all = true;
        for (const problems::Problem &problem : problems::built_in(count > 1 ? arguments[1] : "")) {
            all &= solve(problem);
        }
        return all ? 0 : 1;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "ompl_solve: %s\n", error.what());
        return 1;
    }
}
