#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <cstdint>
#include <limits>
#include <vector>

static void pure_sets(const cstk::Space &space) {
    cstk::Query query;
    const double infinity = std::numeric_limits<double>::infinity();
    cstk_pure_options options = cstk::pure_options();
    options.contact_epsilon = 1;
    options.scale = 2;
    const cstk::CObject limits = cstk::CObject::beyond_limits(space);
    const cstk::CObject world = cstk::CObject::beyond_world(space);
    const cstk::CObject box = cstk::CObject::box(space, {1, -infinity}, {2, infinity}, options);
    const cstk::CObject plane = cstk::CObject::halfspace(space, {-2, 0}, -6, options);
    const cstk::CObject ball = cstk::CObject::ball(space, {0, 0}, 0.5, options);
    const std::vector<double> q = {3, 0};
    REQUIRE(query.distance(limits, q).distance == 2 && query.distance(world, q).distance == 1);
    REQUIRE(query.distance(box, q).distance == 2 && query.distance(ball, q).distance == 5);
    REQUIRE(query.classify(limits, q) == CSTK_CLASS_OUTSIDE && query.classify(ball, q) == CSTK_CLASS_OUTSIDE);
    REQUIRE(query.classify(box, q) == CSTK_CLASS_CONTACT && query.classify(plane, q) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(limits, {6, 0}) == CSTK_CLASS_INSIDE);
    REQUIRE(query.gradients(box, q, 3).gradients[0] == 2);

    const cstk::CObject either = cstk::CObject::union_of({box, ball});
    const cstk::CObject both = cstk::CObject::intersection_of({box, plane});
    REQUIRE(query.distance(either, q).distance == 2);
    REQUIRE(query.classify(both, q) == CSTK_CLASS_CONTACT);
    REQUIRE(query.classify(both, {1, 0}) == CSTK_CLASS_OUTSIDE);
    REQUIRE(query.classify(cstk::CObject::difference(plane, box), {4, 0}) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(ball.complement(), q) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(ball.complement(), {0, 0}) == CSTK_CLASS_OUTSIDE);

    REQUIRE(is_invalid([&] { return cstk::CObject::box(space, {1, 2}, {1}); }));
    REQUIRE(status_of([&] { return cstk::CObject::box(space, {1}, {2}); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return cstk::CObject::halfspace(space, {0, 0}, 1); }) == CSTK_ERROR_DEGENERATE);
    REQUIRE(status_of([&] { return cstk::CObject::ball(space, {0, 0}, -1); }) == CSTK_ERROR_INVALID_ARGUMENT);
    cstk_pure_options bad = cstk::pure_options();
    bad.contact_epsilon = -1;
    REQUIRE(status_of([&] { return cstk::CObject::beyond_limits(space, bad); }) == CSTK_ERROR_INVALID_ARGUMENT);
    REQUIRE(status_of([&] { return cstk::CObject::beyond_world(space, bad); }) == CSTK_ERROR_INVALID_ARGUMENT);
    REQUIRE(status_of([] { return cstk::CObject::intersection_of({}); }) == CSTK_ERROR_EMPTY);
    REQUIRE(status_of([] { return cstk::CObject::union_of({}); }) == CSTK_ERROR_EMPTY);
    REQUIRE(status_of([] { return cstk::CObject().complement(); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([&] { return cstk::CObject::difference(box, cstk::CObject()); }) ==
            CSTK_ERROR_NULL_ARGUMENT);
}

static void explanations(const cstk::Space &space, const cstk::Body &body) {
    cstk::Query query;
    int destroyed = 0;
    int mark = 0;
    cstk::Environment environment;
    const std::uint64_t id = environment.add(body, cstk::translation(2, 0, 0));
    cstk::CObject obstacle =
        cstk::CObject::induced(space, environment).with_data(&destroyed, count);
    cstk::CObject ball = cstk::CObject::ball(space, {0, 0}, 0.5).with_data(&mark);
    REQUIRE(obstacle.data() == &destroyed && ball.data() == &mark);
    REQUIRE(obstacle.number() != ball.number() && environment.object_count() == 1);
    const cstk::CObject all = cstk::CObject::union_of({obstacle, ball.complement()});
    const cstk_explanation why = query.explain(all, {1.5, 0});
    REQUIRE(why.point_class == CSTK_CLASS_INSIDE && why.leaf_count == 2 && why.list.witness_count == 1);
    REQUIRE(why.leaves[0].data == &destroyed && why.leaves[0].cobject == obstacle.number());
    REQUIRE(why.leaves[1].data == &mark && why.leaves[1].cobject == ball.number());
    REQUIRE(why.leaves[1].complemented && why.leaves[1].decisive && why.leaves[0].decisive);
    REQUIRE(why.list.witnesses[0].cobject_data == &destroyed);
    REQUIRE(why.list.witnesses[0].s_object == id);
    REQUIRE(query.explain(all, {1.5, 0}, 0).list.truncated);
    REQUIRE(status_of([&] { return query.explain(all, {1.5}); }) == CSTK_ERROR_WRONG_SIZE);
    REQUIRE(status_of([&] { return query.distance(all, {1.5, 0}); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(status_of([&] { return query.prove_clear_pairs(obstacle); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(obstacle.with_shell(0.1).data() == &destroyed);
    REQUIRE(query.classify(obstacle.with_known(cstk::CObject::ball(space, {1.5, 0}, 0.1), CSTK_CLASS_OUTSIDE),
                           {1.5, 0}) == CSTK_CLASS_OUTSIDE);
    REQUIRE(status_of([&] { return obstacle.with_known(obstacle, CSTK_CLASS_OUTSIDE); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(obstacle.with_shell(0.1).number() != obstacle.number());
    REQUIRE(status_of([&] { return all.with_shell(0.1); }) == CSTK_ERROR_UNSUPPORTED);
    REQUIRE(status_of([] { return cstk::CObject().with_shell(0.1); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([] { return cstk::CObject().with_data(nullptr); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([] { return cstk::CObject().data(); }) == CSTK_ERROR_NULL_ARGUMENT);
    REQUIRE(status_of([] { return cstk::CObject().number(); }) == CSTK_ERROR_NULL_ARGUMENT);
    const cstk::CObject alone = obstacle;
    obstacle = cstk::CObject();
    REQUIRE(destroyed == 0);
}

void sets() {
    const cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
    const cstk::Space space = make_space(body);
    pure_sets(space);
    predicates(space);
    explanations(space, body);
    worlds(space, body);
}
