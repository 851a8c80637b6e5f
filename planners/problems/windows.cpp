#include "built_in.hpp"

#include <cmath>

namespace problems {

namespace {

/// Two arms of 0.6 m and 0.1 m square. It is carried by three slides and a ball joint, which make Space::distance a metric.
cstk::Robot flying_l() {
    const cstk::Body body = cstk::BodyBuilder()
                                .add_box(cstk::translation(0.25, 0, 0), {0.3, 0.05, 0.05})
                                .add_box(cstk::translation(0, 0.25, 0), {0.05, 0.3, 0.05})
                                .build();
    const std::array<double, 3> axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double reach[][2] = {{-1, 2}, {-0.9, 0.9}, {-0.9, 0.9}};
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.joint = CSTK_JOINT_PRISMATIC;
    for (int i = 0; i < 3; ++i) {
        link.axis = axes[i];
        link.lower = reach[i][0];
        link.upper = reach[i][1];
        link.parent = static_cast<std::int32_t>(builder.add_link(link));
    }
    cstk::Link turning;
    turning.parent = link.parent;
    turning.joint = CSTK_JOINT_SPHERICAL;
    turning.body = body;
    builder.add_link(turning);
    return builder.build();
}

} // namespace

std::vector<Obstacle> wall_around(const Window &window, double half_side, double half_thickness) {
    const auto [x, y, z] = window.middle;
    const auto [across, up] = window.half_sides;
    const double below = (z - up + half_side) / 2, above = (half_side - z - up) / 2;
    const double right = (y - across + half_side) / 2, left = (half_side - y - across) / 2;
    return {box(cstk::translation(x, 0, below - half_side), {half_thickness, half_side, below}),
            box(cstk::translation(x, 0, half_side - above), {half_thickness, half_side, above}),
            box(cstk::translation(x, right - half_side, z), {half_thickness, right, up}),
            box(cstk::translation(x, half_side - left, z), {half_thickness, left, up})};
}

Problem windows() {
    const std::array<double, 2> half_sides = {0.33, 0.33};
    std::vector<Obstacle> obstacles = wall_around({{0, 0.3, 0.2}, half_sides}, 1.5, 0.02);
    const std::vector<Obstacle> second = wall_around({{1, -0.3, -0.2}, half_sides}, 1.5, 0.02);
    obstacles.insert(obstacles.end(), second.begin(), second.end());
    const cstk::Robot robot = flying_l();
    auto workcell = std::make_shared<const Workcell>(robot, cstk::Space(robot), obstacles, std::vector<LinkPair>());
    const double half = std::sqrt(0.5);
    return {"windows", "1", workcell, {-0.7, 0, 0, 0, 0, 0, 1}, {1.7, 0, 0, 0, 0, half, half}, 0.6};
}

} // namespace problems
