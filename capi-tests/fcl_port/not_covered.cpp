// Calls that cstk/fcl.hpp refuses at compile time. not_covered.cmake compiles this file and looks for the hint of each:
//
// HINT: splines_are_proved_by_cstk_motion_spline
// HINT: cstk_fcl has no SplineMotion
// HINT: use DynamicAABBTreeCollisionManager
// HINT: cstk_fcl has no manager of moving objects
// HINT: use of deleted function[^\n]*computeVolume
// HINT: use of deleted function[^\n]*beginUpdateModel
// HINT: use of deleted function[^\n]*generateBVHModel
// HINT: use of deleted function[^\n]*InterpMotion
// HINT: use of deleted function[^\n]*getRoot
#include <cstk/fcl.hpp>

namespace fcl = cstk_fcl;

int main() {
    const fcl::Transform3d tf = fcl::Transform3d::Identity();
    fcl::ContinuousCollisionRequestd request;
    request.ccd_motion_type = fcl::CCDM_SPLINE;
    fcl::SplineMotion<double> spline;
    fcl::SpatialHashingCollisionManager<double> hashing;
    fcl::BroadPhaseContinuousCollisionManager<double> moving;
    fcl::BVHModel<fcl::OBBRSSd> model;
    model.beginUpdateModel();
    fcl::generateBVHModel(model, fcl::Sphered(1), tf, 16, 16);
    fcl::InterpMotiond about(tf, tf, fcl::Vector3d(1, 0, 0));
    fcl::OcTreed(0.1).getRoot();
    return fcl::Boxd(1, 1, 1).computeVolume() > 0;
}
