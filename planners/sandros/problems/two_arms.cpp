#include "problems.hpp"
#include "shapes.hpp"

namespace sandros::problems {

namespace {

enum Link : std::uint32_t { BASE, SHOULDER, UPPER_ARM, FOREARM, WRIST, HAND, FINGERS, LINKS };

/// At coordinates 0 the upper arm is upright, and forearm and hand point away from the base. Where
/// the base stands is x; `facing` is 1 or -1, along x.
cstk::Robot arm(const std::string &name, double x, double facing) {
    const auto turn = [](Vector axis, double limit) {
        return Joint{CSTK_JOINT_REVOLUTE, axis, -limit, limit};
    };
    const auto add = [&](cstk::RobotBuilder &builder, std::uint32_t link, Vector axis, double limit,
                         const Vector &at, const std::vector<Box> &boxes) {
        add_link(builder, name + " " + std::to_string(link), static_cast<std::int32_t>(link) - 1,
                 turn(axis, limit), at, body_of(boxes));
    };
    cstk::RobotBuilder builder;
    cstk::Link base;
    base.name = name + " base";
    base.body = body_of({{{0, 0, 0.1}, {0.2, 0.2, 0.2}}});
    base.at = {facing, 0, 0, x, 0, facing, 0, 0, 0, 0, 1, 0};
    builder.add_link(base);
    add(builder, SHOULDER, {0, 0, 1}, 2.8, {0, 0, 0.2}, {{{0, 0, 0.1}, {0.14, 0.14, 0.18}}});
    add(builder, UPPER_ARM, {0, 1, 0}, 2, {0, 0.13, 0.12}, {{{0, 0, 0.2}, {0.12, 0.1, 0.52}}});
    add(builder, FOREARM, {0, 1, 0}, 2.6, {0, -0.1, 0.4}, {{{0.14, 0, 0}, {0.4, 0.08, 0.1}}});
    add(builder, WRIST, {1, 0, 0}, 3, {0.34, 0, 0}, {{{0.05, 0, 0}, {0.09, 0.06, 0.06}}});
    add(builder, HAND, {0, 1, 0}, 1.9, {0.12, 0, 0}, {{{0.04, 0, 0}, {0.1, 0.05, 0.05}}});
    add(builder, FINGERS, {1, 0, 0}, 3, {0.09, 0, 0},
        {{{0.02, 0, 0}, {0.03, 0.14, 0.05}},
         {{0.07, 0.055, 0}, {0.09, 0.02, 0.03}},
         {{0.07, -0.055, 0}, {0.09, 0.02, 0.03}}});
    return builder.build();
}

/// Links of one arm with at least one other between them, and every link of one arm with every link
/// of the other.
std::vector<std::array<std::uint32_t, 2>> pairs_that_may_not_meet() {
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::uint32_t a = 0; a < LINKS; ++a) {
        for (std::uint32_t b = 0; b < LINKS; ++b) {
            if (a + 2 < b) {
                pairs.push_back({a, b});
                pairs.push_back({LINKS + a, LINKS + b});
            }
            pairs.push_back({a, LINKS + b});
        }
    }
    return pairs;
}

} // namespace

Problem two_arms() {
    Problem problem;
    problem.name = "two_arms";
    problem.robots = {arm("left", -0.5, 1), arm("right", 0.5, -1)};
    problem.space = cstk::Space(problem.robots);
    problem.link_pairs = pairs_that_may_not_meet();
    problem.add_obstacle(body_of({{{0, 0, -0.05}, {1.8, 1.4, 0.08}},
                                  {{0, 0.4, 0.03}, {0.24, 0.2, 0.08}},
                                  {{0, -0.4, 0.03}, {0.24, 0.2, 0.08}}}));
    /* Each arm turns its waist from one side to the other, low over the table. */
    problem.start = {-0.75, 0.75, -0.1, 0, 0.7, 0, -0.75, 0.75, -0.1, 0, 0.7, 0};
    problem.goal = {0.75, 0.75, -0.1, 0, 0.7, 0, 0.75, 0.75, -0.1, 0, 0.7, 0};
    for (std::size_t joint = 0; joint < 6; ++joint) {
        const std::size_t cells = joint < 3 ? 12 : 8;
        problem.axes.push_back({joint, cells});
        problem.axes.push_back({6 + joint, cells});
    }
    problem.slide = {0.06, 0.12, 0.12};
    return problem;
}

} // namespace sandros::problems
