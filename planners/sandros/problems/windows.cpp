#include "built_in.hpp"
#include "problems.hpp"
#include "rigid_body.hpp"

namespace sandros::problems {

Problem windows() {
    Problem problem;
    problem.name = "windows";
    /* Its legs are a unit long; the origin is in the corner. */
    const cstk::Body l = body_of({{{0.35, 0, 0}, {1, 0.3, 0.3}}, {{0, 0, 0.5}, {0.3, 0.3, 0.7}}});
    problem.robots = {free_body("L", l, 0.15, {{-2.5, -2, -2}, {2.5, 2, 2}})};
    problem.space = cstk::Space(problem.robots);
    /* The first is too small for the flat L, which is 1 wide and 0.3 thick, even along its
       diagonal: one leg goes through, then the other is pulled after it. The second is a slot. */
    for (const ::problems::Window &window : {::problems::Window{{-0.9, 0, 0}, {0.4, 0.4}},
                                             ::problems::Window{{0.9, 0, 0}, {0.8, 0.3}}}) {
        for (const ::problems::Obstacle &board : ::problems::wall_around(window, 2, 0.15)) {
            problem.add_obstacle(board.body, board.pose);
        }
    }
    problem.start = {-2, 0.8, -0.8, 0, 0, 0};
    problem.goal = {2, -0.8, 0.8, 2, 0.5, 1};
    problem.axes = {{0, 10}, {1, 8}, {2, 8}, {3, 8}, {4, 4}, {5, 8}};
    problem.slide = {0.06, 0.15, 0.15};
    return problem;
}

} // namespace sandros::problems
