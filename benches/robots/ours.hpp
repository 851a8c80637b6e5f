// A robot of a URDF file among obstacles, and our ways to answer.
#pragma once

#include "obstacles.hpp"
#include "way.hpp"

#include <cstk.hpp>

#include <string>
#include <vector>

class Ours {
  public:
    /// The folder being that of scripts/fetch_pinocchio.sh.
    Ours(const std::string &folder, const std::string &urdf);

    const cstk::Space &space() const { return space_; }

    /// What Pinocchio is to be asked about.
    Poses poses(const std::vector<std::vector<double>> &at) const;

    cstk::CObject itself(const std::vector<LinkPair> &pairs) const;
    cstk::CObject among(const Obstacles &obstacles, const std::vector<std::string> &links) const;

    /// The ways to answer about a C-object. The configurations must live as long as they do.
    static std::vector<Way> ways(const cstk::CObject &cobject, Query query,
                                 const std::vector<std::vector<double>> &at);

    /// Where the links are, and nothing else.
    Way kinematics(const std::vector<std::vector<double>> &at) const;

  private:
    explicit Ours(cstk::Robot robot) : robot_(std::move(robot)), space_(robot_) {}

    cstk::Robot robot_;
    cstk::Space space_;
};
