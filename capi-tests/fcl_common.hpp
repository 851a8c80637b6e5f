// What both programs of the cross-check share: bodies as each library holds them, poses, counting,
// and timing.
#ifndef CSTK_FCL_COMMON_HPP
#define CSTK_FCL_COMMON_HPP

#include "fcl_models.hpp"
#include "truth.hpp"

#include <cstk.h>

#include <fcl/fcl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <map>
#include <set>
#include <string>
#include <vector>

// A status that is not CSTK_OK is never expected here.
inline void must(cstk_status status) {
    if (status != CSTK_OK) {
        std::printf("FAILED: %s: %s\n", cstk_status_name(status), cstk_last_error_message());
        std::exit(1);
    }
}

struct Release {
    void operator()(cstk_body *p) const { cstk_body_release(p); }
    void operator()(cstk_body_builder *p) const { cstk_body_builder_release(p); }
    void operator()(cstk_query *p) const { cstk_query_release(p); }
    void operator()(cstk_robot *p) const { cstk_robot_release(p); }
    void operator()(cstk_robot_builder *p) const { cstk_robot_builder_release(p); }
    void operator()(cstk_space *p) const { cstk_space_release(p); }
    void operator()(cstk_environment *p) const { cstk_environment_release(p); }
    void operator()(cstk_cobject *p) const { cstk_cobject_release(p); }
};
template <class T> using Handle = std::unique_ptr<T, Release>;

inline Handle<cstk_query> make_query() {
    cstk_query *q = nullptr;
    must(cstk_query_create(&q));
    return Handle<cstk_query>(q);
}

struct Pose {
    double m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

inline Pose translation(double x, double y, double z) {
    Pose p;
    p.m[3] = x, p.m[7] = y, p.m[11] = z;
    return p;
}

// By a unit quaternion, drawn evenly.
inline Pose random_rotation(models::Random &random) {
    double q[4], n = 0;
    do {
        n = 0;
        for (double &c : q) {
            c = random.uniform(-1, 1);
            n += c * c;
        }
    } while (n < 0.01 || n > 1);
    n = std::sqrt(n);
    const double x = q[0] / n, y = q[1] / n, z = q[2] / n, w = q[3] / n;
    Pose p;
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                         2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 9; ++i) {
        p.m[4 * (i / 3) + i % 3] = r[i];
    }
    return p;
}

// One of the 24 turns of a cube: the source of exactly parallel faces and edges.
inline Pose random_quarter_turn(models::Random &random) {
    Pose p;
    const std::size_t first = random.below(3), second = (first + 1 + random.below(2)) % 3,
                      third = 3 - first - second;
    double row[3][3] = {};
    row[0][first] = random.below(2) ? 1 : -1;
    row[1][second] = random.below(2) ? 1 : -1;
    const double parity = (second == (first + 1) % 3) ? 1 : -1;
    row[2][third] = parity * row[0][first] * row[1][second];
    for (int i = 0; i < 9; ++i) {
        p.m[4 * (i / 3) + i % 3] = row[i / 3][i % 3];
    }
    return p;
}

inline fcl::Transform3d fcl_pose(const Pose &p) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
            t(i, j) = p.m[4 * i + j];
        }
    }
    return t;
}

using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

// A surface as libcstk, FCL and the brute force hold it.
struct Body {
    models::Mesh mesh;
    Handle<cstk_body> body;
    std::shared_ptr<FclMesh> fcl;
    // Convex polygons as libcstk numbers them, and their triangles; witnesses name these.
    std::vector<std::vector<models::Point>> primitives;
    double radius = 0;

    explicit Body(models::Mesh m) : mesh(std::move(m)) {
        build_cstk();
        build_fcl();
        for (const models::Point &p : mesh.vertices) {
            radius = std::max(radius, std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
        }
    }

    // The soup at a pose, seen from `origin`; labelled by face.
    truth::Soup faces(const Pose &pose, truth::V origin) const {
        const truth::Frame frame(pose.m, origin);
        truth::Soup s;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const models::Triangle &t = mesh.triangles[i];
            s.triangles.push_back({frame(mesh.vertices[t[0]].data()),
                                   frame(mesh.vertices[t[1]].data()),
                                   frame(mesh.vertices[t[2]].data())});
            s.labels.push_back(mesh.face_of[i]);
        }
        s.bound();
        return s;
    }
    // The same surface, labelled by primitive.
    truth::Soup by_primitive(const Pose &pose, truth::V origin) const {
        const truth::Frame frame(pose.m, origin);
        truth::Soup s;
        for (std::uint32_t i = 0; i < primitives.size(); ++i) {
            const auto &p = primitives[i];
            for (std::size_t k = 2; k < p.size(); ++k) {
                s.triangles.push_back(
                    {frame(p[0].data()), frame(p[k - 1].data()), frame(p[k].data())});
                s.labels.push_back(i);
            }
        }
        s.bound();
        return s;
    }

  private:
    void build_cstk() {
        cstk_body_builder *raw = nullptr;
        must(cstk_body_builder_create(3, &raw));
        const Handle<cstk_body_builder> builder(raw);
        std::vector<std::uint32_t> sizes, indices;
        for (const models::Face &f : mesh.faces) {
            sizes.push_back(static_cast<std::uint32_t>(f.size()));
            indices.insert(indices.end(), f.begin(), f.end());
        }
        must(cstk_body_builder_add_mesh(raw, mesh.vertices[0].data(), mesh.vertices.size(),
                                        sizes.data(), sizes.size(), indices.data(),
                                        indices.size(), nullptr, nullptr));
        cstk_body *made = nullptr;
        must(cstk_body_build(raw, nullptr, nullptr, nullptr, &made));
        body.reset(made);
        read_primitives();
    }
    void read_primitives() {
        cstk_body_statistics statistics = {};
        must(cstk_body_get_statistics(body.get(), &statistics));
        primitives.resize(statistics.primitive_count);
        for (std::uint32_t i = 0; i < primitives.size(); ++i) {
            std::size_t count = 0;
            must(cstk_body_get_feature_vertices(body.get(), i, CSTK_FEATURE_FACE, 0, 0, nullptr, &count));
            primitives[i].resize(count);
            must(cstk_body_get_feature_vertices(body.get(), i, CSTK_FEATURE_FACE, 0, count,
                                            primitives[i][0].data(), &count));
        }
    }
    void build_fcl() {
        std::vector<fcl::Vector3d> points;
        std::vector<fcl::Triangle> triangles;
        for (const models::Point &p : mesh.vertices) {
            points.emplace_back(p[0], p[1], p[2]);
        }
        for (const models::Triangle &t : mesh.triangles) {
            triangles.emplace_back(t[0], t[1], t[2]);
        }
        fcl = std::make_shared<FclMesh>();
        fcl->beginModel();
        fcl->addSubModel(points, triangles);
        fcl->endModel();
    }
};

// Where the middle of a body's ball stands: lengths are compared relative to coordinates seen from
// there.
inline truth::V centre(const Pose &pose) { return {pose.m[3], pose.m[7], pose.m[11]}; }

inline double largest_coordinate(const truth::Soup &a, const truth::Soup &b) {
    truth::Real l = 0;
    for (const truth::Soup *s : {&a, &b}) {
        for (const truth::Triangle &t : s->triangles) {
            for (const truth::V &p : t) {
                l = std::max({l, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
            }
        }
    }
    return static_cast<double>(l);
}

inline truth::V point(const double *p, truth::V origin) {
    return truth::V{p[0], p[1], p[2]} - origin;
}

// The sum of the areas of polygons, to see that a split face is covered once.
inline double area(const std::vector<std::vector<models::Point>> &polygons) {
    truth::Real sum = 0;
    for (const auto &p : polygons) {
        truth::V n = {0, 0, 0};
        const truth::V a = point(p[0].data(), {0, 0, 0});
        for (std::size_t k = 2; k < p.size(); ++k) {
            n = n + truth::cross(point(p[k - 1].data(), a), point(p[k].data(), a));
        }
        sum += truth::length(n) / 2;
    }
    return static_cast<double>(sum);
}

struct Tally {
    long poses = 0, checks = 0, failures = 0, disagreements = 0, fcl_wrong = 0, ties = 0;

    std::map<std::string, long> failed;

    // Counts a check; the first failures of each kind are told to `dump`, which writes what
    // reproduces them.
    template <class Dump> bool expect(bool ok, const char *what, const Dump &dump) {
        ++checks;
        if (!ok && (++failures, ++failed[what] <= 2)) {
            std::printf("FAILED: %s\n", what);
            dump();
        }
        return ok;
    }
    int finish(const char *program) const {
        for (const auto &[what, count] : failed) {
            std::printf("FAILED %ld times: %s\n", count, what.c_str());
        }
        std::printf("%s: %ld poses, %ld checks, %ld failures, %ld disagreements with FCL (FCL "
                    "wrong in %ld), "
                    "%ld ties\n",
                    program, poses, checks, failures, disagreements, fcl_wrong, ties);
        return failures == 0 ? 0 : 1;
    }
};

// Medians of microseconds, for information only.
class Stopwatch {
  public:
    template <class F> auto operator()(F &&work) {
        const auto start = std::chrono::steady_clock::now();
        struct Stop {
            std::vector<float> &times;
            std::chrono::steady_clock::time_point start;
            ~Stop() {
                const std::chrono::duration<float, std::micro> t =
                    std::chrono::steady_clock::now() - start;
                times.push_back(t.count());
            }
        } stop{times_, start};
        return work();
    }
    double median() {
        if (times_.empty()) {
            return 0;
        }
        const auto middle = times_.begin() + static_cast<std::ptrdiff_t>(times_.size() / 2);
        std::nth_element(times_.begin(), middle, times_.end());
        return static_cast<double>(*middle);
    }

  private:
    std::vector<float> times_;
};

inline void print_pose(const char *name, const Pose &p) {
    std::printf("    %s = {", name);
    for (int i = 0; i < 12; ++i) {
        std::printf("%s%.17g", i ? ", " : "", p.m[i]);
    }
    std::printf("}\n");
}

#endif
