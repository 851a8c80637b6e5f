#include "planner.hpp"

#include "obstacles.hpp"
#include "path.hpp"

#include <algorithm>

namespace sandros {

namespace {

/// Subgoals where the first links have as much room as this many shells cost no more.
const double SHELLS_OF_ROOM = 2;

/// A configuration that is joined with the start or the goal.
struct Reached {
    Configuration q;
    /// What it was reached from, NONE at the start and the goal.
    std::size_t from;
    /// The configurations between that one and this, this one last.
    Path way;
};

Side other(Side side) { return side == START ? GOAL : START; }

/// The search at one resolution.
class Search {
  public:
    Search(const Problem &problem, const Grid &grid, cstk::Query &query)
        : grid_(grid), obstacles_(obstacles_of_first_axes(problem)),
          local_(problem, obstacles_.back(), query),
          graph_(grid, obstacles_, SHELLS_OF_ROOM * problem.slide.shell, query) {
        ends_[START] = add({problem.start, NONE, {problem.start}}, START);
        ends_[GOAL] = add({problem.goal, NONE, {problem.goal}}, GOAL);
    }

    Outcome run(std::size_t max_subgoals);

    Path take_path() { return std::move(path_); }
    void add_work(PlanWork &work) const;

  private:
    std::size_t add(Reached reached, Side side);
    void follow(const std::vector<SubgoalId> &sequence);
    void join_within(SubgoalId id);
    void reach(SubgoalId from, SubgoalId to, Side side);
    void refine_one_of(SubgoalId a, SubgoalId b);
    void refine(SubgoalId id);
    void join(std::size_t from_start, std::size_t from_goal, const Path &way);
    Path way_to(std::size_t reached) const;

    const Grid &grid_;
    /// By number of axes: those that the links meet that so many axes place.
    const std::vector<cstk::CObject> obstacles_;
    LocalPlanner local_;
    SubgoalGraph graph_;
    std::vector<Reached> reached_;
    /// By side: the start, the goal.
    std::size_t ends_[2];
    /// The end that went last.
    Side turn_ = START;
    /// Empty until it is found.
    Path path_;
    std::size_t attempts_ = 0, refinements_ = 0;
};

/// Records what was reached, unless its subgoal was reached from this side before.
std::size_t Search::add(Reached reached, Side side) {
    const SubgoalId id = graph_.find(reached.q);
    reached_.push_back(std::move(reached));
    if (graph_[id].reached[side] == NONE) {
        graph_.set_reached(id, side, reached_.size() - 1);
    }
    return reached_.size() - 1;
}

Outcome Search::run(std::size_t max_subgoals) {
    while (path_.empty()) {
        if (graph_.size() > max_subgoals) {
            return Outcome::GAVE_UP;
        }
        const auto sequence = graph_.cheapest_sequence();
        if (!sequence) {
            return Outcome::NO_PATH_AT_THIS_RESOLUTION;
        }
        follow(*sequence);
    }
    return Outcome::FOUND;
}

/// One attempt of the local planner, or one refinement, at an end of the sequence: at both in turn.
void Search::follow(const std::vector<SubgoalId> &sequence) {
    if (sequence.size() == 1) {
        join_within(sequence[0]);
        return;
    }
    turn_ = other(turn_);
    const std::size_t last = sequence.size() - 1;
    /* A torn subgoal was reached from the goal too, and going there again gains nothing: then the
       start's end has its turn. */
    const Side side =
        turn_ == GOAL && graph_[sequence[last - 1]].reached[GOAL] != NONE ? START : turn_;
    const SubgoalId from = side == START ? sequence[0] : sequence[last];
    const SubgoalId to = side == START ? sequence[1] : sequence[last - 1];
    if (graph_.has_failed(from, to)) {
        refine_one_of(from, to);
    } else {
        reach(from, to, side);
    }
}

/// The two ends have met in a subgoal: joins the configurations reached there.
void Search::join_within(SubgoalId id) {
    const std::size_t a = graph_[id].reached[START], b = graph_[id].reached[GOAL];
    ++attempts_;
    const auto way = local_.reach(reached_[a].q, reached_[b].q);
    if (way) {
        join(a, b, *way);
    } else if (graph_.can_refine(id)) {
        refine(id);
    } else {
        graph_.set_torn(id);
    }
}

void Search::reach(SubgoalId from, SubgoalId to, Side side) {
    const std::size_t a = graph_[from].reached[side];
    ++attempts_;
    const auto way = local_.reach(reached_[a].q, grid_, graph_[to].cells);
    if (!way) {
        graph_.set_failed(from, to);
        return;
    }
    const std::size_t b = add({way->back(), a, *way}, side);
    /* The way may now be open to the other end. */
    const std::size_t end = ends_[other(side)];
    if (local_.straight(reached_[b].q, reached_[end].q)) {
        join(side == START ? b : end, side == START ? end : b,
             {reached_[side == START ? end : b].q});
    }
}

/// The one whose coordinates are known less; both if that is the same.
void Search::refine_one_of(SubgoalId a, SubgoalId b) {
    const std::size_t level_a = graph_[a].cells.size(), level_b = graph_[b].cells.size();
    if (level_a <= level_b) {
        refine(a);
    }
    if (level_b <= level_a) {
        refine(b);
    }
}

void Search::refine(SubgoalId id) {
    ++refinements_;
    std::array<const Configuration *, 2> reached;
    for (const Side side : {START, GOAL}) {
        const std::size_t at = graph_[id].reached[side];
        reached[side] = at == NONE ? nullptr : &reached_[at].q;
    }
    graph_.refine(id, reached);
}

/// The path from start to goal, over the way between the two.
void Search::join(std::size_t from_start, std::size_t from_goal, const Path &way) {
    path_ = way_to(from_start);
    path_.insert(path_.end(), way.begin(), way.end());
    Path rest = way_to(from_goal);
    std::reverse(rest.begin(), rest.end());
    path_.insert(path_.end(), rest.begin() + 1, rest.end());
}

/// From the start or the goal.
Path Search::way_to(std::size_t reached) const {
    std::vector<std::size_t> order;
    for (std::size_t at = reached; at != NONE; at = reached_[at].from) {
        order.push_back(at);
    }
    Path way;
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        way.insert(way.end(), reached_[*at].way.begin(), reached_[*at].way.end());
    }
    return way;
}

void Search::add_work(PlanWork &work) const {
    work.local.motions += local_.work().motions;
    work.local.slides += local_.work().slides;
    work.graph.regions += graph_.work().regions;
    work.graph.distances += graph_.work().distances;
    work.subgoals += graph_.size();
    work.attempts += attempts_;
    work.refinements += refinements_;
}

} // namespace

const char *name_of(Outcome outcome) {
    switch (outcome) {
    case Outcome::FOUND:
        return "found";
    case Outcome::NO_PATH_AT_THIS_RESOLUTION:
        return "no path at this resolution";
    case Outcome::GAVE_UP:
        return "gave up";
    case Outcome::BAD_START_OR_GOAL:
        return "start or goal is not free";
    case Outcome::NOT_PROVED:
        return "a path nearer to contact than rounding";
    }
    return "";
}

Plan plan(const Problem &problem, const PlanOptions &options) {
    require_axes(problem);
    Plan made = {Outcome::BAD_START_OR_GOAL, {}, {}};
    cstk::Query query;
    const cstk::CObject obstacles = obstacles_of(problem);
    for (const Configuration *end : {&problem.start, &problem.goal}) {
        if (!problem.space.within_limits(*end) ||
            query.classify(obstacles, *end) == CSTK_CLASS_INSIDE) {
            return made;
        }
    }
    for (unsigned halvings = 0; halvings <= options.halvings; ++halvings) {
        const Grid grid(problem, halvings);
        Search search(problem, grid, query);
        made.outcome = search.run(options.max_subgoals);
        made.work.halvings = halvings;
        search.add_work(made.work);
        if (made.outcome == Outcome::FOUND) {
            made.path = shortened(problem, search.take_path());
            // Slides prove their motions pair by pair, and may leave less room than whole motions are proved with.
            if (!is_free(problem, made.path)) {
                made.outcome = Outcome::NOT_PROVED;
                made.path.clear();
            }
        }
        if (made.outcome != Outcome::NO_PATH_AT_THIS_RESOLUTION) {
            break;
        }
    }
    return made;
}

} // namespace sandros
