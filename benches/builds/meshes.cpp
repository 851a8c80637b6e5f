#include "meshes.hpp"

#include <cmath>
#include <random>

namespace {

constexpr double pi = 3.14159265358979323846;

/// Appends a sphere of `2 * rings` sectors, whose radius `radius_at` tells by angles.
template <class Radius>
void append_sphere(Mesh &mesh, std::size_t rings, const std::array<double, 3> &center,
                   const Radius &radius_at) {
    const std::size_t sectors = 2 * rings;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i <= rings; ++i) {
        for (std::size_t j = 0; j < sectors; ++j) {
            // A little off the poles, so that no triangle is without area.
            const double down = pi * (i + 1e-4) / (rings + 2e-4);
            const double around = 2 * pi * j / sectors;
            const double radius = radius_at(down, around);
            mesh.vertices.push_back({center[0] + radius * std::sin(down) * std::cos(around),
                                     center[1] + radius * std::sin(down) * std::sin(around),
                                     center[2] + radius * std::cos(down)});
        }
    }
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t j = 0; j < sectors; ++j) {
            const auto at = [&](std::size_t ring, std::size_t sector) {
                return static_cast<std::uint32_t>(first + ring * sectors + sector % sectors);
            };
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    }
}

/// Rings of a sphere of so many triangles.
std::size_t rings_of(std::size_t triangles) {
    return static_cast<std::size_t>(std::lround(std::sqrt(triangles / 4.0)));
}

} // namespace

Mesh bumpy_sphere(std::size_t triangles) {
    Mesh mesh;
    append_sphere(mesh, rings_of(triangles), {0, 0, 0}, [](double down, double around) {
        return 0.5 + 0.03 * std::sin(9 * down) * std::cos(11 * around);
    });
    return mesh;
}

Mesh balls_on_a_floor(std::size_t triangles, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const std::size_t rings = rings_of(1000);
    while (mesh.triangles.size() + 4 * rings * rings <= triangles) {
        const double radius = 0.05 * std::pow(1e-3, unit(random));
        append_sphere(mesh, rings, {unit(random), unit(random), radius},
                      [&](double, double) { return radius; });
    }
    return mesh;
}

Mesh soup(std::size_t triangles, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const double size = std::cbrt(1.0 / triangles);
    Mesh mesh;
    for (std::size_t i = 0; i < triangles; ++i) {
        const std::array<double, 3> at = {unit(random), unit(random), unit(random)};
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int k = 0; k < 3; ++k) {
            mesh.vertices.push_back({at[0] + size * unit(random), at[1] + size * unit(random),
                                     at[2] + size * unit(random)});
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}
