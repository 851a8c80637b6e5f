#include "problems.hpp"
#include "rigid_body.hpp"

namespace sandros::problems {

Problem bug_trap(bool open) {
    Problem problem;
    problem.name = open ? "bug_trap_open" : "bug_trap";
    const cstk::Body stick = body_of({{{0, 0, 0}, {0.5, 0.1, 0.1}}});
    problem.robots = {body_on_plane("stick", stick, 0.05, {{-2, -2, 0}, {2, 2, 0}})};
    problem.space = cstk::Space(problem.robots);
    /* A box with a mouth on the right, whose lips reach inwards. */
    std::vector<Box> walls = {{{-1.1, 0, 0}, {0.2, 2.4, 0.3}},   {{0, 1.1, 0}, {2.4, 0.2, 0.3}},
                              {{0, -1.1, 0}, {2.4, 0.2, 0.3}},   {{1.1, 0.6, 0}, {0.2, 0.9, 0.3}},
                              {{1.1, -0.6, 0}, {0.2, 0.9, 0.3}}, {{0.7, 0.2, 0}, {0.8, 0.1, 0.3}},
                              {{0.7, -0.2, 0}, {0.8, 0.1, 0.3}}};
    if (!open) {
        walls.push_back({{1.1, 0, 0}, {0.2, 0.5, 0.3}});
    }
    problem.add_obstacle(body_of(walls));
    problem.start = {-0.6, 0, 1};
    problem.goal = {1.7, 0.5, 0};
    problem.axes = {{0, 40}, {1, 40}, {2, 16}};
    problem.slide = {0.05, 0.12, 0.12};
    return problem;
}

} // namespace sandros::problems
