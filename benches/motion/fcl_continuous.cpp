#include "fcl_types.hpp"
#include "peer.hpp"

namespace {

// With OBBRSS it finds no contact at all: two cubes that are pushed through each other are called free.
using Volume = fcl::RSS<double>;
using Model = std::shared_ptr<fcl::BVHModel<Volume>>;

// Of the time of contact, as a part of the motion: FCL's default.
const double time_error = 1e-4;
const std::size_t max_iterations = 10000;

} // namespace

struct FclContinuous::Models {
    Model moving;
    std::vector<std::pair<Model, fcl::Transform3<double>>> obstacles;
};

FclContinuous::FclContinuous(const PeerScene &scene) : models_(std::make_unique<Models>()) {
    models_->moving = fcl_mesh<Volume>(scene.links.at(0));
    for (const PeerScene::Obstacle &obstacle : scene.obstacles) {
        models_->obstacles.emplace_back(fcl_mesh<Volume>(obstacle.surface),
                                        fcl_pose(obstacle.pose));
    }
}

FclContinuous::~FclContinuous() = default;

std::optional<double> FclContinuous::first_contact(const cstk::Pose &from,
                                                   const cstk::Pose &to) const {
    const fcl::ContinuousCollisionRequest<double> request(
        max_iterations, time_error, fcl::CCDM_SCREW, fcl::GST_LIBCCD,
        fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    std::optional<double> first;
    for (const auto &[model, pose] : models_->obstacles) {
        const fcl::ScrewMotion<double> motion(fcl_pose(from), fcl_pose(to));
        const fcl::TranslationMotion<double> rest(pose, pose);
        fcl::ContinuousCollisionResult<double> result;
        fcl::continuousCollide<double>(models_->moving.get(), &motion, model.get(), &rest, request,
                                       result);
        if (result.is_collide && (!first || result.time_of_contact < *first)) {
            first = result.time_of_contact;
        }
    }
    return first;
}
