#include "check.hpp"
#include "subjects.hpp"

#include <cstdio>
#include <vector>

void maps(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q) {
    const auto stop = [](double) { return false; };
    const cstk::Map map = cstk::Map::build(obstacles, q, {cstk::map_axis(0, 0, 10, 10)});
    REQUIRE(map.view().cell_count == 10 && map.view().values[4] == CSTK_CLASS_INSIDE);
    REQUIRE(map.view().values[0] == query.classify(obstacles, std::vector<double>{0.5, q[1]}));
    const cstk::Map part = cstk::Map::build(obstacles, q, {cstk::map_axis(0, 0, 10, 10, 4, 2)});
    REQUIRE(part.view().cell_count == 2 && part.view().values[0] == map.view().values[4]);
    map.save("cpp_layer.npy");
    REQUIRE(std::remove("cpp_layer.npy") == 0);
    REQUIRE(status_of([&] { return map.show("cpp_layer.png"); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(status_of([&] {
                return cstk::Map::build(obstacles, q, {cstk::map_axis(0, 0, 1, 9)}, cstk::map_options(), stop);
            }) == CSTK_ERROR_CANCELLED);
}
