/* Part of cstk/fcl.hpp: the penetration depth of two convex sets given by support points, where cstk_pair_penetration has none. */
#ifndef CSTK_FCL_PENETRATION_HPP
#define CSTK_FCL_PENETRATION_HPP

#include <cstk/fcl/types.hpp>

#include <cmath>

namespace cstk_fcl {
namespace detail {

/// A translation of set b by depth * normal that separates it from set a, and the points that it brings together.
struct Depth {
    double depth = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
    Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
    Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
};

/// The expanding polytope algorithm (van den Bergen, 2001) on the difference a - b: facets of a polytope of support points, the
/// nearest to the origin expanded first. Every direction looked at gives an upper bound of the depth, which is what is
/// returned; the nearest facet gives a lower one, and the search ends where the two agree. About a point from which all directions are
/// nearly alike, as the middle of a ball, it would take facets without number: there the best direction found is led downhill instead.
/// The origin need not be inside.
template <typename SupportA, typename SupportB> class ExpandingPolytope {
public:
    ExpandingPolytope(const SupportA &a, const SupportB &b) : support_a_(a), support_b_(b) {}

    Depth run() {
        if (!make_simplex()) {
            return best_;
        }
        for (int i = 0; i < MAX_EXPANSIONS; ++i) {
            const std::size_t nearest = nearest_facet();
            const Facet facet = facets_[nearest];
            const Vertex vertex = support(facet.normal);
            if (best_.depth - facet.offset <= TOLERANCE * size_ || !expand(vertex)) {
                set_points();
                return best_;
            }
        }
        lead_downhill();
        set_points();
        return best_;
    }

private:
    using Vector = Eigen::Vector3d;

    /// The bounds' difference at which the search ends, as a part of the difference's size.
    static constexpr double TOLERANCE = 1e-8;
    /// Of cylinders, cones and ellipsoids in random poses 60 suffice.
    static constexpr int MAX_EXPANSIONS = 200;
    /// Of steps downhill, of which each is one support point, and the least that is tried.
    static constexpr int MAX_STEPS = 1000;
    static constexpr double LEAST_STEP = 1e-6;
    /// A point outside a facet by less than this part of the size does not expand it.
    static constexpr double ROUNDING = 1e-14;

    struct Vertex {
        Vector point, a, b;
    };

    struct Facet {
        std::array<std::size_t, 3> corners;
        Vector normal;
        double offset;
    };

    /// The farthest point of a - b, whose plane also bounds the depth from above.
    Vertex support(const Vector &normal) {
        const Vector a = support_a_(normal), b = support_b_(-normal);
        const Vertex vertex = {a - b, a, b};
        const double depth = normal.dot(vertex.point);
        if (!has_best_ || depth < best_.depth) {
            has_best_ = true;
            best_.depth = depth;
            best_.normal = normal;
            best_.point_a = a;
            best_.point_b = b;
        }
        size_ = std::max(size_, vertex.point.norm());
        return vertex;
    }

    /// Turns the best direction towards less depth, by the support point's offset across it, in steps that grow where they help.
    void lead_downhill() {
        double step = 1;
        for (int i = 0; i < MAX_STEPS && step > LEAST_STEP; ++i) {
            const Vector normal = best_.normal, point = best_.point_a - best_.point_b;
            const Vector across = point - normal * normal.dot(point);
            const double depth = best_.depth;
            if (across.norm() <= ROUNDING * size_) {
                return;
            }
            support((normal * std::max(depth, ROUNDING * size_) - step * across).normalized());
            step *= best_.depth < depth ? 2 : 0.25;
        }
    }

    /// The farther of the support points along a direction and against it, seen from `from`.
    Vertex farthest(const Vector &direction, const Vector &from) {
        const Vertex ahead = support(direction), behind = support(-direction);
        return direction.dot(ahead.point - from) >= direction.dot(from - behind.point) ? ahead : behind;
    }

    /// Four points that are not in a plane. False for sets that are flat together.
    bool make_simplex() {
        const Vertex first = support(Vector::UnitX());
        Vector along = Vector::Zero();
        Vertex second = first;
        for (int axis = 0; axis < 3; ++axis) {
            const Vertex other = farthest(Vector::Unit(axis), first.point);
            if ((other.point - first.point).norm() > along.norm()) {
                along = other.point - first.point;
                second = other;
            }
        }
        if (along.norm() <= FLAT * size_) {
            return false;
        }
        const Vector across = along.unitOrthogonal();
        const Vector third_axis = along.cross(across).normalized();
        Vertex third = farthest(across, first.point);
        const Vertex other = farthest(third_axis, first.point);
        if (along.cross(other.point - first.point).norm() > along.cross(third.point - first.point).norm()) {
            third = other;
        }
        const Vector normal = along.cross(third.point - first.point);
        if (normal.norm() <= FLAT * size_ * along.norm()) {
            return false;
        }
        const Vertex fourth = farthest(normal.normalized(), first.point);
        if (std::abs(normal.normalized().dot(fourth.point - first.point)) <= FLAT * size_) {
            return false;
        }
        vertices_ = {first, second, third, fourth};
        inside_ = (first.point + second.point + third.point + fourth.point) / 4;
        return add({0, 1, 2}) && add({0, 1, 3}) && add({0, 2, 3}) && add({1, 2, 3});
    }

    /// Adds a facet, its normal away from the first simplex. False if it has no area.
    bool add(std::array<std::size_t, 3> corners) {
        const Vector &a = vertices_[corners[0]].point;
        Vector normal = (vertices_[corners[1]].point - a).cross(vertices_[corners[2]].point - a);
        const double area = normal.norm();
        if (area <= ROUNDING * size_ * size_) {
            return false;
        }
        normal /= area;
        if (normal.dot(a - inside_) < 0) {
            normal = -normal;
            std::swap(corners[1], corners[2]);
        }
        facets_.push_back({corners, normal, normal.dot(a)});
        return true;
    }

    std::size_t nearest_facet() const {
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < facets_.size(); ++i) {
            nearest = facets_[i].offset < facets_[nearest].offset ? i : nearest;
        }
        return nearest;
    }

    /// Replaces the facets that the vertex sees by those from their outline to the vertex. False where rounding allows no more.
    bool expand(const Vertex &vertex) {
        std::vector<std::array<std::size_t, 2>> outline;
        std::vector<Facet> hidden;
        for (const Facet &facet : facets_) {
            if (facet.normal.dot(vertex.point) <= facet.offset + ROUNDING * size_) {
                hidden.push_back(facet);
                continue;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                toggle(outline, {facet.corners[i], facet.corners[(i + 1) % 3]});
            }
        }
        if (hidden.size() == facets_.size() || hidden.empty()) {
            return false;
        }
        std::vector<Facet> before = std::exchange(facets_, std::move(hidden));
        vertices_.push_back(vertex);
        for (const std::array<std::size_t, 2> &edge : outline) {
            if (!add({edge[0], edge[1], vertices_.size() - 1})) {
                facets_ = std::move(before);
                return false;
            }
        }
        return true;
    }

    /// An edge between two facets that go is no part of the outline.
    static void toggle(std::vector<std::array<std::size_t, 2>> &outline, const std::array<std::size_t, 2> &edge) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            if (outline[i][0] == edge[1] && outline[i][1] == edge[0]) {
                outline[i] = outline.back();
                outline.pop_back();
                return;
            }
        }
        outline.push_back(edge);
    }

    /// The points of both sets that make up the point of the polytope that is nearest to the origin. Where several facets lie
    /// in the plane of the nearest, it is in one of them.
    void set_points() {
        double most_inside = -std::numeric_limits<double>::infinity();
        const double nearest = facets_[nearest_facet()].offset;
        for (const Facet &facet : facets_) {
            if (facet.offset > nearest + 1e-6 * size_ || facet.normal.dot(best_.normal) < 1 - 1e-6) {
                continue;
            }
            const Vertex &p = vertices_[facet.corners[0]], &q = vertices_[facet.corners[1]], &r = vertices_[facet.corners[2]];
            const Vector foot = facet.normal * facet.offset;
            const Vector whole = (q.point - p.point).cross(r.point - p.point);
            const double area = whole.squaredNorm();
            const double v = whole.dot((foot - p.point).cross(r.point - p.point)) / area;
            const double w = whole.dot((q.point - p.point).cross(foot - p.point)) / area;
            const double inside = std::min({v, w, 1 - v - w});
            if (inside > most_inside) {
                most_inside = inside;
                const Vector parts = Vector(1 - v - w, v, w).cwiseMax(0) / Vector(1 - v - w, v, w).cwiseMax(0).sum();
                best_.point_a = parts[0] * p.a + parts[1] * q.a + parts[2] * r.a;
                best_.point_b = parts[0] * p.b + parts[1] * q.b + parts[2] * r.b;
            }
        }
    }

    /// A simplex flatter than this part of the size is none.
    static constexpr double FLAT = 1e-9;

    const SupportA &support_a_;
    const SupportB &support_b_;
    std::vector<Vertex> vertices_;
    std::vector<Facet> facets_;
    Vector inside_ = Vector::Zero();
    Depth best_;
    bool has_best_ = false;
    double size_ = 0;
};

/// `support_a` and `support_b` return the farthest point of each set along a unit vector, in one frame. Depths are at least 0.
template <typename SupportA, typename SupportB>
Depth penetration_depth(const SupportA &support_a, const SupportB &support_b) {
    Depth found = ExpandingPolytope<SupportA, SupportB>(support_a, support_b).run();
    found.depth = std::max(found.depth, 0.0);
    return found;
}

} // namespace detail
} // namespace cstk_fcl

#endif
