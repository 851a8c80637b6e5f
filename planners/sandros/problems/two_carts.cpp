#include "problems.hpp"
#include "rigid_body.hpp"

namespace sandros::problems {

Problem two_carts() {
    Problem problem;
    problem.name = "two_carts";
    const cstk::Body cart = body_of({{{0, 0, 0}, {0.6, 0.4, 0.3}}});
    const Room room = {{-2, -0.5, 0}, {2, 1.5, 0}};
    problem.robots = {body_on_plane("left cart", cart, 0.2, room),
                      body_on_plane("right cart", cart, 0.2, room)};
    problem.space = cstk::Space(problem.robots);
    /* A corridor along x with a bay in its middle. */
    problem.add_obstacle(body_of({{{0, -0.6, 0}, {4.8, 0.4, 0.4}},
                                  {{-1.45, 1.1, 0}, {1.9, 1.4, 0.4}},
                                  {{1.45, 1.1, 0}, {1.9, 1.4, 0.4}},
                                  {{0, 1.6, 0}, {1, 0.4, 0.4}},
                                  {{-2.4, 0, 0}, {0.2, 0.8, 0.4}},
                                  {{2.4, 0, 0}, {0.2, 0.8, 0.4}}}));
    const std::uint32_t left = 2, right = 5, left_core = 1, right_core = 4;
    problem.link_pairs = {{left, right}, {left_core, right_core}};
    problem.start = {-1.5, 0, 0, 1.5, 0, 0};
    problem.goal = {1.5, 0, 0, -1.5, 0, 0};
    problem.axes = {{0, 8}, {3, 8}, {1, 4}, {4, 4}, {2, 8}, {5, 8}};
    problem.slide = {0.05, 0.12, 0.12};
    return problem;
}

} // namespace sandros::problems
