// Generated surface bodies for the cross-check against FCL: each as polygons (for libcstk) and as
// triangles (for FCL and for the long double truth). Nothing is read from files, so a case is
// reproduced by names and poses alone.
#ifndef CSTK_FCL_MODELS_HPP
#define CSTK_FCL_MODELS_HPP

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace models {

using Point = std::array<double, 3>;
using Face = std::vector<std::uint32_t>;
using Triangle = std::array<std::uint32_t, 3>;

const double pi = 3.14159265358979323846;

// splitmix64: the same numbers from the same seed on every platform, unlike the distributions of
// <random>.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
    }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

    // A direction, evenly over the sphere: rejection from the cube needs no transcendental
    // functions.
    Point direction() {
        for (;;) {
            const Point p = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
            const double n = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            if (n > 0.1 && n <= 1) {
                return {p[0] / n, p[1] / n, p[2] / n};
            }
        }
    }

  private:
    std::uint64_t state_;
};

struct Mesh {
    std::string name;
    std::vector<Point> vertices;
    std::vector<Face> faces;
    // The same surface in triangles, and the face each is part of.
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> face_of;

    std::uint32_t vertex(double x, double y, double z) {
        vertices.push_back({x, y, z});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }
    // `parts` are the triangles of a non-convex face, as positions in it; without any the face is a
    // fan.
    void face(const Face &f, const std::vector<Triangle> &parts = {}) {
        const auto number = static_cast<std::uint32_t>(faces.size());
        faces.push_back(f);
        for (const Triangle &t : parts) {
            triangles.push_back({f[t[0]], f[t[1]], f[t[2]]});
            face_of.push_back(number);
        }
        for (std::size_t i = 2; parts.empty() && i < f.size(); ++i) {
            triangles.push_back({f[0], f[i - 1], f[i]});
            face_of.push_back(number);
        }
    }
};

// A sphere of `rings` x `sectors` planar faces. Radius r(u, v) = 1 + bump * waves, which makes it
// star-shaped; quads are no longer planar then and are given as triangles.
inline Mesh sphere(const std::string &name, double radius, int rings, int sectors, double bump) {
    Mesh m;
    m.name = name;
    const auto at = [&](double u, double v) {
        const double wave = std::sin(5 * v) * std::sin(4 * u) + 0.5 * std::cos(7 * u);
        const double r = radius * (1 + bump * wave * std::sin(u));
        return m.vertex(r * std::sin(u) * std::cos(v), r * std::sin(u) * std::sin(v),
                        r * std::cos(u));
    };
    const std::uint32_t top = at(0, 0);
    for (int i = 1; i < rings; ++i) {
        for (int j = 0; j < sectors; ++j) {
            at(pi * i / rings, 2 * pi * j / sectors);
        }
    }
    const std::uint32_t bottom = at(pi, 0);
    const auto id = [&](int i, int j) {
        return static_cast<std::uint32_t>(1 + (i - 1) * sectors + j % sectors);
    };
    for (int j = 0; j < sectors; ++j) {
        m.face({top, id(1, j), id(1, j + 1)});
        m.face({bottom, id(rings - 1, j + 1), id(rings - 1, j)});
        for (int i = 1; i + 1 < rings; ++i) {
            const Face quad = {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)};
            if (bump == 0) {
                m.face(quad);
            } else {
                m.face({quad[0], quad[1], quad[2]});
                m.face({quad[0], quad[2], quad[3]});
            }
        }
    }
    return m;
}

// Extrudes an outline along z: quad sides and one polygon for each cap, non-convex where the
// outline is.
inline Mesh prism(const std::string &name, const std::vector<std::pair<double, double>> &outline,
                  double low, double high, const std::vector<Triangle> &parts = {}) {
    Mesh m;
    m.name = name;
    const auto n = static_cast<std::uint32_t>(outline.size());
    Face floor, ceiling;
    for (std::uint32_t i = 0; i < n; ++i) {
        floor.push_back(m.vertex(outline[i].first, outline[i].second, low));
        ceiling.push_back(m.vertex(outline[i].first, outline[i].second, high));
    }
    m.face(floor, parts);
    m.face(ceiling, parts);
    for (std::uint32_t i = 0; i < n; ++i) {
        m.face({floor[i], floor[(i + 1) % n], ceiling[(i + 1) % n], ceiling[i]});
    }
    return m;
}

inline Mesh cylinder(const std::string &name, double radius, double height, int sides) {
    std::vector<std::pair<double, double>> outline;
    for (int i = 0; i < sides; ++i) {
        outline.emplace_back(radius * std::cos(2 * pi * i / sides),
                             radius * std::sin(2 * pi * i / sides));
    }
    return prism(name, outline, -height / 2, height / 2);
}

inline Mesh box(const std::string &name, double x, double y, double z) {
    return prism(name, {{-x / 2, -y / 2}, {x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}}, -z / 2,
                 z / 2);
}

inline Mesh tetrahedron(double size) {
    Mesh m;
    m.name = "tetrahedron";
    m.vertex(size, size, size);
    m.vertex(size, -size, -size);
    m.vertex(-size, size, -size);
    m.vertex(-size, -size, size);
    m.face({0, 1, 2});
    m.face({0, 3, 1});
    m.face({0, 2, 3});
    m.face({1, 3, 2});
    return m;
}

inline Mesh torus(double large, double small, int n, int k) {
    Mesh m;
    m.name = "torus";
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < k; ++j) {
            const double u = 2 * pi * i / n, v = 2 * pi * j / k;
            const double r = large + small * std::cos(v);
            m.vertex(r * std::cos(u), r * std::sin(u), small * std::sin(v));
        }
    }
    const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(i % n * k + j % k); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < k; ++j) {
            m.face({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    }
    return m;
}

inline Mesh l_prism() {
    return prism("l_prism", {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}}, -0.4, 0.4);
}

inline Mesh c_prism() {
    return prism(
        "c_prism",
        {{-1, -1}, {1, -1}, {1, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}, {1, 0.5}, {1, 1}, {-1, 1}}, -0.3,
        0.3, {{0, 1, 2}, {0, 2, 3}, {0, 3, 7}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}});
}

// A box and an octahedron that do not touch: one body of two pieces.
inline Mesh two_pieces() {
    Mesh m = box("two_pieces", 0.6, 0.5, 0.9);
    for (Point &p : m.vertices) {
        p[0] -= 0.8;
    }
    const double c = 0.7, r = 0.45;
    const auto base = static_cast<std::uint32_t>(m.vertices.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            Point p = {c, 0, 0};
            p[static_cast<std::size_t>(axis)] += sign * r;
            m.vertices.push_back(p);
        }
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
        m.face({base + (i & 1), base + 2 + (i >> 1 & 1), base + 4 + (i >> 2)});
    }
    return m;
}

inline std::vector<Mesh> all() {
    return {sphere("sphere", 0.8, 12, 18, 0), cylinder("cylinder", 0.5, 1.6, 24),
            box("box", 1.0, 1.5, 0.75), tetrahedron(0.5), torus(0.9, 0.3, 24, 12), l_prism(),
            c_prism(), sphere("bumpy", 0.8, 20, 26, 0.18), two_pieces(),
            // Slivers: thin bodies whose triangles are long and narrow.
            cylinder("disc", 1.2, 0.01, 64), box("needle", 3, 0.02, 0.01)};
}

} // namespace models

#endif
