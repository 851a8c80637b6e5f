/* Part of cstk/fcl.hpp: generateBVHModel. */
#ifndef CSTK_FCL_MODEL_OF_SHAPE_HPP
#define CSTK_FCL_MODEL_OF_SHAPE_HPP

#include <cstk/fcl/bvh_model.hpp>
#include <cstk/fcl/shapes.hpp>

namespace cstk_fcl {

enum class FinalizeModel { DO, DONT };

/// Adds the twelve triangles of a box, facing outwards. With FinalizeModel::DO the model is begun, if it is not, and ended.
template <typename BV>
int generateBVHModel(BVHModel<BV> &model, const Box<typename BV::S> &box, const Transform3<typename BV::S> &pose,
                     FinalizeModel finalize = FinalizeModel::DO) {
    using S = typename BV::S;
    std::vector<Vector3<S>> corners;
    for (int i = 0; i < 8; ++i) {
        const Vector3<S> sign(i % 2 == 0 ? -1 : 1, i / 2 % 2 == 0 ? -1 : 1, i / 4 == 0 ? -1 : 1);
        corners.push_back(pose * Vector3<S>(sign.cwiseProduct(box.side) / 2));
    }
    std::vector<Triangle> triangles;
    for (const std::array<std::size_t, 4> &face : {std::array<std::size_t, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        triangles.emplace_back(face[0], face[1], face[2]);
        triangles.emplace_back(face[0], face[2], face[3]);
    }
    if (model.build_state != BVH_BUILD_STATE_BEGUN) {
        model.beginModel();
    }
    const int added = model.addSubModel(corners, triangles);
    if (added != BVH_OK || finalize == FinalizeModel::DONT) {
        return added;
    }
    const int ended = model.endModel();
    model.computeLocalAABB();
    return ended;
}

/* Round shapes are not cut into triangles. */
template <typename BV, typename... More> int generateBVHModel(BVHModel<BV> &, const Sphere<typename BV::S> &, More...) = delete; // use the shape itself, which is exact
template <typename BV, typename... More> int generateBVHModel(BVHModel<BV> &, const Ellipsoid<typename BV::S> &, More...) = delete; // use the shape itself, which is exact
template <typename BV, typename... More> int generateBVHModel(BVHModel<BV> &, const Cylinder<typename BV::S> &, More...) = delete; // use the shape itself, which is exact
template <typename BV, typename... More> int generateBVHModel(BVHModel<BV> &, const Cone<typename BV::S> &, More...) = delete; // use the shape itself, which is exact

} // namespace cstk_fcl

#endif
