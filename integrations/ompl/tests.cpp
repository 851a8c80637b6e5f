// The parts of cstk_ompl against this library's samples, and paths of OMPL's RRT-Connect judged by many samples.
#include "built_in.hpp"
#include "check.hpp"
#include "cstk_ompl/clearance_objective.hpp"
#include "cstk_ompl/link_projection.hpp"
#include "dense.hpp"
#include "planning.hpp"

#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>

namespace {

namespace ob = ompl::base;
using problems::Configuration;
using problems::Problem;

const std::size_t samples = 10000, motions = 300;

void the_state_space_keeps_what_ompl_asks_of_one(const Problem &problem) {
    cstk_ompl::StateSpace space(problem.workcell->space);
    space.setup();
    // Throws where distances, interpolation, copies, bounds or samplers contradict one another.
    space.sanityChecks();
    ob::StateSpacePtr shared(&space, [](ob::StateSpace *) {});
    ob::ScopedState<> a(shared), b(shared), middle(shared);
    const ob::StateSamplerPtr sampler = space.allocStateSampler();
    for (std::size_t i = 0; i < motions; ++i) {
        sampler->sampleUniform(a.get());
        sampler->sampleUniform(b.get());
        expect(space.satisfiesBounds(a.get()), "a sample is within the limits");
        expect(space.distance(a.get(), b.get()) <= space.getMaximumExtent() * (1 + 1e-12), "the extent bounds distances");
        space.interpolate(a.get(), b.get(), 0.5, middle.get());
        expect(std::abs(space.distance(a.get(), middle.get()) - space.distance(a.get(), b.get()) / 2) < 1e-9,
               "the middle is halfway in the space of " + problem.scene);
    }
}

/// Calls `see` with valid states and random ones.
template <class See> void for_motions(const Problem &problem, See see) {
    const auto setup = proved_setup(problem);
    setup->setup();
    const ob::SpaceInformationPtr information = setup->getSpaceInformation();
    const ob::StateSamplerPtr sampler = information->allocStateSampler();
    ob::ScopedState<> from(information), to(information);
    for (std::size_t i = 0; i < motions; ++i) {
        do {
            sampler->sampleUniform(from.get());
        } while (!information->isValid(from.get()));
        sampler->sampleUniformNear(to.get(), from.get(), 1);
        see(*information, from.get(), to.get());
    }
}

void motions_are_as_their_samples_say(const Problem &problem) {
    const problems::Workcell &cell = *problem.workcell;
    cstk::Query query;
    std::size_t valid = 0;
    for_motions(problem, [&](const ob::SpaceInformation &information, const ob::State *from, const ob::State *to) {
        const auto &space = *information.getStateSpace()->as<cstk_ompl::StateSpace>();
        ob::ScopedState<> last(information.getStateSpace());
        std::pair<ob::State *, double> last_valid = {last.get(), -1};
        const bool is_valid = information.checkMotion(from, to);
        expect(information.getMotionValidator()->checkMotion(from, to, last_valid) == is_valid,
               "both forms agree on a motion of " + problem.scene);
        const auto meets = [&](double t) {
            const Configuration q = cell.space.interpolate(space.configuration(from), space.configuration(to), t);
            return query.classify(cell.contact, q) == CSTK_CLASS_INSIDE;
        };
        const double free_until = is_valid ? 1 : last_valid.second;
        for (std::size_t k = 0; k <= 200; ++k) {
            expect(!meets(free_until * static_cast<double>(k) / 200), "what is called free is free in " + problem.scene);
        }
        if (is_valid) {
            ++valid;
        } else {
            expect(meets(std::min(1.0, free_until + 1e-5)), "the last valid state is just before the contact");
            expect(information.isValid(last.get()), "the last valid state is valid");
        }
    });
    expect(valid > motions / 10 && valid < motions, "some motions are free in " + problem.scene);
}

void the_clearance_of_a_motion_is_the_least_distance_of_its_samples(const Problem &problem) {
    const problems::Workcell &cell = *problem.workcell;
    cstk::Query query;
    const double tolerance = 1e-3;
    const auto setup = proved_setup(problem);
    const cstk_ompl::ClearanceObjective objective(setup->getSpaceInformation(), cell.contact, tolerance);
    std::size_t i = 0;
    for_motions(problem, [&](const ob::SpaceInformation &information, const ob::State *from, const ob::State *to) {
        if (++i > 20) {
            return;
        }
        const auto &space = *information.getStateSpace()->as<cstk_ompl::StateSpace>();
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k <= samples; ++k) {
            const double t = static_cast<double>(k) / samples;
            const Configuration q = cell.space.interpolate(space.configuration(from), space.configuration(to), t);
            least = std::min(least, query.distance(cell.contact, q).distance);
        }
        const double found = objective.motionCost(from, to).value();
        // Between samples the nearest place moves at most a few ten-thousandths.
        expect(found <= least + 1e-12 && found >= least - tolerance - 1e-3, "the clearance of a motion of " + problem.scene);
    });
}

void a_projection_is_where_the_link_is(const Problem &problem) {
    const cstk_ompl::StateSpace space(problem.workcell->space);
    const auto last = static_cast<std::uint32_t>(space.space().link_count() - 1);
    const cstk_ompl::LinkProjection projection(space, last, 0.1);
    ob::State *state = space.allocState();
    space.set(state, problem.goal);
    Eigen::VectorXd found(3);
    projection.project(state, found);
    space.freeState(state);
    const cstk::Pose pose = problem.workcell->robots.front().link_pose(problem.goal, last);
    expect(found[0] == pose[3] && found[1] == pose[7] && found[2] == pose[11], "the projection of " + problem.scene);
}

void rrt_connect_finds_a_free_path(const Problem &problem) {
    const problems::Workcell &cell = *problem.workcell;
    const auto setup = proved_setup(problem);
    setup->setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup->getSpaceInformation()));
    expect(setup->solve(60) == ob::PlannerStatus::EXACT_SOLUTION, problem.scene + " is solved");
    cstk::Query query;
    expect(everywhere(cell.space, configurations(setup->getSolutionPath()), samples,
                      [&](const Configuration &q) { return query.classify(cell.contact, q) != CSTK_CLASS_INSIDE; }),
           "the path of " + problem.scene + " is free");
}

} // namespace

int main(int count, char **arguments) {
    try {
        ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
        ompl::RNG::setSeed(3);
        for (const Problem &problem : problems::built_in(count > 1 ? arguments[1] : "")) {
            the_state_space_keeps_what_ompl_asks_of_one(problem);
            motions_are_as_their_samples_say(problem);
            the_clearance_of_a_motion_is_the_least_distance_of_its_samples(problem);
            a_projection_is_where_the_link_is(problem);
            rrt_connect_finds_a_free_path(problem);
        }
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "FAILED: %s\n", error.what());
        return 1;
    }
}
