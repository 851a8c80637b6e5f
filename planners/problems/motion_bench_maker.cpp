#include "motion_bench_maker.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace problems {

namespace {

const std::string suffix = "_panda";
const double range = 1.5;

cstk::Robot load_robot(const std::string &folder) {
    // The meshes are those of package://meshes.
    const char *paths[] = {folder.c_str()};
    cstk_urdf_options options = cstk::urdf_options();
    options.package_paths = paths;
    options.package_path_count = 1;
    cstk::RobotBuilder builder;
    builder.load_urdf(folder + "/panda.urdf", options);
    builder.load_srdf(folder + "/panda.srdf");
    return builder.build();
}

Obstacle read_obstacle(const YAML::Node &shape, const YAML::Node &at) {
    const auto position = at["position"].as<std::array<double, 3>>();
    const auto turn = at["orientation"].as<std::array<double, 4>>();
    const cstk::Pose pose = cstk::pose_from_quaternion({position[0], position[1], position[2], turn[0], turn[1], turn[2], turn[3]});
    const auto kind = shape["type"].as<std::string>();
    const auto sizes = shape["dimensions"].as<std::vector<double>>();
    if (kind == "box" && sizes.size() == 3) {
        return box(pose, {sizes[0] / 2, sizes[1] / 2, sizes[2] / 2});
    }
    if (kind == "cylinder" && sizes.size() == 2) {
        return cylinder(pose, sizes[1], sizes[0] / 2);
    }
    throw std::runtime_error("an obstacle that is neither a box nor a cylinder: " + kind);
}

std::vector<Obstacle> read_obstacles(const std::string &file) {
    std::vector<Obstacle> found;
    for (const YAML::Node &object : YAML::LoadFile(file)["world"]["collision_objects"]) {
        for (std::size_t i = 0; i < object["primitives"].size(); ++i) {
            found.push_back(read_obstacle(object["primitives"][i], object["primitive_poses"][i]));
        }
    }
    return found;
}

/// Where the joint's coordinate stands in q; none for a joint that does not move.
std::optional<std::size_t> coordinate(const cstk::Robot &robot, const std::string &joint) {
    const cstk_link_info info = robot.link_info(robot.find_joint(joint));
    return info.nq == 1 ? std::optional<std::size_t>(info.coordinate) : std::nullopt;
}

Configuration read_start(const cstk::Robot &robot, const YAML::Node &request) {
    const YAML::Node state = request["start_state"]["joint_state"];
    Configuration q(robot.nq());
    for (std::size_t i = 0; i < state["name"].size(); ++i) {
        if (const auto at = coordinate(robot, state["name"][i].as<std::string>())) {
            q[*at] = state["position"][i].as<double>();
        }
    }
    return q;
}

Configuration read_goal(const cstk::Robot &robot, const YAML::Node &request) {
    Configuration q(robot.nq());
    for (const YAML::Node &joint : request["goal_constraints"][0]["joint_constraints"]) {
        if (const auto at = coordinate(robot, joint["joint_name"].as<std::string>())) {
            q[*at] = joint["position"].as<double>();
        }
    }
    return q;
}

} // namespace

Panda::Panda(const std::string &folder)
    : folder_(folder), robot_(load_robot(folder)), space_(robot_), pairs_(space_.enabled_pairs()) {}

std::vector<std::string> Panda::scenes() const {
    std::vector<std::string> found;
    for (const auto &entry : std::filesystem::directory_iterator(folder_ + "/problems")) {
        const std::string name = entry.path().filename().string();
        found.push_back(name.substr(0, name.rfind(suffix)));
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<Problem> Panda::problems(const std::string &scene, std::size_t count) const {
    std::vector<Problem> found;
    for (std::size_t number = 1; number <= count; ++number) {
        char name[8];
        std::snprintf(name, sizeof name, "%04zu", number);
        const std::string folder = folder_ + "/problems/" + scene + suffix + "/";
        const YAML::Node request = YAML::LoadFile(folder + "request" + name + ".yaml");
        auto workcell = std::make_shared<const Workcell>(robot_, space_, read_obstacles(folder + "scene" + name + ".yaml"), pairs_);
        found.push_back({scene, name, std::move(workcell), read_start(robot_, request), read_goal(robot_, request), range});
    }
    return found;
}

} // namespace problems
