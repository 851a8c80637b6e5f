// A problem's workcell in FCL, for judging paths and as a peer. The links are placed by this library.
#pragma once

#include "problem.hpp"

#include <memory>
#include <string>

class Peer;

/// One of FCL's ways to tell whether anything meets, by its bounding volumes, its broad phase, and whether boxes are shapes or
/// meshes. To be used by one thread at a time.
class FclCell {
  public:
    FclCell(const problems::Workcell &workcell, const std::string &way);
    ~FclCell();

    /// Triangle by triangle, but for cylinders.
    static std::string exact_way() { return "OBB, pairs"; }
    /// The one that took least time for 1000 random configurations.
    static std::string fastest_way(const problems::Workcell &workcell);

    bool meets(cstk::Span<double> q) const;

  private:
    cstk::Space space_;
    std::unique_ptr<Peer> peer_;
};
