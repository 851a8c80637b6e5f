// Distances of pairs of primitives against brute force in long double: families of degenerate pairs,
// the largest error of each in units of L, the pair's largest coordinate.
//
//     accuracy [pairs] [seed]
#include "truth.hpp"

#include <cstk.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

using truth::Real;
using truth::V;

// No error may be larger.
const double promised = 1e-12;

using Point = std::array<double, 3>;

class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(bits_);
    }
    // As many in each decade.
    double decades(double low, double high) {
        return std::pow(10.0, uniform(std::log10(low), std::log10(high)));
    }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(bits_); }
    double sign() { return below(2) ? 1.0 : -1.0; }
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
    std::mt19937_64 bits_;
};

struct Placing {
    cstk::Pose m = cstk::identity();
};

Placing turned(const Point &axis, double angle) {
    const double s = std::sin(angle), c = std::cos(angle), d = 1 - c;
    const auto [x, y, z] = axis;
    Placing p;
    const double rows[3][3] = {{c + x * x * d, x * y * d - z * s, x * z * d + y * s},
                               {y * x * d + z * s, c + y * y * d, y * z * d - x * s},
                               {z * x * d - y * s, z * y * d + x * s, c + z * z * d}};
    for (int i = 0; i < 3; ++i) {
        std::copy(rows[i], rows[i] + 3, p.m.begin() + 4 * i);
    }
    return p;
}

void shift(Placing &p, double x, double y, double z) {
    p.m[3] += x, p.m[7] += y, p.m[11] += z;
}

// A primitive: a flat polygon with its corners in z = 0, or a solid.
struct Primitive {
    std::vector<Point> points;
    bool flat;
    cstk::Body body;
    std::vector<std::vector<std::uint32_t>> faces;
};

std::vector<double> flattened(const std::vector<Point> &points) {
    std::vector<double> made;
    for (const Point &p : points) {
        made.insert(made.end(), p.begin(), p.end());
    }
    return made;
}

Primitive polygon(const std::vector<Point> &corners) {
    cstk::BodyBuilder builder(3);
    builder.add_polygon(flattened(corners));
    Primitive made{corners, true, builder.build(), {}};
    made.faces.resize(1);
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
        made.faces[0].push_back(i);
    }
    return made;
}

// A box or a tetrahedron, whose faces are known without a hull.
Primitive solid(const std::vector<Point> &points) {
    cstk::BodyBuilder builder(3);
    builder.add_polyhedron(flattened(points));
    Primitive made{points, false, builder.build(), {}};
    if (points.size() == 4) {
        made.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    } else {
        made.faces = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                      {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    }
    return made;
}

truth::Soup soup(const Primitive &primitive, const Placing &placing, V origin) {
    const truth::Frame frame(placing.m.data(), origin);
    truth::Soup made;
    for (const auto &face : primitive.faces) {
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
            const auto at = [&](std::size_t k) { return frame(primitive.points[face[k]].data()); };
            made.triangles.push_back({at(0), at(i), at(i + 1)});
            made.labels.push_back(0);
        }
    }
    made.bound();
    return made;
}

// Whether a point is in a solid: on the inner side of every face, as its middle is.
bool holds(const Primitive &solid, const truth::Soup &placed, V p) {
    if (solid.flat) {
        return false;
    }
    V middle = {0, 0, 0};
    for (const auto &t : placed.triangles) {
        middle = middle + (1.0L / (3 * placed.triangles.size())) * (t[0] + t[1] + t[2]);
    }
    for (const auto &t : placed.triangles) {
        const V n = truth::cross(t[1] - t[0], t[2] - t[0]);
        if (truth::dot(n, p - t[0]) * truth::dot(n, middle - t[0]) < 0) {
            return false;
        }
    }
    return true;
}

struct Pair {
    Primitive a, b;
    Placing at_a, at_b;
};

std::vector<Point> corners(Random &random, double size, double width) {
    const int count = 3 + random.below(4);
    std::vector<Point> made;
    const double turn = random.uniform(0, 6);
    for (int i = 0; i < count; ++i) {
        const double angle = turn + (i + random.uniform(0, 0.4)) / count * 2 * std::acos(-1.0);
        made.push_back({size * std::cos(angle), width * std::sin(angle), 0});
    }
    return made;
}

std::vector<Point> tetrahedron(Random &random, double flatness) {
    std::vector<Point> made;
    for (int i = 0; i < 4; ++i) {
        made.push_back({random.uniform(-1, 1), random.uniform(-1, 1),
                        flatness * random.uniform(-1, 1)});
    }
    made[3][2] = made[0][2] + flatness * (1 + random.uniform(0, 1)) * random.sign();
    return made;
}

std::vector<Point> box(Random &random) {
    const Point half = {random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1)};
    std::vector<Point> made;
    for (int i = 0; i < 8; ++i) {
        made.push_back({i & 4 ? half[0] : -half[0], i & 2 ? half[1] : -half[1],
                        i & 1 ? half[2] : -half[2]});
    }
    return made;
}

Placing anywhere(Random &random, double reach) {
    Placing p = turned(random.direction(), random.uniform(-3.2, 3.2));
    shift(p, random.uniform(-reach, reach), random.uniform(-reach, reach),
          random.uniform(-reach, reach));
    return p;
}

struct Family {
    const char *name;
    double weight;
    std::function<Pair(Random &)> make;
};

const std::vector<Family> families = {
    {"polygons at random", 2,
     [](Random &r) {
         return Pair{polygon(corners(r, 1, 1)), polygon(corners(r, 1, 1)), anywhere(r, 1),
                     anywhere(r, 1.5)};
     }},
    {"polygons in one plane", 2,
     [](Random &r) {
         Placing b = turned({0, 0, 1}, r.uniform(-3, 3));
         shift(b, r.uniform(-3, 3), r.uniform(-3, 3), 0);
         return Pair{polygon(corners(r, 1, 1)), polygon(corners(r, 1, 1)), Placing(), b};
     }},
    {"parallel polygons, 1e-15 to 1 apart", 2,
     [](Random &r) {
         Placing b = turned({0, 0, 1}, r.uniform(-3, 3));
         shift(b, r.uniform(-2, 2), r.uniform(-2, 2), r.sign() * r.decades(1e-15, 1));
         return Pair{polygon(corners(r, 1, 1)), polygon(corners(r, 1, 1)), Placing(), b};
     }},
    {"polygons tilted by 1e-16 to 1e-2", 2,
     [](Random &r) {
         Placing b = turned(r.direction(), r.sign() * r.decades(1e-16, 1e-2));
         shift(b, r.uniform(-2, 2), r.uniform(-2, 2), r.sign() * r.decades(1e-15, 1e-1));
         return Pair{polygon(corners(r, 1, 1)), polygon(corners(r, 1, 1)), Placing(), b};
     }},
    {"slivers, down to 1e-9 wide", 2,
     [](Random &r) {
         return Pair{polygon(corners(r, 1, r.decades(1e-9, 1e-1))),
                     polygon(corners(r, 1, r.decades(1e-9, 1e-1))), anywhere(r, 0.5),
                     anywhere(r, 0.5)};
     }},
    {"slivers side by side", 1,
     [](Random &r) {
         Placing b = turned(r.direction(), r.sign() * r.decades(1e-15, 1e-3));
         shift(b, r.uniform(-1, 1), r.sign() * r.decades(1e-12, 1e-1), r.decades(1e-15, 1e-1));
         return Pair{polygon(corners(r, 1, r.decades(1e-9, 1e-2))),
                     polygon(corners(r, 1, r.decades(1e-9, 1e-2))), Placing(), b};
     }},
    {"a tiny polygon at a large one", 1,
     [](Random &r) {
         Placing b = anywhere(r, 1);
         b.m[11] = r.sign() * r.decades(1e-15, 1e-2);
         const double small = r.decades(1e-9, 1e-2);
         return Pair{polygon(corners(r, 1, 1)), polygon(corners(r, small, small)), Placing(), b};
     }},
    {"far from the origin, by up to 1e6", 1,
     [](Random &r) {
         Placing a = anywhere(r, 1), b = anywhere(r, 1.5);
         const double far = r.decades(1, 1e6);
         const auto d = r.direction();
         shift(a, far * d[0], far * d[1], far * d[2]);
         shift(b, far * d[0], far * d[1], far * d[2]);
         return Pair{polygon(corners(r, 1, 1)), polygon(corners(r, 1, 1)), a, b};
     }},
    {"boxes at random", 1,
     [](Random &r) {
         return Pair{solid(box(r)), solid(box(r)), anywhere(r, 1), anywhere(r, 2)};
     }},
    {"boxes turned alike, nearly touching", 2,
     [](Random &r) {
         Pair made{solid(box(r)), solid(box(r)), Placing(), Placing()};
         const int axis = r.below(3);
         const Point &a = made.a.points[7], &b = made.b.points[7];
         double t[3];
         for (int k = 0; k < 3; ++k) {
             t[k] = k == axis ? a[k] + b[k] + r.sign() * r.decades(1e-16, 1e-3)
                              : r.uniform(-1, 1) * (a[k] + b[k]);
         }
         made.at_b = turned(r.direction(), r.below(2) ? 0 : r.sign() * r.decades(1e-16, 1e-6));
         shift(made.at_b, t[0], t[1], t[2]);
         return made;
     }},
    {"tetrahedra, down to 1e-6 flat", 2,
     [](Random &r) {
         return Pair{solid(tetrahedron(r, r.decades(1e-6, 1))),
                     solid(tetrahedron(r, r.decades(1e-6, 1))), anywhere(r, 0.6), anywhere(r, 1.2)};
     }},
    {"a polygon on a box's face", 1,
     [](Random &r) {
         Pair made{polygon(corners(r, 1, r.decades(1e-6, 1))), solid(box(r)), Placing(), Placing()};
         shift(made.at_b, r.uniform(-1, 1), r.uniform(-1, 1),
               r.sign() * (made.b.points[7][2] + r.sign() * r.decades(1e-16, 1e-2)));
         return made;
     }},
};

int main(int argc, char **argv) {
    const long pairs = argc > 1 ? std::atol(argv[1]) : 50000;
    Random random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    double weights = 0;
    for (const Family &family : families) {
        weights += family.weight;
    }
    std::printf("| family | pairs | meet | largest error, L | largest error of lower, upper |\n");
    std::printf("| --- | --- | --- | --- | --- |\n");
    cstk::Query query;
    long all = 0, wrong = 0;
    double worst = 0;
    for (const Family &family : families) {
        const long count = static_cast<long>(std::ceil(pairs * family.weight / weights));
        long meet = 0;
        double largest = 0, outside = 0;
        for (long i = 0; i < count; ++i) {
            const Pair pair = family.make(random);
            const V origin = {pair.at_a.m[3], pair.at_a.m[7], pair.at_a.m[11]};
            const truth::Soup a = soup(pair.a, pair.at_a, origin);
            const truth::Soup b = soup(pair.b, pair.at_b, origin);
            Real size = 0;
            for (const auto *s : {&a, &b}) {
                for (const auto &t : s->triangles) {
                    for (const V p : t) {
                        size = std::max(size, truth::length(p));
                    }
                }
            }
            truth::Answer want = truth::distance_up_to(a, b, truth::infinity, truth::infinity);
            if (holds(pair.a, a, b.triangles[0][0]) || holds(pair.b, b, a.triangles[0][0])) {
                want.distance = 0;
            }
            const cstk_distance_result d =
                query.pair_distance(pair.a.body, pair.at_a.m, pair.b.body, pair.at_b.m);
            const double error = static_cast<double>(std::fabs(d.distance - want.distance) / size);
            largest = std::max(largest, error);
            const Real beyond = std::max(d.lower - want.distance, want.distance - d.upper);
            outside = std::max(outside, static_cast<double>(beyond / size));
            meet += d.distance == 0;
            // The brute force itself rounds at about 1e-19 L.
            const bool is_wrong = error > promised || beyond > 1e-18L * size;
            if (is_wrong && ++wrong <= 10) {
                std::printf("FAILED: %s, pair %ld: %.17g in [%.17g, %.17g] for %.17Lg\n",
                            family.name, i, d.distance, d.lower, d.upper, want.distance);
            }
        }
        all += count;
        worst = std::max(worst, largest);
        std::printf("| %s | %ld | %ld | %.1e | %.1e |\n", family.name, count, meet, largest,
                    outside);
        std::fflush(stdout);
    }
    std::printf("\naccuracy: %ld pairs, largest error %.1e L, %ld above %.0e L or outside their bounds\n",
                all, worst, wrong, promised);
    return wrong > 0;
}
