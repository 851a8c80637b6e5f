#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

void hierarchies() {
    const std::vector<double> triangle = {0, 0, 2, 1, 0, 2, 0, 1, 2};
    cstk::BodyBuilder builder;
    builder.add_polyhedron(cube, 7).add_polygon(triangle, 8).add_polyhedron(triangle, 9);
    cstk_hierarchy_options options = cstk::hierarchy_options();
    options.wrapper = CSTK_WRAPPER_ALIGNED_BOX;
    cstk::Body body = builder.build(options);
    const cstk_hierarchy_statistics statistics = body.hierarchy_statistics();
    REQUIRE(statistics.wrapper == CSTK_WRAPPER_ALIGNED_BOX);
    REQUIRE(statistics.node_count == 5 && statistics.leaf_count == 3 && statistics.depth == 3);
    REQUIRE(body.level_nodes(0) == std::vector<std::uint32_t>{0});
    REQUIRE(body.level_nodes(2).size() == 3 && body.level_statistics(2).leaves_above == 1);
    REQUIRE(std::fabs(body.level_statistics(0).volume - 2.0) < 1e-14);
    REQUIRE(status_of([&] { return body.level_nodes(3); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return body.level_statistics(3); }) == CSTK_ERROR_NOT_FOUND);

    REQUIRE(body.cover_nodes(1) == body.level_nodes(0) && body.cover_nodes(2).size() == 2);
    REQUIRE(body.cover_nodes(SIZE_MAX) == body.level_nodes(2));
    REQUIRE(status_of([&] { return body.cover_nodes(0); }) == CSTK_ERROR_INVALID_ARGUMENT);
    const cstk_hierarchy_node root = body.node(0);
    REQUIRE(root.children[0] == 1 && root.primitive == UINT32_MAX && root.corner_count == 8);
    REQUIRE(root.center[0] == 0.5 && root.center[1] == 0.5 && root.center[2] == 1.0);
    REQUIRE(body.node_corners(0).size() == 24);
    REQUIRE(status_of([&] { return body.node(5); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return body.node_corners(5); }) == CSTK_ERROR_NOT_FOUND);

    const char *picture = "cpp_layer_nodes.glb";
    body.show_nodes(body.level_nodes(1), picture);
    REQUIRE(std::remove(picture) == 0);
    REQUIRE(status_of([&] { return body.show_nodes({0}, "/nowhere/x.glb"); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([&] { return body.mesh_of_nodes({0, 5}); }) == CSTK_ERROR_NOT_FOUND);
    cstk::Mesh mesh = body.mesh_of_nodes({0});
    cstk::Mesh copy = mesh;

    const char *file = "cpp_layer.cstk";
    body.save(file);
    cstk::Body loaded = cstk::Body::load(file);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { return cstk::Body::load(file); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([&] { return body.save("/nowhere/x"); }) == CSTK_ERROR_IO);
    REQUIRE(loaded.get() != body.get() && loaded.statistics().primitive_count == 3);
    REQUIRE(loaded.node_corners(0) == body.node_corners(0));

    /* The mesh outlives the body it was made of. */
    body = cstk::Body();
    mesh = cstk::Mesh();
    const cstk_mesh_view view = copy.view();
    REQUIRE(!mesh && view.vertex_count == 8 && view.face_count == 6 && view.index_count == 24);
    for (std::size_t i = 0; i < view.vertex_count; ++i) {
        REQUIRE(view.vertices[3 * i + 2] == 0.0 || view.vertices[3 * i + 2] == 2.0);
    }
}
