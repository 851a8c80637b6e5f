// The graph of subgoals: sets of configurations that are refined where the search needs it, and
// their neighbours.
#ifndef SANDROS_SUBGOAL_GRAPH_HPP
#define SANDROS_SUBGOAL_GRAPH_HPP

#include "grid.hpp"

#include <optional>

namespace sandros {

/// From which end of the path something was reached.
enum Side { START, GOAL };

using SubgoalId = std::size_t;
inline const std::size_t NONE = static_cast<std::size_t>(-1);

/// A subgoal that another has a face in common with.
struct Neighbour {
    SubgoalId id;
    /// The local planner could not go from one to the other.
    bool failed = false;
};

/// A set of configurations to pass through: the first coordinates are in one cell each, the others
/// are free.
struct Subgoal {
    Cells cells;
    /// By cell of the next axis, NONE where the robot's first links are proved to be inside; empty
    /// until it is refined.
    std::vector<SubgoalId> children;
    /// None of them is refined.
    std::vector<Neighbour> neighbours;
    /// The cost of passing through: 1 where the first links have room, more where they are near
    /// obstacles.
    double cost = 1;
    /// By side: the configuration in it that was reached, NONE if there is none.
    std::size_t reached[2] = {NONE, NONE};
    /// The configurations reached in it from both sides could not be joined.
    bool torn = false;
};

/// What the graph asked of the library.
struct GraphWork {
    std::size_t regions = 0, distances = 0;
};

class SubgoalGraph {
  public:
    /// Its one subgoal is the whole of C-space. `obstacles` are those of the first axes.
    SubgoalGraph(const Grid &grid, std::vector<cstk::CObject> obstacles, double clearance,
                 cstk::Query &query);

    const Subgoal &operator[](SubgoalId id) const { return subgoals_[id]; }
    std::size_t size() const { return subgoals_.size(); }
    const GraphWork &work() const { return work_; }

    /// The one that is not refined and holds q.
    SubgoalId find(const Configuration &q) const;

    void set_reached(SubgoalId id, Side side, std::size_t configuration);
    void set_torn(SubgoalId id) { subgoals_[id].torn = true; }

    /// Of two neighbours: the local planner could not go from one to the other.
    void set_failed(SubgoalId a, SubgoalId b);
    bool has_failed(SubgoalId a, SubgoalId b) const;

    bool can_refine(SubgoalId id) const { return subgoals_[id].cells.size() < grid_.axis_count(); }

    /// Cuts a subgoal along its next axis. What was reached in it is then reached in the child that
    /// holds it: `reached` has these configurations by side, nullptr where there is none.
    void refine(SubgoalId id, const std::array<const Configuration *, 2> &reached);

    /// The cheapest sequence of neighbours from a subgoal reached from the start to one reached
    /// from the goal; none if there is none. What failed costs more where one of the two can be
    /// refined, and impassable where not.
    std::optional<std::vector<SubgoalId>> cheapest_sequence() const;

  private:
    std::optional<Subgoal> make_child(const Subgoal &parent, std::size_t cell);
    double cost_of_clearance(const Cells &cells, const Configuration &q);
    void connect(SubgoalId parent);
    double step_cost(SubgoalId from, const Neighbour &to) const;

    const Grid &grid_;
    const std::vector<cstk::CObject> obstacles_;
    const double clearance_;
    cstk::Query &query_;
    /// For the coordinates that a subgoal leaves free: the links asked about do not depend on them.
    const Configuration rest_;
    std::vector<Subgoal> subgoals_;
    GraphWork work_;
};

} // namespace sandros

#endif
