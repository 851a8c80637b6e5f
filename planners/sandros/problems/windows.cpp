#include "problems.hpp"
#include "rigid_body.hpp"

namespace sandros::problems {

namespace {

/// A wall across x with an opening around its middle; y and z from -2 to 2.
cstk::Body wall(double x, double width, double height) {
    const double thick = 0.3, beside = (4 - width) / 2, above = (4 - height) / 2;
    return body_of({{{x, width / 2 + beside / 2, 0}, {thick, beside, 4}},
                    {{x, -width / 2 - beside / 2, 0}, {thick, beside, 4}},
                    {{x, 0, height / 2 + above / 2}, {thick, width, above}},
                    {{x, 0, -height / 2 - above / 2}, {thick, width, above}}});
}

} // namespace

Problem windows() {
    Problem problem;
    problem.name = "windows";
    /* Its legs are a unit long; the origin is in the corner. */
    const cstk::Body l = body_of({{{0.35, 0, 0}, {1, 0.3, 0.3}}, {{0, 0, 0.5}, {0.3, 0.3, 0.7}}});
    problem.robots = {free_body("L", l, 0.15, {{-2.5, -2, -2}, {2.5, 2, 2}})};
    problem.space = cstk::Space(problem.robots);
    /* The first is too small for the flat L, which is 1 wide and 0.3 thick, even along its
       diagonal: one leg goes through, then the other is pulled after it. The second is a slot. */
    problem.add_obstacle(wall(-0.9, 0.8, 0.8));
    problem.add_obstacle(wall(0.9, 1.6, 0.6));
    problem.start = {-2, 0.8, -0.8, 0, 0, 0};
    problem.goal = {2, -0.8, 0.8, 2, 0.5, 1};
    problem.axes = {{0, 10}, {1, 8}, {2, 8}, {3, 8}, {4, 4}, {5, 8}};
    problem.slide = {0.06, 0.15, 0.15};
    return problem;
}

} // namespace sandros::problems
