// What a search of the whole grid finds, the planner finds: random scenes on a plane, judged by
// brute force over the middles of all cells and the straight motions between them.
//
//   sandros_completeness [SCENES [SEED]]
#include "../obstacles.hpp"
#include "../planner.hpp"
#include "../problems/rigid_body.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace sandros;
using problems::Box;

/// splitmix64.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    double uniform(double low, double high) {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

const std::size_t CELLS[3] = {10, 10, 6};
const int WALLS = 16;

/// A stick among thin walls.
Problem random_problem(Random &random) {
    Problem problem;
    problem.name = "random";
    const cstk::Body stick = problems::body_of({{{0, 0, 0}, {0.3, 0.08, 0.1}}});
    problem.robots = {problems::body_on_plane("stick", stick, 0.04, {{-1, -1, 0}, {1, 1, 0}})};
    problem.space = cstk::Space(problem.robots);
    std::vector<Box> walls;
    for (int i = 0; i < WALLS; ++i) {
        const double longer = random.uniform(0.2, 0.7), thick = random.uniform(0.02, 0.15);
        const bool upright = random.uniform(0, 1) < 0.5;
        walls.push_back({{random.uniform(-1, 1), random.uniform(-1, 1), 0},
                         {upright ? thick : longer, upright ? longer : thick, 0.2}});
    }
    problem.add_obstacle(problems::body_of(walls));
    problem.axes = {{0, CELLS[0]}, {1, CELLS[1]}, {2, CELLS[2]}};
    problem.slide = {0.05, 0.1, 0.1};
    return problem;
}

/// The middles of the cells, and the straight motions between neighbours.
class Lattice {
  public:
    explicit Lattice(const Problem &problem)
        : problem_(problem), obstacles_(obstacles_of(problem)) {}

    /// Floods the lattice from the cell of `from`.
    bool connects(const Configuration &from, const Configuration &to) {
        const std::size_t goal = cell_of(to);
        if (!straight(from, middle(cell_of(from))) || !straight(to, middle(goal))) {
            return false;
        }
        std::vector<bool> seen(CELLS[0] * CELLS[1] * CELLS[2]);
        std::vector<std::size_t> open = {cell_of(from)};
        seen[open[0]] = true;
        while (!open.empty()) {
            const std::size_t at = open.back();
            open.pop_back();
            if (at == goal) {
                return true;
            }
            for (const std::size_t next : neighbours(at)) {
                if (!seen[next] && straight(middle(at), middle(next))) {
                    seen[next] = true;
                    open.push_back(next);
                }
            }
        }
        return false;
    }

  private:
    static std::size_t cell_of(const Configuration &q) {
        std::size_t at[3];
        for (int i = 0; i < 3; ++i) {
            const double low = i < 2 ? -1 : -problems::pi;
            const double part = (q[i] - low) / (-2 * low);
            at[i] = static_cast<std::size_t>(part * static_cast<double>(CELLS[i]));
        }
        return (at[0] * CELLS[1] + at[1]) * CELLS[2] + at[2];
    }

    static Configuration middle(std::size_t cell) {
        const std::size_t at[3] = {cell / CELLS[2] / CELLS[1], cell / CELLS[2] % CELLS[1],
                                   cell % CELLS[2]};
        Configuration q(3);
        for (int i = 0; i < 3; ++i) {
            const double low = i < 2 ? -1 : -problems::pi;
            q[i] =
                low - 2 * low * (static_cast<double>(at[i]) + 0.5) / static_cast<double>(CELLS[i]);
        }
        return q;
    }

    static std::vector<std::size_t> neighbours(std::size_t cell) {
        const std::size_t x = cell / CELLS[2] / CELLS[1], y = cell / CELLS[2] % CELLS[1];
        const std::size_t turn = cell % CELLS[2], row = cell - turn;
        std::vector<std::size_t> out = {row + (turn + 1) % CELLS[2],
                                        row + (turn + CELLS[2] - 1) % CELLS[2]};
        const auto add_if = [&](bool exists, std::size_t next) {
            if (exists) {
                out.push_back(next);
            }
        };
        add_if(x > 0, cell - CELLS[1] * CELLS[2]);
        add_if(x + 1 < CELLS[0], cell + CELLS[1] * CELLS[2]);
        add_if(y > 0, cell - CELLS[2]);
        add_if(y + 1 < CELLS[1], cell + CELLS[2]);
        return out;
    }

    bool straight(const Configuration &a, const Configuration &b) {
        return query_.motion(obstacles_, a, b).outcome == CSTK_MOTION_FREE;
    }

    const Problem &problem_;
    const cstk::CObject obstacles_;
    cstk::Query query_;
};

Configuration random_free(const Problem &problem, Random &random) {
    cstk::Query query;
    const cstk::CObject obstacles = obstacles_of(problem);
    for (;;) {
        const Configuration q = {random.uniform(-1, 1), random.uniform(-1, 1),
                                 random.uniform(-3, 3)};
        if (query.classify(obstacles, q) != CSTK_CLASS_INSIDE) {
            return q;
        }
    }
}

} // namespace

int main(int count, char **arguments) {
    const long scenes = count > 1 ? std::atol(arguments[1]) : 60;
    const long seed = count > 2 ? std::atol(arguments[2]) : 1;
    long connected = 0, found = 0, missed = 0;
    for (long i = 0; i < scenes; ++i) {
        Random random(static_cast<std::uint64_t>(1000 * seed + i));
        Problem problem = random_problem(random);
        problem.start = random_free(problem, random);
        problem.goal = random_free(problem, random);
        const bool lattice = Lattice(problem).connects(problem.start, problem.goal);
        const bool planner = plan(problem).outcome == Outcome::FOUND;
        connected += lattice;
        found += planner;
        if (lattice && !planner) {
            std::printf("FAILED: scene %ld of seed %ld is missed\n", i, seed);
            ++missed;
        }
    }
    std::printf("%ld scenes: the whole grid connects %ld, the planner %ld; %ld missed\n", scenes,
                connected, found, missed);
    return missed == 0 ? 0 : 1;
}
