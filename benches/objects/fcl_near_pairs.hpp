// All pairs of triangles of two meshes within a distance: FCL's traversal for distances, made to go
// on.
#pragma once

#include "fcl_placed.hpp"

#include <vector>

struct NearPair {
    int first, second;
    // In the first mesh's frame.
    Vector points[2];
};

class NearPairs final : public fcl::detail::MeshDistanceTraversalNodeRSS<double> {
  public:
    NearPairs(const Placed &one, const Placed &other, double epsilon, std::vector<NearPair> &found)
        : epsilon_(epsilon), found_(found) {
        using Node = fcl::detail::MeshDistanceTraversalNodeRSS<double>;
        fcl::detail::initialize(static_cast<Node &>(*this), mesh(one), one.getTransform(),
                                mesh(other), other.getTransform(), nothing_, unused_);
        fcl::detail::distance(static_cast<fcl::detail::DistanceTraversalNodeBase<double> *>(this),
                              static_cast<fcl::detail::BVHFrontList *>(nullptr), 2);
    }

    void preprocess() override {}
    void postprocess() override {}
    bool canStop(double lower) const override { return lower > epsilon_; }
    void leafTesting(int first, int second) const override {
        const int one = model1->getBV(first).primitiveId(),
                  other = model2->getBV(second).primitiveId();
        const fcl::Triangle &a = tri_indices1[one], &b = tri_indices2[other];
        NearPair pair{one, other, {}};
        const double apart = fcl::detail::TriangleDistance<double>::triDistance(
            vertices1[a[0]], vertices1[a[1]], vertices1[a[2]], vertices2[b[0]], vertices2[b[1]],
            vertices2[b[2]], tf, pair.points[0], pair.points[1]);
        if (apart <= epsilon_) {
            found_.push_back(pair);
        }
    }

  private:
    using Model = fcl::BVHModel<fcl::RSS<double>>;

    static const Model &mesh(const Placed &placed) {
        return static_cast<const Model &>(*placed.collisionGeometry());
    }

    double epsilon_;
    std::vector<NearPair> &found_;
    fcl::DistanceRequest<double> nothing_;
    fcl::DistanceResult<double> unused_;
};
