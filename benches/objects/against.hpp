// Objects against objects, without a robot: boxes that move, among themselves and in two sets.
#pragma once

#include "asked.hpp"
#include "table.hpp"

#include <cstk.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

// Boxes, and where they stand in each query.
struct Boxes {
    std::vector<std::array<double, 3>> half_extents;
    std::vector<std::vector<cstk::Pose>> poses;
};

// Boxes at random that meet here and there; or in a grid, in which none meet.
Boxes meeting_boxes(std::size_t count, std::size_t queries, std::uint64_t seed);
Boxes boxes_apart(std::size_t count, std::size_t queries, std::uint64_t seed);

// Both libraries' way to ask about the same boxes. The second half of the boxes is the second set where there are two.
class Against {
  public:
    Against(Boxes boxes, bool two_sets);
    ~Against();

    // Which pairs meet; with the moves of all boxes before, or without.
    Question meeting(bool with_moves);
    // How near the nearest two are.
    Question nearest(bool with_moves);

  private:
    struct Ours;
    struct Fcl;

    Boxes boxes_;
    std::unique_ptr<Ours> ours_;
    std::unique_ptr<Fcl> fcl_;
};
