// How far links move on a motion.
#pragma once

#include "scene.hpp"

#include <cstdint>
#include <optional>
#include <vector>

/// Bounds by summed lever arms, as Schwarzer, Saha and Latombe use them: a joint moves the points of a link by at most its rate times
/// the length of the chain from it to the link, plus the link's radius.
class LeverArms {
  public:
    explicit LeverArms(const cstk::Robot &robot);

    /// How far any point of a link moves on the way from q0 with velocity v for a unit of time; with another link, as seen from that.
    double bound(std::uint32_t link, std::optional<std::uint32_t> other, const Numbers &q0,
                 const Numbers &v) const;

  private:
    struct Joint {
        std::int32_t parent;
        cstk_joint_kind kind;
        std::size_t coordinate, velocity;
        double multiplier, offset;
        /// From the origin of the parent link to that of the joint.
        double arm;
        /// Of the link's body about the link's origin.
        double radius;
    };

    double up_to(std::int32_t link, std::int32_t end, const Numbers &q0, const Numbers &v) const;
    std::int32_t common_ancestor(std::int32_t a, std::int32_t b) const;

    std::vector<Joint> joints_;
};

/// How far the fastest point of the moving links would go at its highest speed: the largest chord of the corners of the links' boxes
/// between two of 64 equal parts of the motion, times 64. A step of the motion's 1 / n part moves no point by more than an nth of it,
/// but for the bend within a part, some 0.1 %.
double highest_speed(const Scene &scene, const Ends &ends);
