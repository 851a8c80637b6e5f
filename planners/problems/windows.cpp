#include "built_in.hpp"

#include <cmath>

namespace problems {

namespace {

/// Half sides, in metres.
const double wall = 1.5, window = 0.33, thickness = 0.02;

/// Four boards about a window whose middle is at (x, y, z).
void add_wall(double x, double y, double z, std::vector<Obstacle> &obstacles) {
    const double below = (z - window + wall) / 2, above = (wall - z - window) / 2;
    const double right = (y - window + wall) / 2, left = (wall - y - window) / 2;
    obstacles.push_back(box(cstk::translation(x, 0, below - wall), {thickness, wall, below}));
    obstacles.push_back(box(cstk::translation(x, 0, wall - above), {thickness, wall, above}));
    obstacles.push_back(box(cstk::translation(x, right - wall, z), {thickness, right, window}));
    obstacles.push_back(box(cstk::translation(x, wall - left, z), {thickness, left, window}));
}

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

Problem windows() {
    std::vector<Obstacle> obstacles;
    add_wall(0, 0.3, 0.2, obstacles);
    add_wall(1, -0.3, -0.2, obstacles);
    const cstk::Robot robot = flying_l();
    auto workcell = std::make_shared<const Workcell>(robot, cstk::Space(robot), obstacles, std::vector<LinkPair>());
    const double half = std::sqrt(0.5);
    return {"windows", "1", workcell, {-0.7, 0, 0, 0, 0, 0, 1}, {1.7, 0, 0, 0, 0, half, half}, 0.6};
}

} // namespace problems
