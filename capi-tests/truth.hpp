// The truth by brute force: distances of triangle soups in long double, by closed forms that look
// at every pair of features. It is slow and simple on purpose, and shares nothing with the
// libraries it judges.
#ifndef CSTK_TRUTH_HPP
#define CSTK_TRUTH_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace truth {

using Real = long double;
const Real infinity = std::numeric_limits<Real>::infinity();

struct V {
    Real x, y, z;
};
inline V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator*(Real s, V a) { return {s * a.x, s * a.y, s * a.z}; }
inline Real dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(V a, V b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(V a) { return std::sqrt(dot(a, a)); }

using Triangle = std::array<V, 3>;

inline Real point_segment(V p, V a, V b) {
    const V u = b - a;
    const Real uu = dot(u, u);
    const Real t = uu > 0 ? std::clamp<Real>(dot(p - a, u) / uu, 0, 1) : 0;
    return length(p - (a + t * u));
}

// The four ends against the other segment, and the inner pair where there is one. The inner
// parameters come from cross products: their error grows with 1/angle, not its square, and stays
// harmless for segments that are nearly parallel.
inline Real segment_segment(V a, V b, V c, V d) {
    Real best = std::min(std::min(point_segment(a, c, d), point_segment(b, c, d)),
                         std::min(point_segment(c, a, b), point_segment(d, a, b)));
    const V u = b - a, v = d - c, w = c - a, n = cross(u, v);
    const Real nn = dot(n, n);
    if (nn > 0) {
        const Real s = dot(cross(w, v), n) / nn, t = dot(cross(w, u), n) / nn;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
            best = std::min(best, length((a + s * u) - (c + t * v)));
        }
    }
    return best;
}

// Whether a point of the triangle's plane is in it, n being its normal.
inline bool over(V p, const Triangle &t, V n) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) < 0) {
            return false;
        }
    }
    return true;
}

inline Real border(V p, const Triangle &t) {
    return std::min(point_segment(p, t[0], t[1]),
                    std::min(point_segment(p, t[1], t[2]), point_segment(p, t[2], t[0])));
}

inline Real point_triangle(V p, const Triangle &t) {
    const V n = cross(t[1] - t[0], t[2] - t[0]);
    const Real nn = length(n);
    if (nn > 0 && over(p, t, n)) {
        return std::fabs(dot(n, p - t[0])) / nn;
    }
    return border(p, t);
}

// How firmly segment ab pierces the triangle: 0 if it does not, else a length by which either may
// be moved in any direction without undoing it.
inline Real pierce(V a, V b, const Triangle &t) {
    const V n = cross(t[1] - t[0], t[2] - t[0]);
    const Real nn = length(n);
    if (!(nn > 0)) {
        return 0;
    }
    const Real ha = dot(n, a - t[0]) / nn, hb = dot(n, b - t[0]) / nn;
    if (!((ha > 0 && hb < 0) || (ha < 0 && hb > 0))) {
        return 0;
    }
    const V at = a + (ha / (ha - hb)) * (b - a);
    if (!over(at, t, n)) {
        return 0;
    }
    const Real sine = std::fabs(ha - hb) / length(b - a);
    return std::min({std::fabs(ha), std::fabs(hb), border(at, t) * sine}) / 2;
}

struct Gap {
    Real distance; // 0 if the sets meet
    Real depth;    // how firmly they do, see pierce
};

inline Gap triangles(const Triangle &a, const Triangle &b) {
    Gap g = {infinity, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const V p = a[i], q = a[(i + 1) % 3], r = b[i], s = b[(i + 1) % 3];
        const Real in_b = pierce(p, q, b), in_a = pierce(r, s, a);
        g.depth = std::max(g.depth, std::max(in_b, in_a));
        g.distance = std::min(g.distance, std::min(point_triangle(p, b), point_triangle(r, a)));
        for (std::size_t j = 0; j < 3; ++j) {
            g.distance = std::min(g.distance, segment_segment(p, q, b[j], b[(j + 1) % 3]));
        }
    }
    if (g.depth > 0) {
        g.distance = 0;
    }
    return g;
}

struct Ball {
    double x, y, z, r;
};

// A lower bound on the distance of the contents of two balls; the slack covers rounding to double.
inline double apart(const Ball &a, const Ball &b) {
    const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return std::sqrt(x * x + y * y + z * z) - (a.r + b.r) * (1 + 1e-12);
}

inline Ball ball_of(const std::vector<V> &points) {
    V low = points[0], high = points[0];
    for (const V p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const V middle = 0.5L * (low + high);
    Real r = 0;
    for (const V p : points) {
        r = std::max(r, length(p - middle));
    }
    const double slack = 1e-12 * static_cast<double>(r + length(middle));
    return {static_cast<double>(middle.x), static_cast<double>(middle.y),
            static_cast<double>(middle.z), static_cast<double>(r) + slack};
}

// Triangles with the label (face or primitive) each belongs to.
struct Soup {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> labels;
    std::vector<Ball> balls;
    Ball whole = {0, 0, 0, 0};

    void bound() {
        std::vector<V> every;
        balls.clear();
        for (const Triangle &t : triangles) {
            balls.push_back(ball_of({t[0], t[1], t[2]}));
            every.insert(every.end(), t.begin(), t.end());
        }
        whole = ball_of(every);
    }
};

// [R | t] with the rotation nearest to R, which is what the poses of the header stand for: two
// steps of Newton's iteration for the polar factor leave nothing of an error of 1e-6. The origin is
// moved to `origin`.
struct Frame {
    std::array<V, 3> rows;
    V shift;

    Frame(const double *pose, V origin) {
        Real r[3][3], g[3][3], next[3][3];
        for (int i = 0; i < 9; ++i) {
            r[i / 3][i % 3] = pose[4 * (i / 3) + i % 3];
        }
        for (int step = 0; step < 2; ++step) {
            for (int i = 0; i < 9; ++i) {
                g[i / 3][i % 3] = (i / 3 == i % 3 ? 3 : 0);
                for (int k = 0; k < 3; ++k) {
                    g[i / 3][i % 3] -= r[k][i / 3] * r[k][i % 3];
                }
            }
            for (int i = 0; i < 9; ++i) {
                next[i / 3][i % 3] = 0;
                for (int k = 0; k < 3; ++k) {
                    next[i / 3][i % 3] += r[i / 3][k] * g[k][i % 3] / 2;
                }
            }
            std::copy(&next[0][0], &next[0][0] + 9, &r[0][0]);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            rows[i] = {r[i][0], r[i][1], r[i][2]};
        }
        shift = V{pose[3], pose[7], pose[11]} - origin;
    }
    V operator()(const double *p) const {
        const V v = {p[0], p[1], p[2]};
        return V{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)} + shift;
    }
};

struct Answer {
    Real distance = infinity;
    Real depth = 0;
};

// The distance of two soups, as far as it is at most `limit`; beyond, some distance above it or
// infinity. Firm intersections are looked for until one is deeper than `firm`.
inline Answer distance_up_to(const Soup &a, const Soup &b, Real limit, Real firm) {
    Answer best;
    for (std::size_t i = 0; i < a.triangles.size() && best.depth <= firm; ++i) {
        if (static_cast<Real>(apart(a.balls[i], b.whole)) > limit) {
            continue;
        }
        for (std::size_t j = 0; j < b.triangles.size(); ++j) {
            if (static_cast<Real>(apart(a.balls[i], b.balls[j])) > limit) {
                continue;
            }
            const Gap g = triangles(a.triangles[i], b.triangles[j]);
            best.distance = std::min(best.distance, g.distance);
            best.depth = std::max(best.depth, g.depth);
            limit = std::min(limit, best.distance);
        }
    }
    return best;
}

// The distance of two soups. `guess` saves time and nothing else: where it was too low the search
// is made without it.
inline Answer distance(const Soup &a, const Soup &b, Real guess, Real firm) {
    const Answer found = distance_up_to(a, b, guess, firm);
    return found.distance > guess ? distance_up_to(a, b, infinity, firm) : found;
}

using Labels = std::pair<std::uint32_t, std::uint32_t>;

// All pairs of labels whose triangles come within epsilon, with their distances.
inline std::map<Labels, Real> within(const Soup &a, const Soup &b, Real epsilon) {
    std::map<Labels, Real> found;
    for (std::size_t i = 0; i < a.triangles.size(); ++i) {
        if (static_cast<Real>(apart(a.balls[i], b.whole)) > epsilon) {
            continue;
        }
        for (std::size_t j = 0; j < b.triangles.size(); ++j) {
            if (static_cast<Real>(apart(a.balls[i], b.balls[j])) > epsilon) {
                continue;
            }
            const Real d = triangles(a.triangles[i], b.triangles[j]).distance;
            if (d <= epsilon) {
                const auto it = found.emplace(Labels{a.labels[i], b.labels[j]}, d).first;
                it->second = std::min(it->second, d);
            }
        }
    }
    return found;
}

// How far a point is from the triangles with this label.
inline Real off(const Soup &s, std::uint32_t label, V p) {
    Real best = infinity;
    for (std::size_t i = 0; i < s.triangles.size(); ++i) {
        if (s.labels[i] == label) {
            best = std::min(best, point_triangle(p, s.triangles[i]));
        }
    }
    return best;
}

} // namespace truth

#endif
