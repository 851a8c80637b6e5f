/* Part of cstk/fcl.hpp: the bounded shapes. All are solid and centred at the origin; lengths are whole ones along z. */
#ifndef CSTK_FCL_SHAPES_HPP
#define CSTK_FCL_SHAPES_HPP

#include <cstk/fcl/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cstk_fcl {

/// A box, given by the lengths of its sides. A side may be 0.
template <typename S_> class Box : public ShapeBase<S_> {
public:
    using S = S_;

    Box(S x, S y, S z) : side(x, y, z) {}
    Box(const Vector3<S> &side_) : side(side_) {}
    Box() = default;

    Vector3<S> side = Vector3<S>::Zero();

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_BOX; }

    const cstk::Body &body() const override {
        const std::array<double, 3> half = half_sides();
        return body_.of(half, [&half](cstk::BodyBuilder &builder) {
            /* The library refuses sides below 0; a flat box is a hull. */
            if (*std::min_element(half.begin(), half.end()) != 0) {
                builder.add_box(cstk::identity(), half);
                return;
            }
            std::array<double, 24> corners;
            for (std::size_t i = 0; i < 24; ++i) {
                corners[i] = (i / 3 >> i % 3) % 2 == 0 ? -half[i % 3] : half[i % 3];
            }
            builder.add_polyhedron(corners);
        });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        const std::array<double, 3> half = half_sides();
        return {std::copysign(half[0], direction[0]), std::copysign(half[1], direction[1]), std::copysign(half[2], direction[2])};
    }

private:
    std::array<double, 3> half_sides() const { return {side[0] / 2.0, side[1] / 2.0, side[2] / 2.0}; }

    detail::ShapeBody<3> body_;
};

using Boxf = Box<float>;
using Boxd = Box<double>;

template <typename S_> class Sphere : public ShapeBase<S_> {
public:
    using S = S_;

    Sphere(S radius_) : radius(radius_) {}

    S radius;

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_SPHERE; }

    const cstk::Body &body() const override {
        return body_.of({static_cast<double>(radius)},
                        [this](cstk::BodyBuilder &builder) { builder.add_sphere({0, 0, 0}, radius); });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        return detail::on_ball(direction, radius);
    }

private:
    detail::ShapeBody<1> body_;
};

using Spheref = Sphere<float>;
using Sphered = Sphere<double>;

/// An ellipsoid, given by its half axes. With equal ones it is a ball, whose answers are exact.
template <typename S_> class Ellipsoid : public ShapeBase<S_> {
public:
    using S = S_;

    Ellipsoid(S a, S b, S c) : radii(a, b, c) {}
    Ellipsoid(const Vector3<S> &radii_) : radii(radii_) {}

    Vector3<S> radii;

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_ELLIPSOID; }
    bool is_polyhedral() const override { return is_ball(); }

    const cstk::Body &body() const override {
        const std::array<double, 3> axes = {static_cast<double>(radii[0]), static_cast<double>(radii[1]),
                                            static_cast<double>(radii[2])};
        return body_.of(axes, [this, &axes](cstk::BodyBuilder &builder) {
            if (is_ball()) {
                builder.add_sphere({0, 0, 0}, axes[0]);
            } else {
                builder.add_ellipsoid(cstk::identity(), axes);
            }
        });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        const Eigen::Vector3d axes = radii.template cast<double>();
        return axes.cwiseProduct(detail::on_ball(axes.cwiseProduct(direction), 1));
    }

private:
    bool is_ball() const { return radii[0] == radii[1] && radii[1] == radii[2]; }

    detail::ShapeBody<3> body_;
};

using Ellipsoidf = Ellipsoid<float>;
using Ellipsoidd = Ellipsoid<double>;

/// All points within `radius` of a segment of length `lz` along z.
template <typename S_> class Capsule : public ShapeBase<S_> {
public:
    using S = S_;

    Capsule(S radius_, S lz_) : radius(radius_), lz(lz_) {}

    S radius;
    S lz;

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_CAPSULE; }

    const cstk::Body &body() const override {
        return body_.of({static_cast<double>(radius), static_cast<double>(lz)}, [this](cstk::BodyBuilder &builder) {
            if (lz < 0) {
                throw std::invalid_argument("cstk_fcl: a Capsule has a negative length");
            }
            builder.add_capsule({0, 0, -lz / 2.0}, {0, 0, lz / 2.0}, radius);
        });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        return detail::on_ball(direction, radius) + Eigen::Vector3d(0, 0, std::copysign(lz / 2.0, direction.z()));
    }

private:
    detail::ShapeBody<2> body_;
};

using Capsulef = Capsule<float>;
using Capsuled = Capsule<double>;

/// A cylinder of length `lz` around z.
template <typename S_> class Cylinder : public ShapeBase<S_> {
public:
    using S = S_;

    Cylinder(S radius_, S lz_) : radius(radius_), lz(lz_) {}

    S radius;
    S lz;

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_CYLINDER; }
    bool is_polyhedral() const override { return false; }

    const cstk::Body &body() const override {
        return body_.of({static_cast<double>(radius), static_cast<double>(lz)}, [this](cstk::BodyBuilder &builder) {
            builder.add_cylinder(cstk::identity(), radius, lz / 2.0);
        });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        return detail::on_circle(direction, radius) + Eigen::Vector3d(0, 0, std::copysign(lz / 2.0, direction.z()));
    }

private:
    detail::ShapeBody<2> body_;
};

using Cylinderf = Cylinder<float>;
using Cylinderd = Cylinder<double>;

/// A cone around z: its base at -lz / 2, its apex at lz / 2.
template <typename S_> class Cone : public ShapeBase<S_> {
public:
    using S = S_;

    Cone(S radius_, S lz_) : radius(radius_), lz(lz_) {}

    S radius;
    S lz;

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_CONE; }
    bool is_polyhedral() const override { return false; }

    const cstk::Body &body() const override {
        return body_.of({static_cast<double>(radius), static_cast<double>(lz)}, [this](cstk::BodyBuilder &builder) {
            builder.add_cone(cstk::identity(), radius, lz);
        });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        const Eigen::Vector3d apex(0, 0, lz / 2.0);
        const Eigen::Vector3d rim = detail::on_circle(direction, radius) - apex;
        return direction.dot(apex) >= direction.dot(rim) ? apex : rim;
    }

private:
    detail::ShapeBody<2> body_;
};

using Conef = Cone<float>;
using Coned = Cone<double>;

/// The convex hull of vertices. Faces are kept for getFaces(); the library finds its own, so that wrong ones do no harm.
template <typename S_> class Convex : public ShapeBase<S_> {
public:
    using S = S_;

    Convex(const std::shared_ptr<const std::vector<Vector3<S>>> &vertices, int num_faces,
           const std::shared_ptr<const std::vector<int>> &faces, bool /* throw_if_invalid */ = false)
        : vertices_(vertices), num_faces_(num_faces), faces_(faces) {
        if (vertices_ == nullptr) {
            throw std::invalid_argument("cstk_fcl: a Convex is made of no vertices");
        }
        for (const Vector3<S> &vertex : *vertices_) {
            interior_point_ += vertex / static_cast<S>(vertices_->size());
        }
    }

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_CONVEX; }

    const std::vector<Vector3<S>> &getVertices() const { return *vertices_; }
    int getFaceCount() const { return num_faces_; }
    const std::vector<int> &getFaces() const { return *faces_; }
    const Vector3<S> &getInteriorPoint() const { return interior_point_; }

    const Vector3<S> &findExtremeVertex(const Vector3<S> &direction) const {
        const Vector3<S> *farthest = &first_vertex();
        for (const Vector3<S> &vertex : *vertices_) {
            farthest = direction.dot(vertex) > direction.dot(*farthest) ? &vertex : farthest;
        }
        return *farthest;
    }

    const cstk::Body &body() const override {
        return body_.of({}, [this](cstk::BodyBuilder &builder) {
            std::vector<double> xyz;
            for (const Vector3<S> &vertex : *vertices_) {
                xyz.insert(xyz.end(), vertex.data(), vertex.data() + 3);
            }
            builder.add_polyhedron(xyz);
        });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        Eigen::Vector3d farthest = first_vertex().template cast<double>();
        for (const Vector3<S> &vertex : *vertices_) {
            const Eigen::Vector3d other = vertex.template cast<double>();
            farthest = direction.dot(other) > direction.dot(farthest) ? other : farthest;
        }
        return farthest;
    }

private:
    const Vector3<S> &first_vertex() const {
        if (vertices_->empty()) {
            throw std::invalid_argument("cstk_fcl: a Convex is made of no vertices");
        }
        return vertices_->front();
    }

    std::shared_ptr<const std::vector<Vector3<S>>> vertices_;
    int num_faces_;
    std::shared_ptr<const std::vector<int>> faces_;
    Vector3<S> interior_point_ = Vector3<S>::Zero();
    detail::ShapeBody<0> body_;
};

using Convexf = Convex<float>;
using Convexd = Convex<double>;

/// One triangle, a surface.
template <typename S_> class TriangleP : public ShapeBase<S_> {
public:
    using S = S_;

    TriangleP(const Vector3<S> &a_, const Vector3<S> &b_, const Vector3<S> &c_) : a(a_), b(b_), c(c_) {}

    Vector3<S> a, b, c;

    void computeLocalAABB() override { this->set_local_box(); }
    NODE_TYPE getNodeType() const override { return GEOM_TRIANGLE; }

    const cstk::Body &body() const override {
        std::array<double, 9> xyz;
        for (int i = 0; i < 9; ++i) {
            xyz[i] = (i < 3 ? a : i < 6 ? b : c)[i % 3];
        }
        /* A hull, so that it may have no area. */
        return body_.of(xyz, [&xyz](cstk::BodyBuilder &builder) { builder.add_polyhedron(xyz); });
    }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t) const override {
        Eigen::Vector3d farthest = a.template cast<double>();
        for (const Vector3<S> *corner : {&b, &c}) {
            const Eigen::Vector3d other = corner->template cast<double>();
            farthest = direction.dot(other) > direction.dot(farthest) ? other : farthest;
        }
        return farthest;
    }

private:
    detail::ShapeBody<9> body_;
};

using TrianglePf = TriangleP<float>;
using TrianglePd = TriangleP<double>;

} // namespace cstk_fcl

#endif
