#include "scenes.hpp"

#include "built_in.hpp"

#include <cmath>

namespace {

const std::size_t tries = 12000;

cstk::Pose turned_about_z(double angle, const std::array<double, 3> &at) {
    return cstk::pose_from_euler({at[0], at[1], at[2], angle, 0, 0});
}

Obstacle mesh_obstacle(const models::Mesh &mesh, const cstk::Pose &pose) {
    Numbers vertices;
    for (const models::Point &p : mesh.vertices) {
        vertices.insert(vertices.end(), p.begin(), p.end());
    }
    std::vector<std::uint32_t> triangles;
    for (const models::Triangle &t : mesh.triangles) {
        triangles.insert(triangles.end(), t.begin(), t.end());
    }
    return {cstk::BodyBuilder().add_triangles(vertices, triangles).build(), pose, {}};
}

// A table, two posts, a crate, a drum and a bumpy rock: the workcell of scenes/src/puma_arm.rs.
std::vector<Obstacle> workcell() {
    const std::array<double, 3> post = {0.04, 0.04, 0.8};
    return {problems::box(cstk::translation(0.55, 0, 0.3), {0.3, 0.6, 0.025}),
            problems::box(cstk::translation(-0.33, 0.39, 0.8), post),
            problems::box(cstk::translation(-0.33, -0.39, 0.8), post),
            problems::box(turned_about_z(0.4, {0.52, 0.2, 0.45}), {0.15, 0.125, 0.1}),
            mesh_obstacle(models::cylinder("drum", 0.15, 0.5, 24),
                          cstk::translation(0.07, -0.52, 0.9)),
            mesh_obstacle(models::sphere("rock", 0.2, 20, 26, 0.18),
                          cstk::translation(0.13, 0.46, 1.1))};
}

// Boxes at random around the robot's column and a table below; `scale` is 1 for a robot with a reach of 0.85 m.
std::vector<Obstacle> boxes(double scale) {
    const std::size_t count = 12;
    Random random(7);
    std::vector<Obstacle> made = {problems::box(cstk::translation(0, 0, -0.06 * scale),
                                               {scale, scale, 0.04 * scale})};
    while (made.size() <= count) {
        const double away = scale * random.uniform(0.45, 0.95),
                     around = random.uniform(-models::pi, models::pi);
        const auto half = [&] { return scale * random.uniform(0.03, 0.12); };
        const double x = half(), y = half(), z = half();
        const std::array<double, 6> at = {away * std::cos(around),
                                          away * std::sin(around),
                                          scale * random.uniform(0.1, 1.1),
                                          random.uniform(-3, 3),
                                          random.uniform(-1.5, 1.5),
                                          random.uniform(-3, 3)};
        made.push_back(problems::box(cstk::pose_from_euler(at), {x, y, z}));
    }
    return made;
}

// Four boards between two sides and a back, in front of the robot, and a table below.
std::vector<Obstacle> shelf(double scale) {
    std::vector<Obstacle> made;
    const auto add = [&](double x, double y, double z, double a, double b, double c) {
        made.push_back(problems::box(cstk::translation(scale * x, scale * y, scale * z),
                                    {scale * a, scale * b, scale * c}));
    };
    add(0, 0, -0.06, 1, 1, 0.04);
    for (const double height : {0.02, 0.3, 0.58, 0.86}) {
        add(0.62, 0, height, 0.15, 0.4, 0.01);
    }
    add(0.62, 0.41, 0.44, 0.15, 0.01, 0.44);
    add(0.62, -0.41, 0.44, 0.15, 0.01, 0.44);
    add(0.78, 0, 0.44, 0.01, 0.42, 0.44);
    return made;
}

// From a random configuration towards another: all within the joints' limits.
std::optional<Ends> towards_random(const Scene &scene, double length, Random &random) {
    std::uint64_t state = random.next();
    const Numbers from = scene.space.sample(state), to = scene.space.sample(state);
    if (scene.space.distance(from, to) < length) {
        return {};
    }
    return along(scene.space, from, scene.space.difference(from, to), length);
}

void add_arm(const std::string &name, const cstk::Robot &robot, std::vector<Obstacle> obstacles,
             Scenes &scenes) {
    const std::vector<LinkPair> pairs = cstk::Query().find_link_pairs(cstk::Space(robot)).tested;
    scenes.push_back(std::make_unique<Scene>(name, robot, std::move(obstacles), pairs, tries,
                                             towards_random));
}

cstk::Robot urdf_robot(const std::string &folder, const std::string &urdf) {
    const std::string packages = folder + "/cmeel.prefix/share";
    const char *paths[] = {packages.c_str()};
    cstk_urdf_options options = cstk::urdf_options();
    options.package_paths = paths;
    options.package_path_count = 1;
    cstk::RobotBuilder builder;
    builder.load_urdf(packages + "/example-robot-data/robots/" + urdf, options);
    return builder.build();
}

} // namespace

void add_puma_scene(const std::string &folder, Scenes &scenes) {
    add_arm("Puma 560 workcell", problems::puma_560(folder), workcell(), scenes);
}

void add_urdf_scenes(const std::string &folder, Scenes &scenes) {
    const cstk::Robot panda = urdf_robot(folder, "panda_description/urdf/panda.urdf"),
                      ur10 = urdf_robot(folder, "ur_description/urdf/ur10_robot.urdf");
    const double ur10_scale = 1.5;
    add_arm("Panda boxes", panda, boxes(1), scenes);
    add_arm("Panda shelf", panda, shelf(1), scenes);
    add_arm("UR10 boxes", ur10, boxes(ur10_scale), scenes);
    add_arm("UR10 shelf", ur10, shelf(ur10_scale), scenes);
}
