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
#include <memory>
#include <string>
#include <vector>

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

void a_default_projection_is_kept(const Problem &problem) {
    const auto space = std::make_shared<cstk_ompl::StateSpace>(problem.workcell->space);
    const auto last = static_cast<std::uint32_t>(space->space().link_count() - 1);
    const auto projection = std::make_shared<cstk_ompl::LinkProjection>(*space, last, 0.1);
    space->registerDefaultProjection(projection);
    space->setup();
    expect(space->getDefaultProjection() == projection, "the default projection of " + problem.scene + " is kept");
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

/// A tip that turns about the origin at a distance of 1, in a world that ends before it on one side.
void motions_stay_in_the_world_box() {
    cstk::RobotBuilder builder(3);
    cstk::Link arm;
    arm.joint = CSTK_JOINT_REVOLUTE;
    arm.lower = -3;
    arm.upper = 3;
    builder.add_link(arm);
    cstk::Link tip;
    tip.parent = 0;
    tip.at = cstk::translation(1, 0, 0);
    tip.body = cstk::Body::sphere(0.05);
    builder.add_link(tip);
    const cstk::Space world({builder.build()}, {}, {-2.0, -2.0, -2.0, 0.9, 2.0, 2.0});
    const cstk::CObject contact = cstk::CObject::induced(world, cstk::Environment());
    const auto space = std::make_shared<cstk_ompl::StateSpace>(world);
    const auto information = std::make_shared<ob::SpaceInformation>(space);
    information->setStateValidityChecker(std::make_shared<cstk_ompl::ValidityChecker>(information, contact));
    information->setMotionValidator(std::make_shared<cstk_ompl::MotionValidator>(information, contact));
    information->setup();
    space->sanityChecks();
    ob::ScopedState<> from(information), to(information);
    std::size_t valid = 0;
    for (int i = 0; i <= 40; ++i) {
        for (int k = 0; k <= 40; ++k) {
            const double ends[2] = {-3 + 0.15 * i, -3 + 0.15 * k};
            space->set(from.get(), {ends[0]});
            space->set(to.get(), {ends[1]});
            // The tip is beyond the box where its angle is less than acos 0.9 to either side.
            const double least = ends[0] * ends[1] <= 0 ? 0 : std::min(std::abs(ends[0]), std::abs(ends[1]));
            const bool is_free = std::cos(least) < 0.9;
            expect(information->isValid(to.get()) == (std::cos(ends[1]) < 0.9), "states are valid within the world box");
            if (information->isValid(from.get())) {
                expect(information->checkMotion(from.get(), to.get()) == is_free, "valid motions stay in the world box");
                valid += is_free;
            }
        }
    }
    expect(valid > 0, "there are valid motions");
}

/// A body that flies: between two rotations its way is a screw, longer than the straight one.
void the_extent_bounds_screws() {
    cstk::RobotBuilder builder(3);
    cstk::Link link;
    link.joint = CSTK_JOINT_FREE;
    link.body = cstk::Body::sphere(0.1);
    builder.add_link(link);
    const cstk::Robot robot = builder.build();
    std::vector<cstk_range> ranges(cstk::Space({robot}).nq(), cstk::default_range());
    std::fill_n(ranges.begin(), 3, cstk::interval(-1, 1));
    cstk_ompl::StateSpace space(cstk::Space({robot}, ranges), false);
    space.setup();
    ob::StateSpacePtr shared(&space, [](ob::StateSpace *) {});
    ob::ScopedState<> a(shared), b(shared);
    const ob::StateSamplerPtr sampler = space.allocStateSampler();
    for (std::size_t i = 0; i < 20 * motions; ++i) {
        sampler->sampleUniform(a.get());
        sampler->sampleUniform(b.get());
        // Opposite corners too.
        if (i % 2 == 0) {
            const double *q = a->as<cstk_ompl::StateSpace::StateType>()->values;
            std::vector<double> ends(q, q + space.space().nq());
            std::fill_n(ends.begin(), 3, -1.0);
            space.set(a.get(), ends);
            q = b->as<cstk_ompl::StateSpace::StateType>()->values;
            ends.assign(q, q + space.space().nq());
            std::fill_n(ends.begin(), 3, 1.0);
            space.set(b.get(), ends);
        }
        expect(space.distance(a.get(), b.get()) <= space.getMaximumExtent() * (1 + 1e-12), "the extent bounds screws");
    }
}

} // namespace

int main(int count, char **arguments) {
    try {
        ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
        ompl::RNG::setSeed(3);
        motions_stay_in_the_world_box();
        the_extent_bounds_screws();
        for (const Problem &problem : problems::built_in(count > 1 ? arguments[1] : "")) {
            the_state_space_keeps_what_ompl_asks_of_one(problem);
            motions_are_as_their_samples_say(problem);
            the_clearance_of_a_motion_is_the_least_distance_of_its_samples(problem);
            a_projection_is_where_the_link_is(problem);
            a_default_projection_is_kept(problem);
            rrt_connect_finds_a_free_path(problem);
        }
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "FAILED: %s\n", error.what());
        return 1;
    }
}
