#include "variants.hpp"

#include "fcl_cell.hpp"
#include "planning.hpp"
#include "rrt_connect.hpp"

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <ctime>
#include <memory>
#include <utility>
#include <vector>

namespace {

namespace ob = ompl::base;

/// How long OMPL's planner may search, in seconds.
const double time_limit = 20;
/// Samples of a motion are this part of the space's extent apart: OMPL's default.
const double ompl_spacing = 0.01;

class FclChecker : public ob::StateValidityChecker {
  public:
    FclChecker(const ob::SpaceInformationPtr &information, const problems::Workcell &cell, const std::string &way)
        : StateValidityChecker(information), space_(*information->getStateSpace()->as<cstk_ompl::StateSpace>()),
          cell_(cell, way) {}

    bool isValid(const ob::State *state) const override {
        return space_.satisfiesBounds(state) && !cell_.meets(space_.configuration(state));
    }

  private:
    const cstk_ompl::StateSpace &space_;
    FclCell cell_;
};

/// Answers as another checker does, and keeps the answers.
class RecordingChecker : public ob::StateValidityChecker {
  public:
    RecordingChecker(const ob::SpaceInformationPtr &information, ob::StateValidityCheckerPtr checker, std::vector<bool> &answers)
        : StateValidityChecker(information), checker_(std::move(checker)), answers_(answers) {}

    bool isValid(const ob::State *state) const override {
        answers_.push_back(checker_->isValid(state));
        return answers_.back();
    }

  private:
    ob::StateValidityCheckerPtr checker_;
    std::vector<bool> &answers_;
};

/// Gives answers that were kept, without looking at anything.
class ReplayingChecker : public ob::StateValidityChecker {
  public:
    ReplayingChecker(const ob::SpaceInformationPtr &information, const std::vector<bool> &answers)
        : StateValidityChecker(information), answers_(answers) {}

    bool isValid(const ob::State *) const override { return next_ < answers_.size() && answers_[next_++]; }

  private:
    const std::vector<bool> &answers_;
    mutable std::size_t next_ = 0;
};

double clock_milliseconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Run run_of(const std::vector<problems::Configuration> &path, double time, std::size_t checks) {
    return {path.empty() ? Answer::gave_up : Answer::path, path, time, checks};
}

Run by_ours(const Task &task) {
    static cstk::Query query;
    const problems::Workcell &cell = *task.problem.workcell;
    rrt_connect::Options options;
    options.range = task.problem.range;
    options.seed = task.seed;
    rrt_connect::Plan plan;
    const double time = processor_milliseconds([&] {
        plan = rrt_connect::plan(query, cell.space, cell.contact, task.problem.start, task.problem.goal, options);
    });
    return run_of(plan.path, time, plan.checks);
}

/// Of a path that is found OMPL may cut corners, as SimpleSetup does by default.
Run by_ompl(ompl::geometric::SimpleSetup &setup, const Task &task, bool simplifies = false) {
    setup.getStateSpace()->as<cstk_ompl::StateSpace>()->set_seed(task.seed);
    const auto planner = std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation());
    planner->setRange(task.problem.range);
    setup.setPlanner(planner);
    setup.setup();
    bool solved = false;
    const double time = processor_milliseconds([&] {
        solved = setup.solve(time_limit) == ob::PlannerStatus::EXACT_SOLUTION;
        if (solved && simplifies) {
            setup.simplifySolution();
        }
    });
    const ob::MotionValidatorPtr &motions = setup.getSpaceInformation()->getMotionValidator();
    const std::size_t checks = motions->getValidMotionCount() + motions->getInvalidMotionCount();
    return run_of(solved ? configurations(setup.getSolutionPath()) : std::vector<problems::Configuration>(), time, checks);
}

Run by_ompl_proved(const Task &task) {
    return by_ompl(*proved_setup(task.problem), task);
}

/// OMPL's own motion validator, which asks at samples.
void set_sampled(ompl::geometric::SimpleSetup &setup) {
    const ob::SpaceInformationPtr &information = setup.getSpaceInformation();
    information->setStateValidityCheckingResolution(ompl_spacing);
    information->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(information));
}

Run by_ompl_sampled(const Task &task) {
    const auto setup = proved_setup(task.problem);
    set_sampled(*setup);
    return by_ompl(*setup, task);
}

/// What is left of OMPL's time where answers cost nothing: no library below it can make it faster by more than that.
Run by_ompl_replayed(const Task &task) {
    std::vector<bool> answers;
    const auto first = proved_setup(task.problem), second = proved_setup(task.problem);
    for (const auto &setup : {first, second}) {
        set_sampled(*setup);
    }
    first->setStateValidityChecker(
        std::make_shared<RecordingChecker>(first->getSpaceInformation(), first->getStateValidityChecker(), answers));
    by_ompl(*first, task);
    second->setStateValidityChecker(std::make_shared<ReplayingChecker>(second->getSpaceInformation(), answers));
    return by_ompl(*second, task);
}

Run by_ompl_fcl(const Task &task, bool simplifies) {
    const auto setup = proved_setup(task.problem);
    set_sampled(*setup);
    setup->setStateValidityChecker(
        std::make_shared<FclChecker>(setup->getSpaceInformation(), *task.problem.workcell, task.fcl_way));
    return by_ompl(*setup, task, simplifies);
}

} // namespace

std::vector<Variant> variants() {
    return {{"RRT-Connect", "cstk proved", by_ours},
            {"OMPL RRTConnect", "cstk proved", by_ompl_proved},
            {"OMPL RRTConnect", "cstk sampled", by_ompl_sampled},
            {"OMPL RRTConnect", "answers replayed", by_ompl_replayed},
            {"OMPL RRTConnect simplified", "FCL sampled", [](const Task &task) { return by_ompl_fcl(task, true); }},
            {"OMPL RRTConnect", "FCL sampled", [](const Task &task) { return by_ompl_fcl(task, false); }}};
}

double processor_milliseconds(const std::function<void()> &work) {
    const double start = clock_milliseconds();
    work();
    return clock_milliseconds() - start;
}
