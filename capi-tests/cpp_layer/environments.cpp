#include "check.hpp"
#include "subjects.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

void scenes() {
    const char *text = "s\n* ball\n1\nsphere\n1\n4 0 0\n0 0 0 1\n0 0 0 0\n.\n";
    cstk::Environment environment;
    cstk_scene_options options = cstk::scene_options();
    options.at[3] = 1;
    const std::vector<std::uint64_t> ids = environment.load_scene_text(text, options);
    REQUIRE(ids.size() == 1 && environment.object_pose(ids[0])[3] == 1);
    REQUIRE(std::string(static_cast<const char *>(environment.object(ids[0]).data)) == "ball");
    REQUIRE(environment.object_name(ids[0]) == "ball" && environment.find_object("ball") == ids[0]);
    REQUIRE(status_of([&] { return environment.find_object("cup"); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return environment.object_name(ids[0] + 1000); }) == CSTK_ERROR_NOT_FOUND);
    REQUIRE(status_of([&] { return environment.load_scene("/nowhere.scene"); }) == CSTK_ERROR_IO);
}

/* An arm of three rods whose last may fold onto the first. */
static void folding_arm(cstk::Query &query) {
    cstk::RobotBuilder builder;
    for (std::uint32_t i = 0; i < 3; ++i) {
        cstk::Link rod;
        rod.body = cstk::Body::box({1, 0.1, 0.1}, cstk::translation(1, 0, 0));
        rod.joint = CSTK_JOINT_REVOLUTE;
        rod.axis = {0, 0, 1};
        if (i > 0) {
            rod.parent = i - 1;
            rod.at = cstk::translation(2, 0, 0);
        }
        builder.add_link(rod);
    }
    const cstk::Space arm(builder.build());
    const cstk::LinkPairs found = query.find_link_pairs(arm);
    REQUIRE((found.tested == std::vector<std::array<std::uint32_t, 2>>{{0, 2}}));
    REQUIRE(found.pairs.size() == 3 && found.pairs[1].verdict == CSTK_PAIR_TEST && found.pairs[1].share > 0);
    const auto stop = [](double) { return false; };
    REQUIRE(status_of([&] { return query.find_link_pairs(arm, cstk::link_pair_options(), stop); }) ==
            CSTK_ERROR_CANCELLED);
    const cstk::CObject itself = cstk::CObject::induced_links(arm, found.tested);
    REQUIRE(status_of([&] { return query.prove_clear_pairs(itself, cstk::clear_pair_options(), nullptr, stop); }) ==
            CSTK_ERROR_CANCELLED);
}

/* Objects with names, one attached from the first; answers in words. */
static void named(const cstk::Space &space, const cstk::Body &body, std::uint32_t hand) {
    cstk::Environment world;
    const std::uint64_t shelf = world.add(body, cstk::translation(0, 0, 30), "shelf");
    const std::uint64_t cup = world.add_attached(body, space, hand, cstk::translation(0, 0, 20), {0}, "cup");
    REQUIRE(world.object_name(shelf) == "shelf" && world.find_object("cup") == cup);
    /* Empty handles are not the NULL that means "nothing of the kind". */
    const cstk::Space no_space;
    REQUIRE(is_invalid([&] { world.add_attached(body, no_space, hand, cstk::identity()); }));
    cstk::Environment gone;
    const cstk::Environment kept = std::move(gone);
    REQUIRE(is_invalid([&] { (void)cstk::Query().environment_within(kept, &gone, 0); }));
    REQUIRE(world.object(cup).link == hand && world.object(cup).touch_count == 1);
    const std::vector<double> q(space.nq(), 0.0);
    std::vector<double> gradient(space.nv(), 7);
    cstk::Query query;
    const cstk::CObject all = cstk::CObject::induced(space, world);
    const cstk_distance_result found = query.distance_with_gradient(all, q, gradient);
    REQUIRE(cstk::describe(space, world, found.witness) == space.link_name(hand) + " (cup) x shelf");
    REQUIRE(found.distance == query.distance(all, q).distance && gradient[0] != 7);
    REQUIRE(all.space().nq() == space.nq());
    gradient.clear();
    REQUIRE(status_of([&] { return query.distance_with_gradient(all, q, gradient); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(std::string(cstk::to_string(query.classify(all, q))) == "outside");
    REQUIRE(std::string(cstk::to_string(CSTK_MOTION_UNDECIDED)) == "undecided");
    cstk_witness limits = found.witness;
    limits.r_link = CSTK_NONE;
    REQUIRE(cstk::describe(space, world, limits) == "a pure set");
    limits.coordinate = 1;
    REQUIRE(cstk::describe(space, world, limits) == "coordinate 1");
}

/* A robot with an object in its hand, over a floor. */
void worlds(const cstk::Space &space, const cstk::Body &body) {
    int mark = 0;
    const cstk::Body held = cstk::BodyBuilder().add_sphere({0, 0, 0}, 0.5).build();
    held.set_data(&mark);
    REQUIRE(held.data() == &mark && body.data() == nullptr);
    cstk::Environment world;
    const std::uint64_t id = world.add(held, cstk::translation(0, 0, 50));
    const std::vector<double> q(space.nq(), 0.0);
    cstk::Query query;
    const cstk::CObject ground = cstk::CObject::below_floor(space, {0, 0, 4}, -400);
    REQUIRE(query.distance(ground, q).distance > 90);
    const std::uint32_t hand = static_cast<std::uint32_t>(space.link_count() - 1);
    world.attach(id, space, hand, cstk::translation(0, 0, 20));
    const std::uint64_t wall = world.add(body, cstk::translation(0, 0, 30));
    const cstk::CObject all = cstk::CObject::induced(space, world);
    const cstk_distance_result found = query.distance(all, q);
    REQUIRE(found.witness.r_object == id && found.witness.s_object == wall);
    REQUIRE(found.witness.r_data == &mark && query.version(world) == world.version());
    REQUIRE(world.object(id).link == hand && world.object(id).data == &mark);
    REQUIRE((world.objects() == std::vector<std::uint64_t>{id, wall}));
    const std::string link = space.link_name(hand);
    REQUIRE(space.find_link(link) == hand);
    REQUIRE(cstk::describe(space, world, found.witness) ==
            link + " (object " + std::to_string(id) + ") x object " + std::to_string(wall));
    named(space, body, hand);
    world.move(id, cstk::translation(0, 0, 50));
    REQUIRE(world.object(id).link == CSTK_NONE && world.object(id).pose[11] == 50);
    REQUIRE(query.distance(all, q).witness.r_object == 0);
    REQUIRE(space.link_name(hand) == "link1" && query.find_link_pairs(space).tested.empty());
    folding_arm(query);
    const cstk::CObject none = cstk::CObject::induced_links(space, {});
    REQUIRE(query.prove_clear_pairs(none).number() != none.number());
}
