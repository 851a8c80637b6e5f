// Bodies as FCL holds them, and where they are placed.
#pragma once

#include "fcl_templates.h"
#include "scenes.hpp"

#include <cstddef>
#include <memory>
#include <vector>

using Transform = fcl::Transform3<double>;
using Vector = fcl::Vector3<double>;
using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;

inline Transform transform(const cstk::Pose &pose) {
    Transform made = Transform::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            made.linear()(row, column) = pose[static_cast<std::size_t>(4 * row + column)];
        }
        made.translation()[row] = pose[static_cast<std::size_t>(4 * row + 3)];
    }
    return made;
}

inline std::vector<Transform> transforms(const std::vector<cstk::Pose> &poses) {
    std::vector<Transform> made;
    for (const cstk::Pose &pose : poses) {
        made.push_back(transform(pose));
    }
    return made;
}

template <class BV> Geometry model_of(const models::Mesh &mesh) {
    auto made = std::make_shared<fcl::BVHModel<BV>>();
    std::vector<Vector> vertices;
    for (const models::Point &p : mesh.vertices) {
        vertices.emplace_back(p[0], p[1], p[2]);
    }
    std::vector<fcl::Triangle> triangles;
    for (const models::Triangle &t : mesh.triangles) {
        triangles.emplace_back(t[0], t[1], t[2]);
    }
    made->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    made->addSubModel(vertices, triangles);
    made->endModel();
    made->computeLocalAABB();
    return made;
}

inline Geometry box_of(const models::Mesh &mesh) {
    Vector half = Vector::Zero();
    for (const models::Point &p : mesh.vertices) {
        half = half.cwiseMax(Vector(p[0], p[1], p[2]));
    }
    auto made = std::make_shared<fcl::Box<double>>(2 * half);
    made->computeLocalAABB();
    return made;
}

// A link or an object, by its number.
class Placed : public fcl::CollisionObject<double> {
  public:
    Placed(const Geometry &geometry, const models::Mesh &mesh, std::size_t number)
        : CollisionObject(geometry), mesh(mesh), number(number) {}

    void place(const Transform &pose) {
        setTransform(pose);
        computeAABB();
    }
    void grow(double by) { aabb.expand(Vector::Constant(by)); }

    const models::Mesh &mesh;
    const std::size_t number;
};
