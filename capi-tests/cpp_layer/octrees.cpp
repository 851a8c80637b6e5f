#include "check.hpp"
#include "subjects.hpp"

#include <vector>

void octrees() {
    cstk::Octree octree(0.5);
    const std::vector<double> cells = {0.1, 0.1, 0.1, 5.1, 0.1, 0.1};
    REQUIRE(octree.set(cells) == 2 && octree.set(cells) == 0 && octree.cell_count() == 2);
    REQUIRE(octree.get_cell({5.4, 0, 0}) && !octree.get_cell({5.6, 0, 0}) && octree.resolution() == 0.5);
    REQUIRE(octree.cubes() == std::vector<double>({0, 0, 0, 0.5, 5, 0, 0, 0.5}));
    REQUIRE(octree.build_body().statistics().primitive_count == 2);
    cstk::Environment world;
    octree.place(world, cstk::translation(1, 0, 0));
    REQUIRE(world.object_count() == 2 && octree.object_count() == 2 && world.version() == 1);
    octree.set(cells, false);
    REQUIRE(world.object_count() == 0);
    cstk::Octree other(0.5);
    other.set(cells);
    octree.insert(other);
    octree.move(cstk::identity());
    REQUIRE(world.object_count() == 2);
    octree.remove();
    REQUIRE(world.object_count() == 0 && octree.cell_count() == 2);
    REQUIRE(status_of([&] { return octree.move(cstk::identity()); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([] { return cstk::Octree::load("/nowhere.bt"); }) == CSTK_ERROR_IO);
    REQUIRE(status_of([] { return cstk::BodyBuilder().add_cloud_file("/nowhere.pcd", 0.1); }) == CSTK_ERROR_IO);
}
