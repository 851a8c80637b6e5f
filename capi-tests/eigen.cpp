// Poses, configurations and gradients of Eigen (cstk/eigen.hpp).
#include <cstk/eigen.hpp>

#include <cstdio>
#include <cstdlib>
#include <vector>

static void require(bool condition, const char *what) {
    if (!condition) {
        std::fprintf(stderr, "failed: %s\n", what);
        std::exit(1);
    }
}

#define REQUIRE(condition) require(condition, #condition)

int main() {
    Eigen::Isometry3d turned = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized());
    const cstk::Pose pose = cstk::pose_from(turned);
    const Eigen::Vector3d point(0.25, -0.5, 4);
    const std::array<double, 3> moved = cstk::transform_point(pose, {point.x(), point.y(), point.z()});
    REQUIRE((turned * point - Eigen::Map<const Eigen::Vector3d>(moved.data())).norm() < 1e-14);
    REQUIRE(cstk::isometry_from(pose).isApprox(turned, 0));
    REQUIRE(cstk::pose_from(Eigen::Affine3d(turned)) == pose);

    // A transform that scales is no pose.
    const cstk::Body box = cstk::Body::box({0.5, 0.5, 0.5});
    cstk::Query query;
    try {
        static_cast<void>(query.pair_within(box, cstk::pose_from(Eigen::Affine3d(Eigen::Scaling(2.0))), box, pose, 0));
        REQUIRE(!"a scaled pose is refused");
    } catch (const cstk::Error &error) {
        REQUIRE(error.status() == CSTK_ERROR_NOT_A_ROTATION);
    }

    // A box that slides along x before another.
    cstk::RobotBuilder builder;
    cstk::Link slider;
    slider.body = box;
    slider.joint = CSTK_JOINT_PRISMATIC;
    slider.axis = {1, 0, 0};
    builder.add_link(slider);
    cstk::Environment world;
    world.add(box, cstk::pose_from(Eigen::Isometry3d(Eigen::Translation3d(3, 0, 0))));
    const cstk::CObject contact = cstk::CObject::induced(cstk::Space(builder.build()), world);
    // What skips numbers is no span; what does not is one.
    using cstk::detail::IsContiguous;
    static_assert(IsContiguous<Eigen::VectorXd>::value && IsContiguous<Eigen::MatrixXd>::value);
    static_assert(IsContiguous<Eigen::Map<const Eigen::VectorXd>>::value);
    static_assert(IsContiguous<Eigen::MatrixXd::ColXpr>::value && !IsContiguous<Eigen::MatrixXd::RowXpr>::value);
    static_assert(!IsContiguous<Eigen::Block<Eigen::MatrixXd>>::value);
    using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    static_assert(IsContiguous<ByRows::RowXpr>::value && !IsContiguous<ByRows::ColXpr>::value);
    static_assert(IsContiguous<std::vector<double>>::value);
    ByRows table(2, 3);
    table << 1, 2, 3, 4, 5, 6;
    const cstk::Span<double> second = table.row(1);
    REQUIRE(second.size() == 3 && second[0] == 4 && second[2] == 6);

    Eigen::VectorXd q(1);
    q << 0.5;
    REQUIRE(query.classify(contact, q) == CSTK_CLASS_OUTSIDE);
    const cstk_witness_list list = query.gradients(contact, q, 2);
    REQUIRE(cstk::gradients_of(list).rows() == 4 && (cstk::gradients_of(list).col(0).array() == -1).all());
    REQUIRE(cstk::vector_of(list.contacts[0].normal) == Eigen::Vector3d(-1, 0, 0));
    REQUIRE(cstk::gradients_of(query.witnesses(contact, q, 2)).rows() == 0);
    return 0;
}
