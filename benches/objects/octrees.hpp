// Octrees whose cells change, and a body that moves about them.
#pragma once

#include "table.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>

// A ball's surface as occupied cells, as both libraries hold it, and a bumpy body that meets it in about half of its places.
class OctreeScene {
  public:
    // The number of cells is roughly kept.
    OctreeScene(std::size_t cells, std::size_t queries, std::uint64_t seed);
    ~OctreeScene();

    // 64 cells beside each other become occupied, and empty in the next query; alone, or with the question whether the body meets a
    // cell after it.
    Question change(bool with_question);
    // Whether the body meets a cell; the body moves before.
    Question meets();
    // How near the body is to the cells.
    Question nearest();

  private:
    struct Ours;
    struct Fcl;

    std::size_t cells_;
    std::unique_ptr<Ours> ours_;
    std::unique_ptr<Fcl> fcl_;
};
