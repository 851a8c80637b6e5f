// Poses and meshes as FCL holds them.
#pragma once

#include "fcl_templates.h"
#include "soup.h"

#include <memory>
#include <stdexcept>

namespace peers {

inline fcl::Transform3<double> pose(const double *numbers) {
    auto pose = fcl::Transform3<double>::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) pose.linear()(row, column) = numbers[4 * row + column];
        pose.translation()[row] = numbers[4 * row + 3];
    }
    return pose;
}

// All meshes in one.
template <class BV>
std::shared_ptr<fcl::BVHModel<BV>> model(const peer_mesh *meshes, std::size_t count) {
    const Soup<fcl::Vector3<double>, fcl::Triangle> soup(meshes, count);
    auto model = std::make_shared<fcl::BVHModel<BV>>();
    model->beginModel(static_cast<int>(soup.triangles.size()), static_cast<int>(soup.vertices.size()));
    model->addSubModel(soup.vertices, soup.triangles);
    if (model->endModel() != fcl::BVH_OK) throw std::runtime_error("FCL did not build a model");
    model->computeLocalAABB();
    return model;
}

}  // namespace peers
