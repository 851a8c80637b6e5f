// Poses and meshes as Coal holds them.
#pragma once

#include "soup.h"

#include <coal/BVH/BVH_model.h>

#include <memory>
#include <stdexcept>

namespace peers {

inline coal::Transform3s pose(const double *numbers) {
    coal::Matrix3s rotation;
    coal::Vec3s translation;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) rotation(row, column) = numbers[4 * row + column];
        translation[row] = numbers[4 * row + 3];
    }
    return coal::Transform3s(rotation, translation);
}

// All meshes in one.
template <class BV>
std::shared_ptr<coal::BVHModel<BV>> model(const peer_mesh *meshes, std::size_t count) {
    const Soup<coal::Vec3s, coal::Triangle> soup(meshes, count);
    auto model = std::make_shared<coal::BVHModel<BV>>();
    model->beginModel(static_cast<unsigned>(soup.triangles.size()), static_cast<unsigned>(soup.vertices.size()));
    model->addSubModel(soup.vertices, soup.triangles);
    if (model->endModel() != coal::BVH_OK) throw std::runtime_error("Coal did not build a model");
    model->computeLocalAABB();
    return model;
}

}  // namespace peers
