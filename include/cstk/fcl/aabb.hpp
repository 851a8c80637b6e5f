/* Part of cstk/fcl.hpp: axis-aligned boxes. */
#ifndef CSTK_FCL_AABB_HPP
#define CSTK_FCL_AABB_HPP

#include <cstk/fcl/types.hpp>

namespace cstk_fcl {

/// An axis-aligned box; empty when default-constructed.
template <typename S_> class AABB {
public:
    using S = S_;

    Vector3<S> min_ = Vector3<S>::Constant(std::numeric_limits<S>::max());
    Vector3<S> max_ = Vector3<S>::Constant(-std::numeric_limits<S>::max());

    AABB() = default;
    AABB(const Vector3<S> &point) : min_(point), max_(point) {}
    AABB(const Vector3<S> &a, const Vector3<S> &b) : min_(a.cwiseMin(b)), max_(a.cwiseMax(b)) {}
    AABB(const AABB &core, const Vector3<S> &delta) : min_(core.min_ - delta), max_(core.max_ + delta) {}
    AABB(const Vector3<S> &a, const Vector3<S> &b, const Vector3<S> &c)
        : min_(a.cwiseMin(b).cwiseMin(c)), max_(a.cwiseMax(b).cwiseMax(c)) {}

    bool overlap(const AABB &other) const {
        return (min_.array() <= other.max_.array()).all() && (other.min_.array() <= max_.array()).all();
    }

    bool overlap(const AABB &other, AABB &overlap_part) const {
        if (!overlap(other)) {
            return false;
        }
        overlap_part.min_ = min_.cwiseMax(other.min_);
        overlap_part.max_ = max_.cwiseMin(other.max_);
        return true;
    }

    bool axisOverlap(const AABB &other, int axis) const {
        return min_[axis] <= other.max_[axis] && other.min_[axis] <= max_[axis];
    }

    bool contain(const AABB &other) const {
        return (min_.array() <= other.min_.array()).all() && (other.max_.array() <= max_.array()).all();
    }

    bool contain(const Vector3<S> &point) const { return contain(AABB(point)); }

    AABB &operator+=(const Vector3<S> &point) { return *this += AABB(point); }

    AABB &operator+=(const AABB &other) {
        min_ = min_.cwiseMin(other.min_).eval();
        max_ = max_.cwiseMax(other.max_).eval();
        return *this;
    }

    AABB operator+(const AABB &other) const { return AABB(*this) += other; }

    S width() const { return max_[0] - min_[0]; }
    S height() const { return max_[1] - min_[1]; }
    S depth() const { return max_[2] - min_[2]; }
    S volume() const { return width() * height() * depth(); }
    /// The square of the diagonal.
    S size() const { return (max_ - min_).squaredNorm(); }
    S radius() const { return (max_ - min_).norm() / 2; }
    Vector3<S> center() const { return min_ + (max_ - min_) / 2; }

    S distance(const AABB &other) const { return gap(other).norm(); }

    /// `p` and `q`, if given, receive the nearest points of this box and of the other.
    S distance(const AABB &other, Vector3<S> *p, Vector3<S> *q) const {
        if (p != nullptr && q != nullptr) {
            for (int axis = 0; axis < 3; ++axis) {
                const S low = std::max(min_[axis], other.min_[axis]);
                const S high = std::min(max_[axis], other.max_[axis]);
                const bool apart = low > high;
                const bool above = other.min_[axis] > max_[axis];
                (*p)[axis] = !apart ? (low + high) / 2 : above ? max_[axis] : min_[axis];
                (*q)[axis] = !apart ? (low + high) / 2 : above ? other.min_[axis] : other.max_[axis];
            }
        }
        return distance(other);
    }

    bool equal(const AABB &other) const { return min_ == other.min_ && max_ == other.max_; }

    AABB &expand(const Vector3<S> &delta) {
        min_ -= delta;
        max_ += delta;
        return *this;
    }

    AABB &expand(const AABB &core, S ratio) {
        min_ = min_ * ratio - core.min_;
        max_ = max_ * ratio - core.max_;
        return *this;
    }

private:
    Vector3<S> gap(const AABB &other) const {
        return (other.min_ - max_).cwiseMax(min_ - other.max_).cwiseMax(Vector3<S>::Zero());
    }
};

using AABBf = AABB<float>;
using AABBd = AABB<double>;

template <typename S, typename Derived> AABB<S> translate(const AABB<S> &box, const Eigen::MatrixBase<Derived> &by) {
    AABB<S> moved = box;
    moved.min_ += by;
    moved.max_ += by;
    return moved;
}

} // namespace cstk_fcl

#endif
