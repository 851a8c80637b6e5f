#include "problems.hpp"
#include "shapes.hpp"

namespace sandros::problems {

namespace {

/// Standard Denavit-Hartenberg parameters (Corke and Armstrong-Helouvry 1994), in metres and
/// radians, and the joint's limit to both sides in degrees.
struct Row {
    double d, a, alpha, limit;
};
const Row rows[6] = {
    {0.67183, 0, pi / 2, 160}, {0, 0.4318, 0, 110},  {0.15005, 0.0203, -pi / 2, 135},
    {0.4318, 0, pi / 2, 266},  {0, 0, -pi / 2, 100}, {0, 0, 0, 266}};

cstk::Body mesh(const std::string &folder, int link) {
    const std::string file = folder + "/link" + std::to_string(link) + ".stl";
    return cstk::BodyBuilder().add_mesh_file(file).build();
}

/// The number of the link that carries a mesh: each row is a joint, and behind it a fixed link.
std::uint32_t mesh_link(std::uint32_t number) { return 2 * number; }

cstk::Robot robot(const std::string &meshes) {
    cstk::RobotBuilder builder;
    cstk::Link base;
    base.name = "base";
    base.body = mesh(meshes, 0);
    std::uint32_t last = builder.add_link(base);
    for (int i = 0; i < 6; ++i) {
        const Row &row = rows[i];
        const double limit = row.limit * pi / 180;
        last = add_link(builder, "joint " + std::to_string(i + 1), static_cast<std::int32_t>(last),
                        {CSTK_JOINT_REVOLUTE, {0, 0, 1}, -limit, limit}, {0, 0, 0});
        cstk::Link link;
        link.name = "link " + std::to_string(i + 1);
        link.body = mesh(meshes, i + 1);
        link.parent = static_cast<std::int32_t>(last);
        link.at = cstk::pose_from_euler({row.a, 0, row.d, 0, 0, row.alpha});
        last = builder.add_link(link);
    }
    return builder.build();
}

} // namespace

Problem puma560(const std::string &meshes) {
    Problem problem;
    problem.name = "puma560";
    problem.robots = {robot(meshes)};
    problem.space = cstk::Space(problem.robots);
    /* Links with at least two others between them: nearer ones touch by design. */
    for (std::uint32_t a = 0; a <= 6; ++a) {
        for (std::uint32_t b = a + 3; b <= 6; ++b) {
            problem.link_pairs.push_back({mesh_link(a), mesh_link(b)});
        }
    }
    const std::vector<Box> table = {{{0.75, 0, 0.3}, {0.9, 1.6, 0.04}}};
    const std::vector<Box> post = {{{0.6, 0.05, 0.8}, {0.12, 0.12, 0.96}}};
    const std::vector<Box> shelf = {{{0.6, 0.55, 0.98}, {0.5, 0.5, 0.03}},
                                    {{0.6, 0.82, 0.65}, {0.5, 0.03, 0.7}}};
    const std::vector<Box> crates = {{{0.55, -0.3, 0.45}, {0.3, 0.06, 0.26}},
                                     {{0.55, -0.6, 0.45}, {0.3, 0.06, 0.26}}};
    for (const auto &boxes : {table, post, shelf, crates}) {
        problem.add_obstacle(body_of(boxes));
    }
    problem.start = {0.991, 0.437, -2.272, 0.007, -1.235, -0.208};
    problem.goal = {-0.461, 0.361, -2.352, -0.151, -1.709, -0.046};
    problem.axes = {{0, 16}, {1, 12}, {2, 12}, {3, 8}, {4, 8}, {5, 8}};
    problem.slide = {0.04, 0.08, 0.04};
    return problem;
}

} // namespace sandros::problems
