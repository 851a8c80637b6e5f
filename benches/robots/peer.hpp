// The same robot among the same obstacles, by Pinocchio with Coal. Pinocchio's headers stay out of
// here: they take long to compile.
#pragma once

#include "obstacles.hpp"
#include "way.hpp"

#include <memory>
#include <string>
#include <vector>

/// What is tested: pairs of links, and moving links against obstacles where there are any.
struct Tested {
    std::vector<LinkPair> pairs;
    Obstacles obstacles;
};

class Peer {
  public:
    Peer(const std::string &folder, const std::string &urdf);
    ~Peer();

    /// Links with shapes that a joint moves.
    std::vector<std::string> moving_links() const;
    /// Pairs of links with shapes, but those joined or fixed to each other, and those that meet at
    /// 95 % of the poses or more.
    std::vector<LinkPair> link_pairs(const Poses &poses) const;

    /// All ways, the plainest first: its answers are what the others are held against.
    std::vector<Way> ways(const Tested &tested, Query query, const Poses &poses) const;

    /// Where the links and their shapes are, and nothing else.
    Way kinematics(const Poses &poses) const;

  private:
    struct Robots;
    std::unique_ptr<Robots> robots_;
};
