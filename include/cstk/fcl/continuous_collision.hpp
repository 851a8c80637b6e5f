/* Part of cstk/fcl.hpp: continuousCollide. */
#ifndef CSTK_FCL_CONTINUOUS_COLLISION_HPP
#define CSTK_FCL_CONTINUOUS_COLLISION_HPP

#include <cstk/fcl/motion_proofs.hpp>
#include <cstk/fcl/queries.hpp>

#include <algorithm>

namespace cstk_fcl {

/// Which motion is meant by two transforms: TranslationMotion, InterpMotion or ScrewMotion.
enum CCDMotionType { CCDM_TRANS, CCDM_LINEAR, CCDM_SCREW };

/// Accepted and ignored: all are answered by one proof.
enum CCDSolverType { CCDC_NAIVE, CCDC_CONSERVATIVE_ADVANCEMENT, CCDC_RAY_SHOOTING, CCDC_POLYNOMIAL_SOLVER };

/// What CCDM_SPLINE is here; no request takes it.
struct splines_are_proved_by_cstk_motion_spline_of_cstk_h {};
constexpr splines_are_proved_by_cstk_motion_spline_of_cstk_h CCDM_SPLINE;

template <typename S> struct ContinuousCollisionRequest {
    /// Ignored: the proof ends when it is done.
    std::size_t num_max_iterations;
    /// How exactly the time of contact is found, as a part of the motion: raised to 1e-12 at least.
    S toc_err;
    CCDMotionType ccd_motion_type;
    GJKSolverType gjk_solver_type;
    CCDSolverType ccd_solver_type;

    ContinuousCollisionRequest(std::size_t num_max_iterations_ = 10, S toc_err_ = static_cast<S>(0.0001),
                               CCDMotionType ccd_motion_type_ = CCDM_TRANS, GJKSolverType gjk_solver_type_ = GST_LIBCCD,
                               CCDSolverType ccd_solver_type_ = CCDC_NAIVE)
        : num_max_iterations(num_max_iterations_), toc_err(toc_err_), ccd_motion_type(ccd_motion_type_),
          gjk_solver_type(gjk_solver_type_), ccd_solver_type(ccd_solver_type_) {}
};

using ContinuousCollisionRequestf = ContinuousCollisionRequest<float>;
using ContinuousCollisionRequestd = ContinuousCollisionRequest<double>;

template <typename S> struct ContinuousCollisionResult {
    /// False only for a motion that is proved free.
    bool is_collide = false;
    /// All before it is proved free, and the two meet at most toc_err later. 1 for a free motion.
    S time_of_contact = 1;
    /// Where they meet: up to toc_err after time_of_contact.
    Transform3<S> contact_tf1 = Transform3<S>::Identity();
    Transform3<S> contact_tf2 = Transform3<S>::Identity();

    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

using ContinuousCollisionResultf = ContinuousCollisionResult<float>;
using ContinuousCollisionResultd = ContinuousCollisionResult<double>;

/// A geometry on a motion.
template <typename S> class ContinuousCollisionObject {
public:
    ContinuousCollisionObject(const std::shared_ptr<CollisionGeometry<S>> &geometry, const std::shared_ptr<MotionBase<S>> &motion_)
        : cgeom(geometry), cgeom_const(geometry), motion(motion_) {
        cgeom->computeLocalAABB();
    }

    OBJECT_TYPE getObjectType() const { return cgeom->getObjectType(); }
    NODE_TYPE getNodeType() const { return cgeom->getNodeType(); }
    void *getUserData() const { return user_data; }
    void setUserData(void *data) { user_data = data; }
    MotionBase<S> *getMotion() const { return motion.get(); }
    const CollisionGeometry<S> *getCollisionGeometry() const { return cgeom.get(); }
    const std::shared_ptr<const CollisionGeometry<S>> &collisionGeometry() const { return cgeom_const; }

    const AABB<S> &getAABB() const = delete; // managers of moving objects are not covered: ask continuousCollide of each pair
    void computeAABB() = delete; // managers of moving objects are not covered: ask continuousCollide of each pair

protected:
    std::shared_ptr<CollisionGeometry<S>> cgeom;
    std::shared_ptr<const CollisionGeometry<S>> cgeom_const;
    std::shared_ptr<MotionBase<S>> motion;
    void *user_data = nullptr;
};

using ContinuousCollisionObjectf = ContinuousCollisionObject<float>;
using ContinuousCollisionObjectd = ContinuousCollisionObject<double>;

/// Proves that two geometries do not meet on their motions, or finds the first contact. Returns the time of contact.
template <typename S>
S continuousCollide(const CollisionGeometry<S> *o1, const MotionBase<S> *motion1, const CollisionGeometry<S> *o2,
                    const MotionBase<S> *motion2, const ContinuousCollisionRequest<S> &request,
                    ContinuousCollisionResult<S> &result) {
    cstk_motion_options options = cstk::motion_options();
    options.tolerance = std::min(std::max(static_cast<double>(request.toc_err), 1e-12), 1.0);
    if (o1->is_empty() || o2->is_empty()) {
        result.is_collide = false;
        result.time_of_contact = 1;
        result.contact_tf1 = motion1->at(1);
        result.contact_tf2 = motion2->at(1);
        return 1;
    }
    const cstk_motion_result found = detail::prove<S>({o1, motion1}, {o2, motion2}, options);
    result.is_collide = found.outcome != CSTK_MOTION_FREE;
    result.time_of_contact = detail::rounded_down<S>(found.times[0]);
    const S contact = detail::rounded_up<S>(found.times[1]);
    result.contact_tf1 = motion1->at(contact);
    result.contact_tf2 = motion2->at(contact);
    return result.time_of_contact;
}

template <typename S>
S continuousCollide(const CollisionGeometry<S> *o1, const Transform3<S> &tf1_beg, const Transform3<S> &tf1_end,
                    const CollisionGeometry<S> *o2, const Transform3<S> &tf2_beg, const Transform3<S> &tf2_end,
                    const ContinuousCollisionRequest<S> &request, ContinuousCollisionResult<S> &result) {
    const auto answer = [&](const auto &motion1, const auto &motion2) {
        const MotionBase<S> *const m1 = &motion1;
        const MotionBase<S> *const m2 = &motion2;
        return continuousCollide(o1, m1, o2, m2, request, result);
    };
    switch (request.ccd_motion_type) {
    case CCDM_TRANS:
        return answer(TranslationMotion<S>(tf1_beg, tf1_end), TranslationMotion<S>(tf2_beg, tf2_end));
    case CCDM_LINEAR:
        return answer(InterpMotion<S>(tf1_beg, tf1_end), InterpMotion<S>(tf2_beg, tf2_end));
    default:
        return answer(ScrewMotion<S>(tf1_beg, tf1_end), ScrewMotion<S>(tf2_beg, tf2_end));
    }
}

template <typename S>
S continuousCollide(const CollisionObject<S> *o1, const Transform3<S> &tf1_end, const CollisionObject<S> *o2,
                    const Transform3<S> &tf2_end, const ContinuousCollisionRequest<S> &request,
                    ContinuousCollisionResult<S> &result) {
    return continuousCollide(o1->collisionGeometry().get(), o1->getTransform(), tf1_end, o2->collisionGeometry().get(),
                             o2->getTransform(), tf2_end, request, result);
}

template <typename S>
S collide(const ContinuousCollisionObject<S> *o1, const ContinuousCollisionObject<S> *o2,
          const ContinuousCollisionRequest<S> &request, ContinuousCollisionResult<S> &result) {
    const MotionBase<S> *const m1 = o1->getMotion();
    const MotionBase<S> *const m2 = o2->getMotion();
    return continuousCollide(o1->collisionGeometry().get(), m1, o2->collisionGeometry().get(), m2, request, result);
}

} // namespace cstk_fcl

#endif
