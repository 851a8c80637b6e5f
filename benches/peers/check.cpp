// Compares every variant of a peer with brute force over small random meshes: apart, barely apart, touching, overlapping.
//
//   check_peers libfcl_peer.so fcl [seed [scenes]]
#include "peers.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

using Real = long double;
using Point = std::array<Real, 3>;
using Triangle = std::array<Point, 3>;

Point minus(const Point &one, const Point &other) { return {one[0] - other[0], one[1] - other[1], one[2] - other[2]}; }
Point along(const Point &start, const Point &step, Real part) {
    return {start[0] + part * step[0], start[1] + part * step[1], start[2] + part * step[2]};
}
Real dot(const Point &one, const Point &other) {
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
}
Point cross(const Point &one, const Point &other) {
    return {one[1] * other[2] - one[2] * other[1], one[2] * other[0] - one[0] * other[2],
            one[0] * other[1] - one[1] * other[0]};
}
Real clamp(Real value) { return std::min<Real>(1, std::max<Real>(0, value)); }

Real segment_squared(const Point &start, const Point &end, const Point &point) {
    Point step = minus(end, start);
    Real length = dot(step, step);
    Real part = length > 0 ? clamp(dot(minus(point, start), step) / length) : 0;
    Point gap = minus(point, along(start, step, part));
    return dot(gap, gap);
}

// The least of the four ends against the other segment and, where it lies within both, of the lines.
Real segments_squared(const Point &a, const Point &b, const Point &c, const Point &d) {
    Real best = std::min(std::min(segment_squared(a, b, c), segment_squared(a, b, d)),
                         std::min(segment_squared(c, d, a), segment_squared(c, d, b)));
    Point one = minus(b, a), other = minus(d, c), between = minus(c, a), normal = cross(one, other);
    Real size = dot(normal, normal);
    if (size <= 0) return best;
    Real part = dot(cross(between, other), normal) / size, opposite = dot(cross(between, one), normal) / size;
    if (part < 0 || part > 1 || opposite < 0 || opposite > 1) return best;
    Real height = dot(between, normal);
    return std::min(best, height * height / size);
}

// Whether the point's foot on the plane lies inside the triangle, and its height.
bool foot_inside(const Triangle &triangle, const Point &point) {
    Point normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    for (int corner = 0; corner < 3; ++corner) {
        Point edge = minus(triangle[(corner + 1) % 3], triangle[corner]);
        if (dot(cross(edge, minus(point, triangle[corner])), normal) < 0) return false;
    }
    return dot(normal, normal) > 0;
}

Real triangles_squared(const Triangle &one, const Triangle &other) {
    Real best = std::numeric_limits<Real>::infinity();
    for (int first = 0; first < 3; ++first)
        for (int second = 0; second < 3; ++second)
            best = std::min(best, segments_squared(one[first], one[(first + 1) % 3], other[second],
                                                   other[(second + 1) % 3]));
    for (int side = 0; side < 2; ++side) {
        const Triangle &face = side ? other : one, &edges = side ? one : other;
        Point normal = cross(minus(face[1], face[0]), minus(face[2], face[0]));
        Real size = dot(normal, normal);
        if (size <= 0) continue;
        for (int corner = 0; corner < 3; ++corner) {
            const Point &start = edges[corner], &end = edges[(corner + 1) % 3];
            Real height = dot(minus(start, face[0]), normal), next = dot(minus(end, face[0]), normal);
            if (foot_inside(face, start)) best = std::min(best, height * height / size);
            if ((height < 0) == (next < 0) || height == next) continue;
            if (foot_inside(face, along(start, minus(end, start), height / (height - next)))) return 0;
        }
    }
    return best;
}

struct Mesh {
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;
    peer_mesh view() const { return {vertices.data(), vertices.size() / 3, triangles.data(), triangles.size() / 3}; }
};

std::vector<Triangle> placed(const Mesh &mesh, const double *pose) {
    std::vector<Triangle> list;
    for (std::size_t at = 0; at < mesh.triangles.size(); at += 3) {
        Triangle triangle;
        for (int corner = 0; corner < 3; ++corner) {
            const double *vertex = &mesh.vertices[3 * mesh.triangles[at + corner]];
            for (int row = 0; row < 3; ++row)
                triangle[corner][row] = pose ? Real(pose[4 * row]) * vertex[0] + Real(pose[4 * row + 1]) * vertex[1] +
                                                   Real(pose[4 * row + 2]) * vertex[2] + pose[4 * row + 3]
                                             : Real(vertex[row]);
        }
        list.push_back(triangle);
    }
    return list;
}

std::mt19937_64 generator;
double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }

// A box or a rough ball, the latter with the odd sliver.
Mesh body(double x, double y, double z, double size) {
    Mesh mesh;
    if (generator() % 3 == 0) {
        double half[3] = {size * uniform(0.2, 1), size * uniform(0.2, 1), size * uniform(0.2, 1)};
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                mesh.vertices.push_back((axis == 0 ? x : axis == 1 ? y : z) +
                                        (corner >> axis & 1 ? half[axis] : -half[axis]));
        mesh.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                          2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
        return mesh;
    }
    const int rings = 5, sides = 7;
    for (int ring = 0; ring <= rings; ++ring)
        for (int side = 0; side < sides; ++side) {
            double polar = M_PI * (ring + 0.01) / (rings + 0.02), turn = 2 * M_PI * side / sides;
            double radius = size * uniform(0.6, 1);
            mesh.vertices.push_back(x + radius * std::sin(polar) * std::cos(turn));
            mesh.vertices.push_back(y + radius * std::sin(polar) * std::sin(turn));
            mesh.vertices.push_back(z + radius * std::cos(polar));
        }
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            std::uint32_t a = ring * sides + side, b = ring * sides + (side + 1) % sides, c = a + sides, d = b + sides;
            mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
        }
    return mesh;
}

void random_pose(double *pose, double spread) {
    double turn[4], length = 0;
    for (double &part : turn) {
        part = std::normal_distribution<double>()(generator);
        length += part * part;
    }
    for (double &part : turn) part /= std::sqrt(length);
    double w = turn[0], x = turn[1], y = turn[2], z = turn[3];
    double rows[12] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), uniform(-spread, spread),
                       2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), uniform(-spread, spread),
                       2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), uniform(-spread, spread)};
    std::copy(rows, rows + 12, pose);
}

struct Peer {
    int (*count)(int);
    int (*serves)(int, int);
    const char *(*name)(int);
    void *(*scene)(const peer_mesh *, size_t, const peer_mesh *, size_t, int);
    void (*free)(void *);
    double (*run)(void *, int, double, const double *, size_t, double *);
};

template <class Function>
void load(void *library, const std::string &name, Function &function) {
    function = reinterpret_cast<Function>(dlsym(library, name.c_str()));
    if (!function) std::fprintf(stderr, "no %s\n", name.c_str()), std::exit(1);
}

struct Tally {
    long asked = 0, wrong = 0, zeros = 0;  // zeros: 0 for bodies which are apart
    Real worst = 0, worst_truth = 0;
    double seconds = 0;
};

}  // namespace

int main(int count, char **words) {
    if (count < 3) return std::fprintf(stderr, "check_peers library prefix [seed [scenes]]\n"), 1;
    void *library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) return std::fprintf(stderr, "%s\n", dlerror()), 1;
    Peer peer;
    std::string prefix = words[2];
    load(library, prefix + "_variant_count", peer.count);
    load(library, prefix + "_variant_serves", peer.serves);
    load(library, prefix + "_variant_name", peer.name);
    load(library, prefix + "_scene", peer.scene);
    load(library, prefix + "_scene_free", peer.free);
    load(library, prefix + "_run", peer.run);
    generator.seed(count > 3 ? std::atoll(words[3]) : 1);
    int scenes = count > 4 ? std::atoi(words[4]) : 20;

    std::map<std::pair<int, int>, Tally> tallies;
    long apart = 0, near = 0, barely = 0, meeting = 0;
    for (int round = 0; round < scenes; ++round) {
        std::vector<Mesh> links, bodies;
        int link_count = round % 2 ? 3 : 1, body_count = round % 3 ? 5 : 1;
        for (int link = 0; link < link_count; ++link) links.push_back(body(0, 0, 0, uniform(0.1, 0.4)));
        for (int at = 0; at < body_count; ++at)
            bodies.push_back(body(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 0.4)));
        std::vector<peer_mesh> link_views, body_views;
        for (auto &mesh : links) link_views.push_back(mesh.view());
        for (auto &mesh : bodies) body_views.push_back(mesh.view());
        std::vector<std::vector<Triangle>> fixed;
        for (auto &mesh : bodies) fixed.push_back(placed(mesh, nullptr));

        auto truth_of = [&](const double *pose) {
            Real best = std::numeric_limits<Real>::infinity();
            for (int link = 0; link < link_count; ++link)
                for (auto &one : placed(links[link], pose + 12 * link))
                    for (auto &list : fixed)
                        for (auto &other : list) best = std::min(best, triangles_squared(one, other));
            return std::sqrt(best);
        };
        std::vector<double> poses;
        std::vector<Real> truths;
        auto add = [&](const std::vector<double> &pose) {
            poses.insert(poses.end(), pose.begin(), pose.end());
            truths.push_back(truth_of(pose.data()));
        };
        for (int start = 0; start < 6; ++start) {
            std::vector<double> pose(12 * link_count);
            for (int link = 0; link < link_count; ++link) random_pose(&pose[12 * link], 1.5);
            add(pose);
            // Small steps, and a march toward a body which ends at gaps from 1e-2 to 1e-13 and within.
            for (int step = 0; step < 4; ++step) {
                for (int link = 0; link < link_count; ++link)
                    for (int row = 0; row < 3; ++row) pose[12 * link + 4 * row + 3] += uniform(-0.02, 0.02);
                add(pose);
            }
            if (truths.back() <= 0) continue;
            double toward[3], far = 0, length = 0;
            for (int row = 0; row < 3; ++row) {
                toward[row] = bodies[0].vertices[row] - pose[4 * row + 3];
                length += toward[row] * toward[row];
            }
            for (double &part : toward) part /= std::sqrt(length);
            auto moved = [&](double far) {
                std::vector<double> next = pose;
                for (int link = 0; link < link_count; ++link)
                    for (int row = 0; row < 3; ++row) next[12 * link + 4 * row + 3] += far * toward[row];
                return next;
            };
            for (int step = 0; step < 60; ++step) {
                Real gap = truth_of(moved(far).data());
                if (gap < 1e-13 || far > 4) break;
                if (step % 3 == 0 || gap < 1e-3) add(moved(far));
                far += double(gap) * 0.9;
            }
            add(moved(far + 1e-3));
            add(moved(far + 0.05));
        }

        for (Real truth : truths) ++(truth <= 0 ? meeting : truth < 1e-8 ? barely : truth < 1e-2 ? near : apart);
        std::vector<double> answers(truths.size());
        double threshold = 0.05;
        for (int mode = 0; mode < 3; ++mode)
            for (int variant = 0; variant < peer.count(mode); ++variant) {
                if (!peer.serves(variant, mode)) continue;
                Tally &tally = tallies[{mode, variant}];
                void *scene = peer.scene(link_views.data(), link_views.size(), body_views.data(), body_views.size(),
                                         variant);
                double seconds = scene ? peer.run(scene, mode, threshold, poses.data(), truths.size(), answers.data())
                                       : -1;
                if (seconds < 0) std::fill(answers.begin(), answers.end(), NAN);
                if (scene) peer.free(scene);
                tally.seconds += seconds;
                for (std::size_t query = 0; query < truths.size(); ++query) {
                    Real truth = truths[query], wanted = mode == 0 ? truth : mode == 1 ? truth <= threshold : truth <= 0;
                    Real error = std::fabs(answers[query] - wanted);
                    // Booleans count only where rounding cannot excuse them.
                    if (mode == 1 && std::fabs(truth - threshold) < 1e-9) continue;
                    ++tally.asked;
                    if (mode == 0 && answers[query] <= 0 && truth > 0) ++tally.zeros;
                    if (!(error <= (mode == 0 ? 1e-9 : 0))) {
                        ++tally.wrong;
                        if (std::getenv("CHECK_VERBOSE"))
                            std::printf("mode %d %s scene %d query %zu truth %.6Lg answer %.6g\n", mode,
                                        peer.name(variant), round, query, truth, answers[query]);
                    }
                    if (!(error <= tally.worst)) tally.worst = error, tally.worst_truth = truth;
                }
            }
    }
    std::printf("queries: %ld apart, %ld below 1e-2, %ld below 1e-8, %ld meeting\n", apart, near, barely, meeting);
    const char *modes[] = {"distance", "within", "collide"};
    bool right = true;
    for (auto &[key, tally] : tallies) {
        std::printf("%-8s %-24s %7ld asked %5ld wrong %5ld zeros, worst %.2Le where the truth is %.2Le, %8.2f us each\n",
                    modes[key.first], peer.name(key.second), tally.asked, tally.wrong, tally.zeros, tally.worst, tally.worst_truth,
                    1e6 * tally.seconds / tally.asked);
        right = right && tally.wrong == 0;
    }
    return right ? 0 : 2;
}
