// A robot among obstacles as Pinocchio holds it, with meshes of one kind of bounding volume.
#pragma once

#include "way.hpp"

#include <pinocchio/algorithm/geometry.hpp>
#include <pinocchio/multibody.hpp>

#include <coal/fwd.hh>

#include <memory>
#include <string>
#include <vector>

/// Coal starts GJK where it ended the last time, or always anew.
enum class Guess { cached, fresh };

struct PeerScene {
    PeerScene(const pinocchio::Model &model, const pinocchio::GeometryModel &geometry);

    /// As few steps of the narrow phase as will do for what is asked.
    void set(Guess guess);
    /// Kinematics, and where the shapes stand.
    void place(std::size_t pose) {
        pinocchio::updateGeometryPlacements(model, data, geometry, placed, (*poses)[pose]);
    }

    pinocchio::Model model;
    pinocchio::Data data;
    pinocchio::GeometryModel geometry;
    pinocchio::GeometryData placed;
    std::shared_ptr<const std::vector<Eigen::VectorXd>> poses;
};

using ScenePtr = std::shared_ptr<PeerScene>;

/// Makes a scene of its own for a way.
using MakeScene = std::function<ScenePtr(Guess)>;

/// The box of a shape in the world, by its corners' extent along the axes.
struct PlacedBox {
    PlacedBox(const pinocchio::SE3 &at, const coal::AABB &local)
        : center(at.act(local.center())),
          half(at.rotation().cwiseAbs() * (0.5 * (local.max_ - local.min_))) {}

    /// The length between two boxes, 0 where they meet.
    static double gap(const PlacedBox &a, const PlacedBox &b) {
        return ((a.center - b.center).cwiseAbs() - a.half - b.half).cwiseMax(0).norm();
    }

    Eigen::Vector3d center, half;
};

/// The boxes of all shapes of a placed scene.
void place_boxes(const PeerScene &scene, std::vector<PlacedBox> &boxes);

void add_collide_ways(const std::string &volumes, const MakeScene &make, std::vector<Way> &ways);
void add_distance_ways(const std::string &volumes, const MakeScene &make, std::vector<Way> &ways);
