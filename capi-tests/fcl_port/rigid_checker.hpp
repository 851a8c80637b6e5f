// A planner's checker for a free-flying robot among obstacles, as OMPL.app has one: whether a state is valid, how far from
// contact it is, and whether a motion is valid. Nothing in it tells which library answers.
#ifndef CSTK_FCL_PORT_RIGID_CHECKER_HPP
#define CSTK_FCL_PORT_RIGID_CHECKER_HPP

#include "library.hpp"

class RigidChecker {
  public:
    RigidChecker(std::vector<std::shared_ptr<Model>> robot, std::shared_ptr<Model> obstacles)
        : robot_(std::move(robot)), obstacles_(std::move(obstacles)) {}

    bool is_valid(const Transform &state) const {
        const fcl::CollisionRequestd request;
        for (const auto &part : robot_) {
            fcl::CollisionResultd result;
            if (fcl::collide<double>(part.get(), state, obstacles_.get(), Transform::Identity(), request, result) > 0) {
                return false;
            }
        }
        return true;
    }

    double clearance(const Transform &state) const {
        const fcl::DistanceRequestd request(true);
        double least = std::numeric_limits<double>::infinity();
        for (const auto &part : robot_) {
            fcl::DistanceResultd result;
            fcl::distance<double>(part.get(), state, obstacles_.get(), Transform::Identity(), request, result);
            least = std::min(least, static_cast<double>(result.min_distance));
        }
        return least;
    }

    // `last_valid` receives the time up to which the motion is valid.
    bool is_valid(const Transform &from, const Transform &to, double &last_valid) const {
        const fcl::ContinuousCollisionRequestd request(10, 0.0001, fcl::CCDM_SCREW, fcl::GST_LIBCCD,
                                                       fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
        bool valid = true;
        last_valid = 1;
        for (const auto &part : robot_) {
            fcl::ContinuousCollisionResultd result;
            fcl::continuousCollide<double>(part.get(), from, to, obstacles_.get(), Transform::Identity(), Transform::Identity(),
                                           request, result);
            if (result.is_collide) {
                valid = false;
                last_valid = std::min(last_valid, static_cast<double>(result.time_of_contact));
            }
        }
        return valid;
    }

  private:
    std::vector<std::shared_ptr<Model>> robot_;
    std::shared_ptr<Model> obstacles_;
};

#endif
