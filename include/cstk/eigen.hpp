/* Poses of Eigen and of cstk.hpp, which does not include this file: it needs Eigen 3.
 *
 * Eigen's vectors of doubles are taken as they are where a cstk::Span<double> is asked for, as configurations are.
 */
#ifndef CSTK_EIGEN_HPP
#define CSTK_EIGEN_HPP

#include <cstk.hpp>

#include <Eigen/Geometry>

#include <cstddef>

namespace cstk {

/// The rigid pose of a transform. Bodies are moved, never scaled: the library refuses a transform that is none.
template <int Mode, int Options> [[nodiscard]] Pose pose_from(const Eigen::Transform<double, 3, Mode, Options> &transform) {
    Pose pose;
    Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(pose.data()) = transform.matrix().template topRows<3>();
    return pose;
}

[[nodiscard]] inline Eigen::Isometry3d isometry_from(const Pose &pose) {
    Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
    isometry.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(pose.data());
    return isometry;
}

/// Three doubles of an answer, such as a point or a normal.
[[nodiscard]] inline Eigen::Map<const Eigen::Vector3d> vector_of(const double (&values)[3]) {
    return Eigen::Map<const Eigen::Vector3d>(values);
}

/// The gradients of a list, a row for each contact and a column for each velocity; it lasts as long as the list.
[[nodiscard]] inline Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
gradients_of(const cstk_witness_list &list) {
    const std::size_t rows = list.gradients == nullptr ? 0 : list.contact_count;
    return {list.gradients, static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(list.nv)};
}

} // namespace cstk

#endif
