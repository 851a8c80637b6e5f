#include "measure.hpp"

#include <fcl/fcl.h>

#include <memory>

namespace {

template <class Volume>
Built build_of(const char *way, const Mesh &mesh, int times) {
    return measured("FCL", way, mesh, times, [&] {
        std::vector<fcl::Vector3d> vertices;
        std::vector<fcl::Triangle> triangles;
        vertices.reserve(mesh.vertices.size());
        triangles.reserve(mesh.triangles.size());
        for (const auto &v : mesh.vertices) {
            vertices.emplace_back(v[0], v[1], v[2]);
        }
        for (const auto &t : mesh.triangles) {
            triangles.emplace_back(t[0], t[1], t[2]);
        }
        auto model = std::make_unique<fcl::BVHModel<Volume>>();
        model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
        model->addSubModel(vertices, triangles);
        model->endModel();
        model->computeLocalAABB();
        return model;
    });
}

} // namespace

std::vector<Built> fcl_builds(const Mesh &mesh, int times) {
    return {build_of<fcl::OBBd>("OBB", mesh, times), build_of<fcl::RSSd>("RSS", mesh, times),
            build_of<fcl::OBBRSSd>("OBBRSS", mesh, times),
            build_of<fcl::kIOSd>("kIOS", mesh, times)};
}
