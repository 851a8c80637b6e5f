#include "built_in.hpp"

#include <cmath>

namespace problems {

namespace {

const double degree = std::acos(-1.0) / 180;

/// The standard Denavit-Hartenberg parameters in metres and degrees (Corke and Armstrong-Helouvry, 1994; the base adds its height
/// to the first d), and how far each joint goes either way.
struct Joint {
    double d, a, alpha, limit;
};

const Joint joints[] = {{0.67183, 0, 90, 160},  {0, 0.4318, 0, 110}, {0.15005, 0.0203, -90, 135},
                        {0.4318, 0, 90, 266}, {0, 0, -90, 100},    {0, 0, 0, 266}};

cstk::Body mesh(const std::string &folder, int number) {
    return cstk::BodyBuilder().add_mesh_file(folder + "/link" + std::to_string(number) + ".stl").build();
}

} // namespace

// A joint turns about z of the link before it; the mesh is in the frame behind its d, a and alpha.
cstk::Robot puma_560(const std::string &folder) {
    cstk::RobotBuilder builder;
    cstk::Link base;
    base.body = mesh(folder, 0);
    auto last = static_cast<std::int32_t>(builder.add_link(base));
    int number = 0;
    for (const Joint &joint : joints) {
        cstk::Link turning, link;
        turning.parent = last;
        turning.joint = CSTK_JOINT_REVOLUTE;
        turning.lower = -joint.limit * degree;
        turning.upper = joint.limit * degree;
        link.parent = static_cast<std::int32_t>(builder.add_link(turning));
        link.at = cstk::pose_from_euler({joint.a, 0, joint.d, 0, 0, joint.alpha * degree});
        link.body = mesh(folder, ++number);
        last = static_cast<std::int32_t>(builder.add_link(link));
    }
    return builder.build();
}

Problem puma_cell(const std::string &folder) {
    const std::array<double, 3> post = {0.04, 0.04, 0.8};
    const std::vector<Obstacle> obstacles = {
        box(cstk::translation(0.55, 0, 0.3), {0.3, 0.6, 0.025}),
        box(cstk::translation(-0.33, 0.39, 0.8), post),
        box(cstk::translation(-0.33, -0.39, 0.8), post),
        box(cstk::pose_from_euler({0.52, 0.2, 0.45, 0.4, 0, 0}), {0.15, 0.125, 0.1}),
        cylinder(cstk::translation(0.07, -0.52, 0.9), 0.15, 0.25),
    };
    const cstk::Robot robot = puma_560(folder);
    const cstk::Space space(robot);
    const std::vector<LinkPair> pairs = cstk::Query().find_link_pairs(space).tested;
    auto workcell = std::make_shared<const Workcell>(robot, space, obstacles, pairs);
    Configuration start = {0, 0, -120, 0, 60, 0}, goal = {-90, -60, 15, 0, 30, 0};
    for (Configuration *q : {&start, &goal}) {
        for (double &angle : *q) {
            angle *= degree;
        }
    }
    return {"Puma 560 workcell", "1", workcell, start, goal, 0.6};
}

} // namespace problems
