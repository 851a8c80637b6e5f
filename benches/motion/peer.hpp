// The same bodies in other libraries.
#pragma once

#include "surface.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A scene as triangles: what peers are built from.
struct PeerScene {
    struct Cylinder {
        double radius, half_length;
    };

    struct Obstacle {
        Surface surface;
        cstk::Pose pose;
        /// Of a box about the origin of its frame.
        std::optional<std::array<double, 3>> half_extents;
        /// Of a cylinder about its z axis: always taken as a shape, and without a surface.
        std::optional<Cylinder> cylinder = {};
    };

    /// Of each link, empty where it has no body.
    std::vector<Surface> links;
    std::vector<Obstacle> obstacles;
    /// The links that are asked against the obstacles.
    std::vector<std::uint32_t> moving;
    std::vector<std::array<std::uint32_t, 2>> pairs;
};

/// One way of a library to tell whether anything meets.
class Peer {
  public:
    virtual ~Peer() = default;
    virtual bool meets(const std::vector<cstk::Pose> &links) = 0;
};

struct PeerWay {
    std::string name;
    std::unique_ptr<Peer> peer;
};

/// All, or the one of a name.
std::vector<PeerWay> fcl_ways(const PeerScene &scene, const std::string &only = {});

/// None where Coal is not there.
std::vector<PeerWay> coal_ways(const PeerScene &scene);

/// FCL's continuousCollide of one body that moves freely: conservative advancement along the screw between two poses.
class FclContinuous {
  public:
    explicit FclContinuous(const PeerScene &scene);
    ~FclContinuous();

    /// When the first obstacle is met, as a part of the motion; none for a motion that is called free.
    std::optional<double> first_contact(const cstk::Pose &from, const cstk::Pose &to) const;

  private:
    struct Models;
    std::unique_ptr<Models> models_;
};
