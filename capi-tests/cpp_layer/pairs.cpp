#include "check.hpp"
#include "subjects.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

void pairs(cstk::Query &query, const cstk::Body &body) {
    const cstk::Pose here = cstk::identity(), there = cstk::translation(3, 0, 0);
    REQUIRE(query.pair_distance(body, here, body, there).distance == 2.0);
    REQUIRE(query.pair_within(body, here, body, there, 2.0));
    REQUIRE(query.pair_witnesses(body, here, body, there, 2.0).contact_count == 4);
    REQUIRE(query.pair_penetration(body, here, body, there).count == 0);
    for (const cstk_penetration &found : cstk::penetrations_of(query.pair_penetration(body, here, body, here, 1))) {
        REQUIRE(found.depth == 1.0);
    }
    REQUIRE(!query.pair_depth(body, here, body, there).meet);
    const cstk_depth_result deep = query.pair_depth(body, here, body, here, cstk::depth_options(1e-3, 100));
    REQUIRE(deep.meet && deep.tight && deep.lower <= deep.upper && deep.steps <= 100);
    REQUIRE(status_of([&] { return query.pair_within(body, here, body, there, -1.0); }) ==
            CSTK_ERROR_INVALID_ARGUMENT);
}

void object_pairs(cstk::Query &query, const cstk::Body &body) {
    cstk::Environment world, other;
    const std::uint64_t near = world.add(body, cstk::identity());
    const std::uint64_t far = world.add(body, cstk::translation(3, 0, 0));
    const std::uint64_t third = other.add(body, cstk::translation(0.5, 0, 0));
    REQUIRE(cstk::pairs_of(query.environment_pairs(world, nullptr, 1.9)).empty());
    const cstk_object_pair_list two =
        query.environment_pairs(world, nullptr, 2.0, 9, cstk::object_pair_options(true));
    REQUIRE(two.count == 1 && two.pairs[0].r_object == near && two.pairs[0].s_object == far);
    REQUIRE(two.distances[0].distance == 2.0 && two.pairs[0].pair_class == CSTK_CLASS_CONTACT);
    REQUIRE(query.environment_within(world, &other, 0) && !query.environment_within(world, nullptr, 0));
    REQUIRE(query.environment_distance(world, nullptr).distance == 2.0);
    REQUIRE(query.environment_distance(world, &other).witness.s_object == third);
    REQUIRE(query.environment_witnesses(world, nullptr, 2.0).contact_count == 4);
    const auto not_near = [&](std::uint64_t r, std::uint64_t, void *, void *) { return r != near; };
    REQUIRE(query.filtered_pairs(world, &other, 9, not_near).count == 1);
    const auto thrower = [](std::uint64_t, std::uint64_t, void *, void *) -> bool {
        throw std::runtime_error("out of the filter");
    };
    std::string thrown;
    try {
        static_cast<void>(query.filtered_pairs(world, &other, 9, thrower));
    } catch (const std::runtime_error &error) {
        thrown = error.what();
    }
    REQUIRE(thrown == "out of the filter");
}
