// Whether the motion between two configurations is free.
#pragma once

#include "tree.hpp"

#include <cstddef>

namespace rrt_connect {

/// "Free" is proved by cstk_motion.
class EdgeProver {
  public:
    EdgeProver(cstk::Query &query, const cstk::CObject &contact);

    bool is_free(const Configuration &from, const Configuration &to);
    bool is_free(const Configuration &q) const;

    /// So many motions were asked.
    std::size_t checks() const { return checks_; }

  private:
    cstk::Query &query_;
    cstk::CObject contact_;
    cstk_motion_options options_;
    std::size_t checks_ = 0;
};

} // namespace rrt_connect
