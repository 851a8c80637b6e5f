// FCL's and Coal's models of triangles, which are built alike.
#pragma once

#include "measure.hpp"

#include <memory>

/// `Model` is a BVHModel of a volume.
template <class Model, class Vector, class Triangle>
Built model_build(const char *library, const char *way, const Mesh &mesh, int times) {
    return measured(library, way, mesh, times, [&] {
        std::vector<Vector> vertices;
        std::vector<Triangle> triangles;
        vertices.reserve(mesh.vertices.size());
        triangles.reserve(mesh.triangles.size());
        for (const auto &v : mesh.vertices) {
            vertices.emplace_back(v[0], v[1], v[2]);
        }
        for (const auto &t : mesh.triangles) {
            triangles.emplace_back(t[0], t[1], t[2]);
        }
        auto model = std::make_unique<Model>();
        model->beginModel(triangles.size(), vertices.size());
        model->addSubModel(vertices, triangles);
        model->endModel();
        model->computeLocalAABB();
        return model;
    });
}
