// Shapes in a library's own types, which FCL and Coal name and make alike.
#pragma once

#include "shapes.h"

#include <octomap/OcTree.h>

#include <memory>
#include <stdexcept>
#include <utility>

namespace peers {

// What a mesh is wrapped in; none for pairs without meshes.
enum Volume { none, obb, rss, obbrss, kios };

const std::pair<Volume, const char *> volumes[] = {
    {none, ""}, {obb, "OBB "}, {rss, "RSS "}, {obbrss, "OBBRSS "}, {kios, "kIOS "}};

// The points of a cloud as occupied voxels.
inline std::shared_ptr<octomap::OcTree> voxels(const peer_shape &cloud) {
    auto tree = std::make_shared<octomap::OcTree>(cloud.sizes[0]);
    for (std::size_t at = 0; at < cloud.surface.vertex_count; ++at) {
        const double *p = cloud.surface.vertices + 3 * at;
        tree->updateNode(octomap::point3d(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                          static_cast<float>(p[2])),
                         true, true);
    }
    tree->updateInnerOccupancy();
    tree->prune();
    return tree;
}

// `Library` has the types of shapes and volumes, and makes hulls and meshes.
template <class Library>
typename Library::Geometry mesh_geometry(const peer_mesh &surface, Volume volume) {
    switch (volume) {
    case obb:
        return Library::template mesh<typename Library::OBB>(surface);
    case rss:
        return Library::template mesh<typename Library::RSS>(surface);
    case kios:
        return Library::template mesh<typename Library::kIOS>(surface);
    default:
        return Library::template mesh<typename Library::OBBRSS>(surface);
    }
}

template <class Library>
typename Library::Geometry bare_geometry(const peer_shape &shape, Volume volume) {
    const double *s = shape.sizes;
    switch (shape.kind) {
    case PEER_SPHERE:
        return std::make_shared<typename Library::Sphere>(s[0]);
    case PEER_CAPSULE:
        return std::make_shared<typename Library::Capsule>(s[0], s[1]);
    case PEER_BOX:
        return std::make_shared<typename Library::Box>(2 * s[0], 2 * s[1], 2 * s[2]);
    case PEER_CYLINDER:
        return std::make_shared<typename Library::Cylinder>(s[0], s[1]);
    case PEER_CONE:
        return std::make_shared<typename Library::Cone>(s[0], s[1]);
    case PEER_ELLIPSOID:
        return std::make_shared<typename Library::Ellipsoid>(s[0], s[1], s[2]);
    case PEER_HULL:
        return Library::hull(shape.surface);
    case PEER_MESH:
        return mesh_geometry<Library>(shape.surface, volume);
    case PEER_CLOUD:
        return std::make_shared<typename Library::OcTree>(voxels(shape));
    default:
        throw std::invalid_argument("no such shape");
    }
}

// With the box that first guesses are made from.
template <class Library>
typename Library::Geometry geometry(const peer_shape &shape, Volume volume) {
    auto made = bare_geometry<Library>(shape, volume);
    made->computeLocalAABB();
    return made;
}

} // namespace peers
