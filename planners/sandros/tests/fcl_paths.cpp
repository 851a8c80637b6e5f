// FCL judges every path of the planner: no collision at 10^4 points of each motion.
//
//   fcl_paths [PUMA_MESHES]
#include "../path.hpp"
#include "../pictures/picture.hpp"
#include "../planner.hpp"
#include "../problems/problems.hpp"

#include <fcl/fcl.h>

#include <cstdio>
#include <fstream>
#include <memory>

namespace {

using namespace sandros;

const int POINTS_A_MOTION = 10000;

using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Mesh> mesh_of(const cstk::Body &body) {
    std::vector<fcl::Vector3d> corners;
    std::vector<fcl::Triangle> triangles;
    for (const auto &corner : pictures::triangles_of(body)) {
        if (corners.size() % 3 == 0) {
            triangles.emplace_back(corners.size(), corners.size() + 1, corners.size() + 2);
        }
        corners.emplace_back(corner[0], corner[1], corner[2]);
    }
    auto mesh = std::make_shared<Mesh>();
    mesh->beginModel();
    mesh->addSubModel(corners, triangles);
    mesh->endModel();
    return mesh;
}

fcl::Transform3d transform_of(const cstk::Pose &pose) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
            transform(i, j) = pose[static_cast<std::size_t>(4 * i + j)];
        }
    }
    return transform;
}

/// The problem as FCL has it.
class Judge {
  public:
    explicit Judge(const Problem &problem) : problem_(problem) {
        for (const cstk::Robot &robot : problem.robots) {
            for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
                links_.push_back(nullptr);
                if (robot.link_info(link).has_body &&
                    !pictures::triangles_of(robot.body(link)).empty()) {
                    links_.back() = mesh_of(robot.body(link));
                }
            }
        }
        for (const auto &[body, pose] : problem.obstacles) {
            obstacles_.emplace_back(mesh_of(body), transform_of(pose));
        }
        const std::vector<cstk::Pose> start = problem.space.link_poses(problem.start);
        const std::vector<cstk::Pose> goal = problem.space.link_poses(problem.goal);
        for (std::size_t link = 0; link < start.size(); ++link) {
            moves_.push_back(start[link] != goal[link]);
        }
    }

    bool in_collision(const Configuration &q) const {
        const std::vector<cstk::Pose> poses = problem_.space.link_poses(q);
        const auto meet = [](const std::shared_ptr<Mesh> &a, const fcl::Transform3d &at_a,
                             const std::shared_ptr<Mesh> &b, const fcl::Transform3d &at_b) {
            fcl::CollisionResultd result;
            return fcl::collide(a.get(), at_a, b.get(), at_b, fcl::CollisionRequestd(), result) > 0;
        };
        for (std::size_t link = 0; link < links_.size(); ++link) {
            for (const auto &[mesh, at] : obstacles_) {
                if (links_[link] && moves_[link] &&
                    meet(links_[link], transform_of(poses[link]), mesh, at)) {
                    return true;
                }
            }
        }
        for (const auto &[a, b] : problem_.link_pairs) {
            if (links_[a] && links_[b] &&
                meet(links_[a], transform_of(poses[a]), links_[b], transform_of(poses[b]))) {
                return true;
            }
        }
        return false;
    }

  private:
    const Problem &problem_;
    std::vector<std::shared_ptr<Mesh>> links_;
    std::vector<std::pair<std::shared_ptr<Mesh>, fcl::Transform3d>> obstacles_;
    /// A base that stands still is not asked about.
    std::vector<bool> moves_;
};

long collisions_on(const Problem &problem, const Path &path) {
    const Judge judge(problem);
    long collisions = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        for (int k = 0; k <= POINTS_A_MOTION; ++k) {
            const double part = static_cast<double>(k) / POINTS_A_MOTION;
            collisions += judge.in_collision(problem.space.interpolate(path[i - 1], path[i], part));
        }
    }
    return collisions;
}

} // namespace

int main(int count, char **arguments) {
    std::vector<Problem> problems = problems::generated();
    if (count > 1 && std::ifstream(std::string(arguments[1]) + "/link6.stl")) {
        problems.push_back(problems::puma560(arguments[1]));
    } else {
        std::printf("SKIPPED: the Puma 560, whose meshes are not there\n");
    }
    long failures = 0;
    for (const Problem &problem : problems) {
        const Plan made = plan(problem);
        if (made.outcome != Outcome::FOUND) {
            std::printf("%s: %s\n", problem.name.c_str(), name_of(made.outcome));
            continue;
        }
        const long on_path = collisions_on(problem, made.path);
        /* The judge must be able to say no: straight from start to goal all of these collide. */
        const long straight = collisions_on(problem, {problem.start, problem.goal});
        std::printf("%s: %zu motions, %ld points in collision; straight from start to goal %ld\n",
                    problem.name.c_str(), made.path.size() - 1, on_path, straight);
        failures += on_path != 0 || straight == 0;
    }
    return failures == 0 ? 0 : 1;
}
