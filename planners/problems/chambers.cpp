#include "built_in.hpp"

namespace problems {

namespace {

/// Links of half a metre, each joint free to turn for ever: their coordinates are circles.
cstk::Robot planar_arm(int links) {
    const cstk::Body body = cstk::BodyBuilder().add_box(cstk::translation(0.25, 0, 0), {0.25, 0.03, 0.03}).build();
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.body = body;
    link.joint = CSTK_JOINT_REVOLUTE;
    for (int i = 0; i < links; ++i) {
        link.parent = static_cast<std::int32_t>(builder.add_link(link));
        link.at = cstk::translation(0.5, 0, 0);
    }
    return builder.build();
}

} // namespace

Problem chambers() {
    const double thick = 0.03, high = 0.2;
    // A wall to either side, with a slot that the arm reaches through.
    std::vector<Obstacle> obstacles;
    for (const double x : {-0.75, 0.75}) {
        obstacles.push_back(box(cstk::translation(x, 1.2, 0), {thick, 1, high}));
        obstacles.push_back(box(cstk::translation(x, -1.2, 0), {thick, 1, high}));
    }
    obstacles.push_back(box(cstk::translation(1.3, 0.5, 0), {0.3, thick, high}));
    const cstk::Robot robot = planar_arm(4);
    const cstk::Space space(robot);
    const std::vector<LinkPair> pairs = cstk::Query().find_link_pairs(space).tested;
    auto workcell = std::make_shared<const Workcell>(robot, space, obstacles, pairs);
    return {"chambers", "1", workcell, {0, 0, 0, 0}, {3.1, 0, 0, 0}, 1};
}

} // namespace problems
