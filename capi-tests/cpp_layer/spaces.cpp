#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

void spaces() {
    int calls = 0;
    const cstk::Robot robot = make_robot(calls);
    std::vector<cstk_range> ranges(9, cstk::default_range());
    for (std::size_t i = 1; i < 4; ++i) {
        ranges[i] = cstk::interval(-1, 1);
    }
    ranges[8] = cstk::circle();
    std::vector<cstk_range> twice = ranges;
    twice.insert(twice.end(), ranges.begin(), ranges.end());
    const cstk::Space space({robot, robot}, twice, {-5, -5, -5, 5, 5, 5});
    REQUIRE(space.range(0).kind == CSTK_RANGE_INTERVAL && space.range(0).upper == 2);
    REQUIRE(space.range(4).kind == CSTK_RANGE_QUATERNION);
    REQUIRE(space.range(8).kind == CSTK_RANGE_CIRCLE);
    const cstk_space_offset offset = space.offset(1);
    REQUIRE(offset.link == 4 && offset.coordinate == 9 && offset.velocity == 8);
    REQUIRE(status_of([&] { return space.range(18); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return space.offset(2); }) == CSTK_ERROR_NOT_FOUND);

    std::vector<double> q = space.neutral();
    REQUIRE(q.size() == 18 && q[7] == 1 && q[16] == 1 && q[0] == 0);
    REQUIRE(space.link_poses(q).size() == 8 && calls == 2);
    REQUIRE(space.link_poses(q)[1] == cstk::translation(0, 0, 0.5));
    REQUIRE(space.link_poses(q)[5] == robot.link_pose({q.data() + 9, 9}, 1));
    REQUIRE(space.jacobian(q, 1, {0, 0, 0})[2 * space.nv()] == -1);

    std::uint64_t state = 5, again = 5;
    const std::vector<double> q0 = space.sample(state);
    const std::vector<double> q1 = space.sample(state);
    REQUIRE(q0 == space.sample(again) && q0 != q1 && space.within_limits(q0));
    const std::vector<double> way = space.difference(q0, q1);
    REQUIRE(way.size() == 16);
    REQUIRE(space.distance(space.step(q0, way), q1) < 1e-14);
    REQUIRE(space.distance(space.interpolate(q0, q1, 1), q1) < 1e-14);
    std::vector<double> weights(16, 2.0);
    REQUIRE(std::fabs(space.distance(q0, q1, weights) - 2 * space.distance(q0, q1)) < 1e-14);
    std::vector<double> both = q0;
    both.insert(both.end(), q1.begin(), q1.end());
    const std::vector<double> one_by_one = {space.distance(q1, q0), space.distance(q1, q1)};
    REQUIRE(space.distances(q1, both) == one_by_one && space.distances(q1, {}).empty());

    std::uint32_t first = 0;
    q[0] = 7;
    REQUIRE(!space.within_limits(q, &first) && first == 0);
    REQUIRE(!space.within_world(q, &first) && first == 0 && !space.within_world(q));
    REQUIRE(space.clamp(q)[0] == 2 && space.within_limits(space.clamp(q), &first));
    REQUIRE(first == CSTK_NONE);
    q[8] = -1;
    REQUIRE(space.wrap(q)[8] > 5 && space.wrap(q)[0] == 7);

    const std::vector<double> shorter(17);
    REQUIRE(is_invalid([&] { return space.difference(q, shorter); }));
    REQUIRE(is_invalid([&] { return space.interpolate(shorter, q, 0.5); }));
    REQUIRE(is_invalid([&] { return space.distance(q, shorter); }));
    REQUIRE(is_invalid([&] { return space.distance(q, q, shorter); }));
    REQUIRE(is_invalid([&] { return space.distances(q, shorter); }));
    REQUIRE(is_invalid([&] { return space.distances(q, q, shorter); }));
    REQUIRE(status_of([&] { return space.step(q, q); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return space.clamp(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return space.wrap(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return space.link_poses(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return space.within_limits(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return space.within_world(shorter); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return space.jacobian(q, 8, {0, 0, 0}); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return cstk::Space(robot).sample(state); }) == CSTK_ERROR_UNSUPPORTED);
}
