#include "subgoal_graph.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace sandros {

namespace {

/// Parts that a cell is halved into before it is kept undecided: some hundred microseconds.
const std::uint64_t MAX_BOXES = 32;
/// The cost of a subgoal at whose middle the first links are in contact; with the clearance it
/// falls to 1.
const double CONTACT_COST = 3;
/// What it costs to go where the local planner failed: as much as a way round through so many
/// cells.
const double FAILED_COST = 6;

/// Where a subgoal stands in a list that has it.
template <typename List> auto find_neighbour(List &list, SubgoalId id) {
    return std::find_if(list.begin(), list.end(), [&](const Neighbour &n) { return n.id == id; });
}

} // namespace

SubgoalGraph::SubgoalGraph(const Grid &grid, std::vector<cstk::CObject> obstacles, double clearance,
                           cstk::Query &query)
    : grid_(grid), obstacles_(std::move(obstacles)), clearance_(clearance), query_(query),
      rest_(grid.axis_count(), 0.0), subgoals_(1) {}

SubgoalId SubgoalGraph::find(const Configuration &q) const {
    SubgoalId id = 0;
    while (!subgoals_[id].children.empty()) {
        id = subgoals_[id].children[grid_.cell_of(subgoals_[id].cells.size(), q)];
    }
    return id;
}

void SubgoalGraph::set_reached(SubgoalId id, Side side, std::size_t configuration) {
    subgoals_[id].reached[side] = configuration;
}

void SubgoalGraph::set_failed(SubgoalId a, SubgoalId b) {
    find_neighbour(subgoals_[a].neighbours, b)->failed = true;
    find_neighbour(subgoals_[b].neighbours, a)->failed = true;
}

bool SubgoalGraph::has_failed(SubgoalId a, SubgoalId b) const {
    return find_neighbour(subgoals_[a].neighbours, b)->failed;
}

void SubgoalGraph::refine(SubgoalId id, const std::array<const Configuration *, 2> &reached) {
    const std::size_t axis = subgoals_[id].cells.size();
    std::vector<SubgoalId> children;
    for (std::size_t cell = 0; cell < grid_.cell_count(axis); ++cell) {
        std::optional<Subgoal> child = make_child(subgoals_[id], cell);
        children.push_back(child ? subgoals_.size() : NONE);
        if (child) {
            subgoals_.push_back(std::move(*child));
        }
    }
    subgoals_[id].children = std::move(children);
    connect(id);
    for (const Side side : {START, GOAL}) {
        if (subgoals_[id].reached[side] != NONE) {
            const std::size_t configuration = subgoals_[id].reached[side];
            set_reached(find(*reached[side]), side, configuration);
        }
    }
}

/// None where every configuration of the child is proved to be inside.
std::optional<Subgoal> SubgoalGraph::make_child(const Subgoal &parent, std::size_t cell) {
    Subgoal child;
    child.cells = parent.cells;
    child.cells.push_back(cell);
    cstk_region_options options = cstk::region_options();
    options.max_boxes = MAX_BOXES;
    const Configuration low = grid_.low(child.cells, rest_), high = grid_.high(child.cells, rest_);
    ++work_.regions;
    const cstk_region_result region =
        query_.region_classify(obstacles_[child.cells.size()], low, high, options);
    if (region.outcome == CSTK_REGION_INSIDE) {
        return std::nullopt;
    }
    Configuration middle = rest_;
    for (std::size_t i = 0; i < middle.size(); ++i) {
        middle[i] = (low[i] + high[i]) / 2;
    }
    child.cost = cost_of_clearance(child.cells, middle);
    return child;
}

double SubgoalGraph::cost_of_clearance(const Cells &cells, const Configuration &q) {
    ++work_.distances;
    const double clearance = query_.distance(obstacles_[cells.size()], q, clearance_).lower;
    return 1 + (CONTACT_COST - 1) * (1 - std::min(clearance / clearance_, 1.0));
}

/// Puts the children in the place of their parent.
void SubgoalGraph::connect(SubgoalId parent) {
    const std::vector<Neighbour> around = std::move(subgoals_[parent].neighbours);
    const std::vector<SubgoalId> &children = subgoals_[parent].children;
    const auto join = [&](SubgoalId a, SubgoalId b) {
        if (grid_.adjacent(subgoals_[a].cells, subgoals_[b].cells)) {
            subgoals_[a].neighbours.push_back({b});
            subgoals_[b].neighbours.push_back({a});
        }
    };
    for (const Neighbour &other : around) {
        std::vector<Neighbour> &its = subgoals_[other.id].neighbours;
        its.erase(find_neighbour(its, parent));
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (children[i] == NONE) {
            continue;
        }
        for (const Neighbour &other : around) {
            join(children[i], other.id);
        }
        for (std::size_t k = 0; k < i; ++k) {
            if (children[k] != NONE) {
                join(children[i], children[k]);
            }
        }
    }
}

double SubgoalGraph::step_cost(SubgoalId from, const Neighbour &to) const {
    const double cost = (subgoals_[from].cost + subgoals_[to.id].cost) / 2;
    if (!to.failed) {
        return cost;
    }
    return can_refine(from) || can_refine(to.id) ? cost + FAILED_COST
                                                 : std::numeric_limits<double>::infinity();
}

std::optional<std::vector<SubgoalId>> SubgoalGraph::cheapest_sequence() const {
    using Entry = std::pair<double, SubgoalId>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<double> cost(subgoals_.size(), std::numeric_limits<double>::infinity());
    std::vector<SubgoalId> before(subgoals_.size(), NONE);
    for (SubgoalId id = 0; id < subgoals_.size(); ++id) {
        if (subgoals_[id].children.empty() && subgoals_[id].reached[START] != NONE) {
            cost[id] = 0;
            open.push({0, id});
        }
    }
    while (!open.empty()) {
        const auto [so_far, id] = open.top();
        open.pop();
        if (so_far > cost[id]) {
            continue;
        }
        if (subgoals_[id].reached[GOAL] != NONE && !subgoals_[id].torn) {
            std::vector<SubgoalId> sequence;
            for (SubgoalId at = id; at != NONE; at = before[at]) {
                sequence.push_back(at);
            }
            return std::vector<SubgoalId>(sequence.rbegin(), sequence.rend());
        }
        for (const Neighbour &next : subgoals_[id].neighbours) {
            const double then = so_far + step_cost(id, next);
            if (then < cost[next.id]) {
                cost[next.id] = then;
                before[next.id] = id;
                open.push({then, next.id});
            }
        }
    }
    return std::nullopt;
}

} // namespace sandros
