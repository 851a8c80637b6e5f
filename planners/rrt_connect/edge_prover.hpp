// Whether the motion between two configurations is free.
#pragma once

#include "tree.hpp"

#include <cstddef>

namespace rrt_connect {

/// "Free" is proved by cstk_motion. Most motions that a planner asks for are not free, and one sample inside says so sooner than a
/// proof fails: samples come first, and decide nothing but "not free".
class EdgeProver {
  public:
    /// The samples are at most `spacing` apart, as Space::distance measures.
    EdgeProver(const cstk::Query &query, const cstk::Space &space, const cstk::CObject &contact, double spacing);

    bool is_free(const Configuration &from, const Configuration &to);
    bool is_free(const Configuration &q) const;

    /// So many motions were asked.
    std::size_t checks() const { return checks_; }

  private:
    bool samples_are_free(const Configuration &from, const Configuration &to) const;

    cstk::Query query_;
    cstk::Space space_;
    cstk::CObject contact_;
    double spacing_;
    cstk_motion_options options_;
    std::size_t checks_ = 0;
};

} // namespace rrt_connect
