/* Part of cstk/fcl.hpp: how geometries move from one transform to another as time goes from 0 to 1. */
#ifndef CSTK_FCL_MOTIONS_HPP
#define CSTK_FCL_MOTIONS_HPP

#include <cstk/fcl/types.hpp>

#include <cmath>

namespace cstk_fcl {

namespace detail {

/// What libcstk can prove: that a geometry is shifted, turned about its origin while that goes straight, or moved on a screw.
enum class MotionKind { TRANSLATION, LINEAR, SCREW };

/// The turn by the part `t` of the rotation from `a` to `b`, after `a`.
template <typename S> Matrix3<S> turned(const Matrix3<S> &a, const Matrix3<S> &b, S t) {
    const AngleAxis<S> whole(Matrix3<S>(b * a.transpose()));
    return AngleAxis<S>(whole.angle() * t, whole.axis()).toRotationMatrix() * a;
}

/// The transform at time `t` on the screw from `a` to `b`.
template <typename S> Transform3<S> on_screw(const Transform3<S> &a, const Transform3<S> &b, S t) {
    const AngleAxis<S> whole(Matrix3<S>(b.linear() * a.linear().transpose()));
    const S angle = whole.angle();
    Transform3<S> out = a;
    if (angle < 64 * std::numeric_limits<S>::epsilon()) {
        out.translation() += t * (b.translation() - a.translation());
        return out;
    }
    /* The axis goes through the foot of the chord's middle. */
    const Vector3<S> axis = whole.axis();
    const Vector3<S> way = b.translation() - a.translation();
    const S along = axis.dot(way);
    const Vector3<S> chord = way - along * axis;
    const Vector3<S> foot = a.translation() + (chord + axis.cross(chord) / std::tan(angle / 2)) / 2;
    const Matrix3<S> turn = AngleAxis<S>(angle * t, axis).toRotationMatrix();
    out.linear() = turn * a.linear();
    out.translation() = foot + turn * (a.translation() - foot) + t * along * axis;
    return out;
}

} // namespace detail

/// A motion, and the transform at the time that integrate() was last given.
template <typename S> class MotionBase {
public:
    virtual ~MotionBase() = default;

    /// Times beyond 1 count as 1.
    bool integrate(S time) const {
        now_ = at(std::min(time, static_cast<S>(1)));
        return true;
    }

    void getCurrentTransform(Transform3<S> &tf) const { tf = now_; }
    void getCurrentTransform(Matrix3<S> &R, Vector3<S> &T) const {
        R = now_.linear();
        T = now_.translation();
    }
    void getCurrentTransform(Quaternion<S> &q, Vector3<S> &T) const {
        q = Quaternion<S>(now_.linear());
        T = now_.translation();
    }
    void getCurrentRotation(Matrix3<S> &R) const { R = now_.linear(); }
    void getCurrentRotation(Quaternion<S> &q) const { q = Quaternion<S>(now_.linear()); }
    void getCurrentTranslation(Vector3<S> &T) const { T = now_.translation(); }

    /// Not of FCL: the transform at a time, the ends, and which motion it is.
    virtual Transform3<S> at(S time) const = 0;
    const Transform3<S> &start() const { return start_; }
    const Transform3<S> &end() const { return end_; }
    detail::MotionKind kind() const { return kind_; }

protected:
    MotionBase(const Transform3<S> &start, const Transform3<S> &end, detail::MotionKind kind)
        : start_(start), end_(end), now_(start), kind_(kind) {}

private:
    Transform3<S> start_, end_;
    mutable Transform3<S> now_;
    detail::MotionKind kind_;

public:
    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

using MotionBasef = MotionBase<float>;
using MotionBased = MotionBase<double>;
template <typename S> using MotionBasePtr = std::shared_ptr<MotionBase<S>>;

/// A straight shift; the rotation stays that of the start.
template <typename S> class TranslationMotion : public MotionBase<S> {
public:
    TranslationMotion(const Transform3<S> &tf1, const Transform3<S> &tf2)
        : MotionBase<S>(tf1, with_rotation(tf1, tf2.translation()), detail::MotionKind::TRANSLATION) {}

    Transform3<S> at(S time) const override {
        return with_rotation(this->start(), this->start().translation() + time * getVelocity());
    }

    Vector3<S> getVelocity() const { return this->end().translation() - this->start().translation(); }

private:
    static Transform3<S> with_rotation(Transform3<S> tf, const Vector3<S> &translation) {
        tf.translation() = translation;
        return tf;
    }
};

using TranslationMotionf = TranslationMotion<float>;
using TranslationMotiond = TranslationMotion<double>;

/// The origin goes straight while the geometry turns about it at a constant rate, by the shortest rotation.
template <typename S> class InterpMotion : public MotionBase<S> {
public:
    InterpMotion(const Transform3<S> &tf1, const Transform3<S> &tf2) : MotionBase<S>(tf1, tf2, detail::MotionKind::LINEAR) {}
    InterpMotion(const Transform3<S> &tf1, const Transform3<S> &tf2, const Vector3<S> &reference) = delete; // move the frame there

    Transform3<S> at(S time) const override {
        Transform3<S> out = this->start();
        out.linear() = detail::turned(Matrix3<S>(this->start().linear()), Matrix3<S>(this->end().linear()), time);
        out.translation() += time * (this->end().translation() - this->start().translation());
        return out;
    }
};

using InterpMotionf = InterpMotion<float>;
using InterpMotiond = InterpMotion<double>;

/// A turn about an axis fixed in the world with a shift along it, by the shortest rotation.
template <typename S> class ScrewMotion : public MotionBase<S> {
public:
    ScrewMotion(const Transform3<S> &tf1, const Transform3<S> &tf2) : MotionBase<S>(tf1, tf2, detail::MotionKind::SCREW) {}

    Transform3<S> at(S time) const override { return detail::on_screw(this->start(), this->end(), time); }
};

using ScrewMotionf = ScrewMotion<float>;
using ScrewMotiond = ScrewMotion<double>;

} // namespace cstk_fcl

#endif
