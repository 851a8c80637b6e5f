#include "measure.hpp"

#include <coal/BVH/BVH_model.h>

#include <memory>

namespace {

template <class Volume>
Built build_of(const char *way, const Mesh &mesh, int times) {
    return measured("Coal", way, mesh, times, [&] {
        std::vector<coal::Vec3s> vertices;
        std::vector<coal::Triangle> triangles;
        vertices.reserve(mesh.vertices.size());
        triangles.reserve(mesh.triangles.size());
        for (const auto &v : mesh.vertices) {
            vertices.emplace_back(v[0], v[1], v[2]);
        }
        for (const auto &t : mesh.triangles) {
            triangles.emplace_back(t[0], t[1], t[2]);
        }
        auto model = std::make_unique<coal::BVHModel<Volume>>();
        model->beginModel(static_cast<unsigned>(triangles.size()), static_cast<unsigned>(vertices.size()));
        model->addSubModel(vertices, triangles);
        model->endModel();
        model->computeLocalAABB();
        return model;
    });
}

} // namespace

std::vector<Built> coal_builds(const Mesh &mesh, int times) {
    return {build_of<coal::OBB>("OBB", mesh, times), build_of<coal::RSS>("RSS", mesh, times),
            build_of<coal::OBBRSS>("OBBRSS", mesh, times),
            build_of<coal::kIOS>("kIOS", mesh, times)};
}
