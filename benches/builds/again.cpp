#include "measure.hpp"

#include <cstk.hpp>

#include <cmath>

namespace {

using Seconds = std::chrono::duration<double>;

void add_mesh(const cstk::BodyBuilder &builder, const Mesh &mesh, const cstk::Pose &pose) {
    cstk::check(cstk_body_builder_add_mesh(builder.get(), mesh.vertices.front().data(), mesh.vertices.size(), nullptr,
                                           mesh.triangles.size(), mesh.triangles.front().data(),
                                           3 * mesh.triangles.size(), pose.data(), nullptr));
}

cstk::BodyBuilder builder_of(const Mesh &mesh) {
    cstk::BodyBuilder builder;
    add_mesh(builder, mesh, cstk::identity());
    return builder;
}

/// The least time of several calls.
template <class Call> double least(int times, const Call &call) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < times; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const cstk::Body body = call();
        const Seconds took = std::chrono::steady_clock::now() - start;
        least = std::min(least, took.count());
    }
    return least;
}

/// Places of a grid, each turned about the vertical.
std::vector<cstk::Pose> places(int count) {
    std::vector<cstk::Pose> all;
    for (int i = 0; i < count; ++i) {
        const double angle = 0.7 * i;
        all.push_back({std::cos(angle), -std::sin(angle), 0, 3.0 * (i % 7), std::sin(angle),
                       std::cos(angle), 0, 3.0 * (i / 7), 0, 0, 1, 0});
    }
    return all;
}

/// The largest difference of distances to a small body at many places.
double largest_difference(const cstk::Body &a, const cstk::Body &b) {
    const cstk::Body probe = cstk::BodyBuilder().add_sphere({0, 0, 0}, 0.1).build();
    cstk::Query query;
    double largest = 0;
    for (int i = 0; i < 200; ++i) {
        const cstk::Pose at = cstk::translation(20 * std::sin(1.3 * i), 20 * std::cos(0.7 * i), std::sin(3.1 * i));
        double found[2];
        int k = 0;
        for (const cstk::Body *body : {&a, &b}) {
            cstk_distance_result out;
            cstk::check(cstk_pair_distance(query.get(), body->get(), cstk::identity().data(), probe.get(),
                                           at.data(), std::numeric_limits<double>::infinity(), &out));
            found[k++] = out.distance;
        }
        largest = std::max(largest, std::abs(found[0] - found[1]));
    }
    return largest;
}

} // namespace

Again built_of_parts(const Mesh &mesh, int count, int times) {
    const cstk::Body part = builder_of(mesh).build();
    const std::vector<cstk::Pose> poses = places(count);
    const auto flat = [&] {
        const cstk::BodyBuilder builder;
        for (const cstk::Pose &pose : poses) {
            add_mesh(builder, mesh, pose);
        }
        return builder.build();
    };
    const auto whole = [&] {
        cstk::BodyBuilder builder;
        for (const cstk::Pose &pose : poses) {
            builder.add_body(part, pose);
        }
        return builder.build();
    };
    Again again;
    again.build = least(times, flat);
    again.again = least(times, whole);
    const double before = bytes_in_use();
    const cstk::Body anew = flat();
    const double between = bytes_in_use();
    const cstk::Body composed = whole();
    again.bytes = (between - before) / (static_cast<double>(count) * mesh.triangles.size());
    again.bytes_again = (bytes_in_use() - between) / (static_cast<double>(count) * mesh.triangles.size());
    again.difference = largest_difference(anew, composed);
    return again;
}

Again refitted(const Mesh &mesh, int times) {
    const cstk::Body body = builder_of(mesh).build();
    Mesh moved = mesh;
    for (auto &p : moved.vertices) {
        const double factor = 1 + 0.2 * std::sin(5 * p[0]) * std::cos(4 * p[1]);
        p = {factor * p[0], factor * p[1], factor * p[2]};
    }
    std::vector<double> xyz;
    for (const auto &triangle : moved.triangles) {
        for (const std::uint32_t i : triangle) {
            xyz.insert(xyz.end(), moved.vertices[i].begin(), moved.vertices[i].end());
        }
    }
    Again again;
    again.build = least(times, [&] { return builder_of(moved).build(); });
    again.again = least(times, [&] { return body.refit(xyz); });
    const double before = bytes_in_use();
    const cstk::Body anew = builder_of(moved).build();
    const double between = bytes_in_use();
    const cstk::Body same = body.refit(xyz);
    again.bytes = (between - before) / mesh.triangles.size();
    again.bytes_again = (bytes_in_use() - between) / mesh.triangles.size();
    again.difference = largest_difference(anew, same);
    return again;
}
