// Poses and surfaces as FCL holds them.
#pragma once

#include "fcl_templates.h"
#include "surface.hpp"

#include <memory>
#include <vector>

inline fcl::Transform3<double> fcl_pose(const cstk::Pose &pose) {
    auto made = fcl::Transform3<double>::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            made.linear()(row, column) = pose[static_cast<std::size_t>(4 * row + column)];
        }
        made.translation()[row] = pose[static_cast<std::size_t>(4 * row + 3)];
    }
    return made;
}

template <class BV> std::shared_ptr<fcl::BVHModel<BV>> fcl_mesh(const Surface &surface) {
    std::vector<fcl::Vector3<double>> vertices;
    for (std::size_t i = 0; i < surface.vertices.size(); i += 3) {
        vertices.emplace_back(surface.vertices[i], surface.vertices[i + 1],
                              surface.vertices[i + 2]);
    }
    std::vector<fcl::Triangle> triangles;
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
        triangles.emplace_back(surface.triangles[i], surface.triangles[i + 1],
                               surface.triangles[i + 2]);
    }
    auto made = std::make_shared<fcl::BVHModel<BV>>();
    made->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    made->addSubModel(vertices, triangles);
    made->endModel();
    made->computeLocalAABB();
    return made;
}
