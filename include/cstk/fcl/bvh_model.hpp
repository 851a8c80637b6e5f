/* Part of cstk/fcl.hpp: models of triangles or points. */
#ifndef CSTK_FCL_BVH_MODEL_HPP
#define CSTK_FCL_BVH_MODEL_HPP

#include <cstk/fcl/geometry.hpp>

#include <set>

namespace cstk_fcl {

/* FCL's bounding volumes. They name a model's type and choose nothing: libcstk has one hierarchy. */
template <typename S_> struct OBB { using S = S_; };
template <typename S_> struct RSS { using S = S_; };
template <typename S_> struct OBBRSS { using S = S_; };
template <typename S_> struct kIOS { using S = S_; };
template <typename S_, std::size_t N> struct KDOP { using S = S_; };

using OBBf = OBB<float>;
using OBBd = OBB<double>;
using RSSf = RSS<float>;
using RSSd = RSS<double>;
using OBBRSSf = OBBRSS<float>;
using OBBRSSd = OBBRSS<double>;
using kIOSf = kIOS<float>;
using kIOSd = kIOS<double>;

enum BVHBuildState {
    BVH_BUILD_STATE_EMPTY,
    BVH_BUILD_STATE_BEGUN,
    BVH_BUILD_STATE_PROCESSED,
    BVH_BUILD_STATE_UPDATE_BEGUN,
    BVH_BUILD_STATE_UPDATED,
    BVH_BUILD_STATE_REPLACE_BEGUN
};

enum BVHReturnCode {
    BVH_OK = 0,
    BVH_ERR_MODEL_OUT_OF_MEMORY = -1,
    BVH_ERR_BUILD_OUT_OF_SEQUENCE = -2,
    BVH_ERR_BUILD_EMPTY_MODEL = -3,
    BVH_ERR_BUILD_EMPTY_PREVIOUS_FRAME = -4,
    BVH_ERR_UNSUPPORTED_FUNCTION = -5,
    BVH_ERR_UNUPDATED_MODEL = -6,
    BVH_ERR_INCORRECT_DATA = -7,
    BVH_ERR_UNKNOWN = -8
};

enum BVHModelType { BVH_MODEL_UNKNOWN, BVH_MODEL_TRIANGLES, BVH_MODEL_POINTCLOUD };

namespace detail {

template <typename BV> struct NodeTypeOf;
template <typename S> struct NodeTypeOf<AABB<S>> { static constexpr NODE_TYPE value = BV_AABB; };
template <typename S> struct NodeTypeOf<OBB<S>> { static constexpr NODE_TYPE value = BV_OBB; };
template <typename S> struct NodeTypeOf<RSS<S>> { static constexpr NODE_TYPE value = BV_RSS; };
template <typename S> struct NodeTypeOf<OBBRSS<S>> { static constexpr NODE_TYPE value = BV_OBBRSS; };
template <typename S> struct NodeTypeOf<kIOS<S>> { static constexpr NODE_TYPE value = BV_kIOS; };
template <typename S> struct NodeTypeOf<KDOP<S, 16>> { static constexpr NODE_TYPE value = BV_KDOP16; };
template <typename S> struct NodeTypeOf<KDOP<S, 18>> { static constexpr NODE_TYPE value = BV_KDOP18; };
template <typename S> struct NodeTypeOf<KDOP<S, 24>> { static constexpr NODE_TYPE value = BV_KDOP24; };

} // namespace detail

/// A model of triangles, a surface, or of points. Fill it between beginModel() and endModel(), which builds it.
template <typename BV> class BVHModel : public CollisionGeometry<typename BV::S> {
public:
    using S = typename BV::S;

    BVHModel() = default;
    BVHModel(const BVHModel &other) : CollisionGeometry<S>(other) { *this = other; }
    /// The copy shares the built body.
    BVHModel &operator=(const BVHModel &other) {
        CollisionGeometry<S>::operator=(other);
        points_ = other.points_;
        triangles_ = other.triangles_;
        body_ = other.body_;
        solid_ = other.solid_;
        build_state = other.build_state;
        show_arrays();
        return *this;
    }

    OBJECT_TYPE getObjectType() const override { return OT_BVH; }
    NODE_TYPE getNodeType() const override { return detail::NodeTypeOf<BV>::value; }

    BVHModelType getModelType() const {
        return !triangles_.empty() ? BVH_MODEL_TRIANGLES : !points_.empty() ? BVH_MODEL_POINTCLOUD : BVH_MODEL_UNKNOWN;
    }

    void computeLocalAABB() override {
        this->aabb_local = AABB<S>();
        for (const Vector3<S> &point : points_) {
            this->aabb_local += point;
        }
        this->aabb_center = this->aabb_local.center();
        S square = 0;
        for (const Vector3<S> &point : points_) {
            square = std::max(square, (point - this->aabb_center).squaredNorm());
        }
        this->aabb_radius = std::sqrt(square);
    }

    int beginModel(int num_tris_ = 0, int num_vertices_ = 0) {
        points_.clear();
        triangles_.clear();
        triangles_.reserve(static_cast<std::size_t>(std::max(num_tris_, 0)));
        points_.reserve(static_cast<std::size_t>(std::max(num_vertices_, 0)));
        body_ = cstk::Body();
        build_state = BVH_BUILD_STATE_BEGUN;
        show_arrays();
        return BVH_OK;
    }

    int addVertex(const Vector3<S> &p) { return addSubModel({p}); }

    int addTriangle(const Vector3<S> &p1, const Vector3<S> &p2, const Vector3<S> &p3) {
        return addSubModel({p1, p2, p3}, {Triangle(0, 1, 2)});
    }

    /// Indices count from the first of these points.
    int addSubModel(const std::vector<Vector3<S>> &points, const std::vector<Triangle> &triangles) {
        const std::size_t first = points_.size();
        const int added = addSubModel(points);
        if (added == BVH_OK) {
            for (const Triangle &t : triangles) {
                triangles_.emplace_back(first + t[0], first + t[1], first + t[2]);
            }
            show_arrays();
        }
        return added;
    }

    int addSubModel(const std::vector<Vector3<S>> &points) {
        if (build_state != BVH_BUILD_STATE_BEGUN) {
            return BVH_ERR_BUILD_OUT_OF_SEQUENCE;
        }
        points_.insert(points_.end(), points.begin(), points.end());
        show_arrays();
        return BVH_OK;
    }

    /// Not of FCL: the triangles bound a solid, whose inside meets what is in it. endModel() then checks that they are closed, and
    /// returns BVH_ERR_INCORRECT_DATA if they are not.
    void set_solid(bool solid = true) { solid_ = solid; }

    /// Builds the model: 5 microseconds a triangle, 2 a point. BVH_ERR_INCORRECT_DATA (cstk_last_error_message() names the culprit)
    /// for an index beyond the vertices or a number that is not finite.
    int endModel() {
        if (build_state != BVH_BUILD_STATE_BEGUN) {
            return BVH_ERR_BUILD_OUT_OF_SEQUENCE;
        }
        if (points_.empty()) {
            return BVH_ERR_BUILD_EMPTY_MODEL;
        }
        try {
            body_ = triangles_.empty() ? cloud() : surface();
        } catch (const cstk::Error &) {
            return BVH_ERR_INCORRECT_DATA;
        }
        build_state = BVH_BUILD_STATE_PROCESSED;
        return BVH_OK;
    }

    int beginReplaceModel() = delete; // deforming models are not covered: build another one, or see cstk::Body::refit
    int endReplaceModel(bool refit = true, bool bottomup = true) = delete; // build another model, or see cstk::Body::refit
    int beginUpdateModel() = delete; // deforming models are not covered: build another one, or see cstk::Body::refit
    int endUpdateModel(bool refit = true, bool bottomup = true) = delete; // build another model, or see cstk::Body::refit
    void getBV(int id) const = delete; // the nodes are not FCL's: see body().level_nodes()
    int getNumBVs() const = delete; // the nodes are not FCL's: see body().hierarchy_statistics()

    /// What was added, to be read only.
    Vector3<S> *vertices = nullptr;
    Triangle *tri_indices = nullptr;
    int num_tris = 0;
    int num_vertices = 0;
    BVHBuildState build_state = BVH_BUILD_STATE_EMPTY;

    const cstk::Body &body() const override {
        if (!body_) {
            throw std::invalid_argument("cstk_fcl: a BVHModel is asked before its endModel()");
        }
        return body_;
    }

    std::size_t primitive_count() const override { return triangles_.empty() ? points_.size() : triangles_.size(); }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t primitive) const override {
        if (triangles_.empty()) {
            return points_[primitive].template cast<double>();
        }
        const Triangle &triangle = triangles_[primitive];
        Eigen::Vector3d farthest = points_[triangle[0]].template cast<double>();
        for (int i = 1; i < 3; ++i) {
            const Eigen::Vector3d other = points_[triangle[i]].template cast<double>();
            farthest = direction.dot(other) > direction.dot(farthest) ? other : farthest;
        }
        return farthest;
    }

private:
    std::vector<double> coordinates() const {
        std::vector<double> xyz;
        xyz.reserve(3 * points_.size());
        for (const Vector3<S> &point : points_) {
            xyz.insert(xyz.end(), point.data(), point.data() + 3);
        }
        return xyz;
    }

    cstk::Body cloud() const {
        cstk::BodyBuilder builder;
        return builder.add_points(coordinates()).build();
    }

    /// Tags are the triangles' indices. Triangles without area, which meshes leave out, are kept as segments or points, unless the
    /// model is solid: the surface closes without them.
    cstk::Body surface() const {
        const std::vector<double> xyz = coordinates();
        std::vector<std::uint32_t> indices;
        indices.reserve(3 * triangles_.size());
        for (const Triangle &triangle : triangles_) {
            for (int i = 0; i < 3; ++i) {
                const std::size_t index = std::min<std::size_t>(triangle[i], std::numeric_limits<std::uint32_t>::max());
                indices.push_back(static_cast<std::uint32_t>(index));
            }
        }
        cstk::BodyBuilder builder;
        builder.add_triangles(xyz, indices).set_solid(solid_);
        if (solid_) {
            return builder.build();
        }
        cstk_body *made = nullptr;
        const cstk_status status = cstk_body_build(builder.get(), nullptr, nullptr, nullptr, &made);
        const cstk::Body built(made);
        if (status != CSTK_ERROR_EMPTY) {
            cstk::check(status);
            if (built.statistics().faces_dropped == 0) {
                return built;
            }
        }
        std::set<std::uint64_t> kept;
        const std::uint64_t count = built ? built.statistics().primitive_count : 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            kept.insert(built.primitive(static_cast<std::uint32_t>(i)).tag);
        }
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            if (kept.count(i) == 0) {
                std::array<double, 9> corners;
                for (std::size_t k = 0; k < 9; ++k) {
                    corners[k] = xyz[3 * indices[3 * i + k / 3] + k % 3];
                }
                builder.add_polyhedron(corners, i);
            }
        }
        return builder.build();
    }

    void show_arrays() {
        vertices = points_.data();
        tri_indices = triangles_.data();
        num_vertices = static_cast<int>(points_.size());
        num_tris = static_cast<int>(triangles_.size());
    }

    std::vector<Vector3<S>> points_;
    std::vector<Triangle> triangles_;
    cstk::Body body_;
    bool solid_ = false;
};

} // namespace cstk_fcl

#endif
