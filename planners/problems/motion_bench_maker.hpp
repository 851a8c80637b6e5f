// MotionBenchMaker's problems for the Panda (Chamzas et al., "MotionBenchMaker: A tool to generate and benchmark motion
// planning datasets", 2022), as scripts/fetch_motion_bench_maker.sh leaves them.
#pragma once

#include "problem.hpp"

#include <string>
#include <vector>

namespace problems {

/// The robot, with the pairs of links that its SRDF does not rule out.
class Panda {
  public:
    explicit Panda(const std::string &folder);

    /// The first `count` problems of a scene: bookshelf_small, say.
    std::vector<Problem> problems(const std::string &scene, std::size_t count) const;

    /// The folder's scenes, in alphabetical order.
    std::vector<std::string> scenes() const;

  private:
    std::string folder_;
    cstk::Robot robot_;
    cstk::Space space_;
    std::vector<LinkPair> pairs_;
};

} // namespace problems
