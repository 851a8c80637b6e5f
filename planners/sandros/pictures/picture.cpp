#include "picture.hpp"

#include "../obstacles.hpp"
#include "../path.hpp"
#include "glb.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace sandros::pictures {

namespace {

const Colour obstacle = {1.00f, 0.88f, 0.66f};
/// Robots take turns.
const Colour robots[] = {{0.52f, 0.70f, 1.00f}, {0.55f, 0.90f, 0.55f}};
const Colour trail = {0.90f, 0.10f, 0.10f};

const std::size_t FRAMES = 240;
const double SECONDS = 8;
const std::size_t TRAIL_POINTS = 150;

/// By link of the space: its body's mesh in a colour; none for links that show nothing.
using LinkMeshes = std::vector<std::optional<std::size_t>>;

LinkMeshes add_link_meshes(Glb &glb, const Problem &problem) {
    LinkMeshes meshes;
    for (std::size_t r = 0; r < problem.robots.size(); ++r) {
        const cstk::Robot &robot = problem.robots[r];
        for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
            meshes.emplace_back();
            if (robot.link_info(link).has_body) {
                const Triangles triangles = triangles_of(robot.body(link));
                if (!triangles.empty()) {
                    meshes.back() = glb.add_mesh(triangles, robots[r % std::size(robots)]);
                }
            }
        }
    }
    return meshes;
}

void add_obstacles(Glb &glb, const Problem &problem) {
    for (const auto &[body, pose] : problem.obstacles) {
        glb.add_node("obstacle", glb.add_mesh(triangles_of(body), obstacle), pose);
    }
}

void add_robot(Glb &glb, const Problem &problem, const LinkMeshes &meshes, const Configuration &q) {
    const std::vector<cstk::Pose> poses = problem.space.link_poses(q);
    for (std::size_t link = 0; link < meshes.size(); ++link) {
        if (meshes[link]) {
            glb.add_node("link", *meshes[link], poses[link]);
        }
    }
}

/// Configurations at equal distances along the path.
Path evenly_along(const Problem &problem, const Path &path, std::size_t count) {
    if (path.size() < 2) {
        return Path(count, path.front());
    }
    const double whole = length(problem, path);
    Path out;
    std::size_t segment = 1;
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = whole * static_cast<double>(i) / static_cast<double>(count - 1);
        double way = problem.space.distance(path[segment - 1], path[segment]);
        while (before + way < at && segment + 1 < path.size()) {
            before += way;
            ++segment;
            way = problem.space.distance(path[segment - 1], path[segment]);
        }
        const double part = way > 0 ? std::min((at - before) / way, 1.0) : 1;
        out.push_back(problem.space.interpolate(path[segment - 1], path[segment], part));
    }
    return out;
}

/// Dots where the origin of each robot's last link passes.
void add_trail(Glb &glb, const Problem &problem, const Path &path, double size) {
    const cstk::Body dot =
        cstk::BodyBuilder().add_box(cstk::identity(), {size, size, size}).build();
    const std::size_t mesh = glb.add_mesh(triangles_of(dot), trail);
    for (const Configuration &q : evenly_along(problem, path, TRAIL_POINTS)) {
        const std::vector<cstk::Pose> poses = problem.space.link_poses(q);
        std::size_t last = 0;
        for (const cstk::Robot &each : problem.robots) {
            last += each.link_count();
            glb.add_node("trail", mesh, poses[last - 1]);
        }
    }
}

} // namespace

Triangles triangles_of(const cstk::Body &body) {
    Triangles triangles;
    const std::uint64_t count = body.statistics().primitive_count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const cstk_primitive primitive = body.primitive(i);
        for (std::uint32_t face = 0; face < primitive.face_count; ++face) {
            const std::vector<double> xyz = body.feature_vertices(i, CSTK_FEATURE_FACE, face);
            const auto corner = [&](std::size_t k) {
                return std::array<double, 3>{xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]};
            };
            for (std::size_t k = 2; 3 * k < xyz.size(); ++k) {
                triangles.insert(triangles.end(), {corner(0), corner(k - 1), corner(k)});
            }
        }
    }
    return triangles;
}

void draw_motion(const Problem &problem, const Path &path, const std::string &file) {
    obstacles_of(problem).show_path(flat(path), path.size(), SECONDS, file);
}

void draw_moment(const Problem &problem, const Path &path, double part, const std::string &file) {
    Glb glb;
    add_obstacles(glb, problem);
    const Path moments = evenly_along(problem, path, FRAMES);
    const auto moment = static_cast<std::size_t>(part * (FRAMES - 1));
    add_robot(glb, problem, add_link_meshes(glb, problem), moments[moment]);
    add_trail(glb, problem, path, problem.slide.shell / 16);
    glb.write(file);
}

} // namespace sandros::pictures
