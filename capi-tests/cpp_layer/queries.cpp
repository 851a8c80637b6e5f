#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <cstdint>
#include <cstdio>
#include <vector>

static void pictures(const cstk::CObject &all, const std::vector<double> &q) {
    const char *file = "cpp_layer.glb";
    std::vector<double> both = q;
    both.insert(both.end(), q.begin(), q.end());
    all.show_path(both, 2, 1, file);
    REQUIRE(status_of([&] { return all.show_path(both, 2, 0, file); }) == CSTK_ERROR_INVALID_ARGUMENT);
    all.show(q, file);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { return all.show(q, "/nowhere/x.glb"); }) == CSTK_ERROR_IO);
}

static void views(const cstk_witness_list &list) {
    std::size_t contacts = 0;
    for (const cstk_witness &witness : cstk::witnesses_of(list)) {
        for (const cstk_contact &contact : cstk::contacts_of(list, witness)) {
            REQUIRE(&contact == &cstk::contacts_of(list)[contacts]);
            const cstk::Span<double> gradient = cstk::gradient_of(list, contact);
            REQUIRE(gradient.size() == 2 && &gradient[0] == list.gradients + 2 * contacts);
            ++contacts;
        }
    }
    REQUIRE(contacts == list.contact_count);
    REQUIRE(cstk::contacts_of(list, cstk_witness{}).empty());
    REQUIRE(cstk::gradient_of(cstk_witness_list{}, cstk_contact{}).empty());
}

void queries() {
    cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
    cstk::RobotBuilder builder;
    cstk::Link slider;
    slider.name = "slider";
    slider.body = body;
    slider.joint = CSTK_JOINT_PRISMATIC;
    slider.axis = {1, 0, 0};
    builder.add_link(slider);
    cstk::Link arm;
    arm.body = body;
    arm.parent = 0;
    arm.joint = CSTK_JOINT_REVOLUTE;
    arm.at = cstk::translation(0, 3, 0);
    builder.add_link(arm);
    cstk::Robot robot = builder.build();
    REQUIRE(robot.nq() == 2 && robot.link_count() == 2 && robot.find_link("link1") == 1);
    REQUIRE(robot.body(1).statistics().primitive_count == 1);
    const std::vector<double> q = {0.5, 0.0};
    REQUIRE(robot.link_pose(q, 1) == cstk::translation(0.5, 3, 0));
    REQUIRE(robot.jacobian(q, 1, {1, 0, 0})[0] == 1.0);

    const cstk_range ranges[] = {cstk::interval(-10, 10), cstk::circle()};
    cstk::Space space;
    REQUIRE(!space);
    space = cstk::Space({robot}, ranges);
    REQUIRE(space.nq() == 2 && space.nv() == 2 && space.link_count() == 2);
    REQUIRE(space.contains(q) && !space.contains(std::vector<double>{11, 0}));

    cstk::Environment environment;
    const std::uint64_t id = environment.add(body, cstk::translation(5, 0, 0));
    cstk::Environment before = environment.snapshot();
    environment.move(id, cstk::translation(4, 0, 0));
    REQUIRE(environment.object_count() == 1 && environment.version() == 2);
    REQUIRE(environment.object_pose(id) == cstk::translation(4, 0, 0));
    REQUIRE(status_of([&] { return before.remove(id); }) == CSTK_ERROR_UNSUPPORTED);

    cstk_induced_options options = cstk::induced_options();
    options.contact_epsilon = 3;
    cstk::CObject obstacles = cstk::CObject::induced(space, environment, options);
    cstk::CObject self = cstk::CObject::induced_links(space, {{0, 1}});
    cstk::CObject all = cstk::CObject::union_of({obstacles, self});
    cstk::Query query;
    REQUIRE(query.distance(obstacles, q).distance == 2.5);
    REQUIRE(query.distance(self, q).distance == 2.0);
    REQUIRE(query.distance(all, q).distance == 2.0);
    REQUIRE(query.distance(all, {0, 0}).distance == 2.0);
    REQUIRE(query.distance(all, q, 1.0).kind == CSTK_DISTANCE_BEYOND_MAX);
    REQUIRE(query.classify(all, q) == CSTK_CLASS_CONTACT);
    REQUIRE(query.within(all, q, 2.0) && !query.within(all, q, 1.9));
    REQUIRE(query.witnesses(all, q, 2.6).witness_count == 2);
    const cstk_witness_list list = query.gradients(obstacles, q, 2.6);
    REQUIRE(list.contact_count == 4 && list.nv == 2 && list.gradients[0] == -1.0);
    views(list);
    const cstk_pseudo_normal_result everything = query.pseudo_normal(all, q, 2.6);
    REQUIRE(everything.point_class == CSTK_CLASS_CONTACT && everything.list.witness_count == 2);
    REQUIRE(cstk::leaves_of(query.explain(all, q)).size() == 2);
    query.set_contacts(CSTK_CONTACTS_NONE);
    REQUIRE(query.witnesses(all, q, 2.6).contact_count == 0);
    query.set_contacts(CSTK_CONTACTS_ALL);

    const std::vector<cstk::Pose> links = {robot.link_pose(q, 0), robot.link_pose(q, 1)};
    REQUIRE(query.classify_at_link_poses(all, links) == CSTK_CLASS_CONTACT);
    REQUIRE(query.within_at_link_poses(all, links, 2.0));
    REQUIRE(query.explain_at_link_poses(all, links).leaf_count == 2);
    REQUIRE(query.distance_at_link_poses(all, links).distance == 2.0);
    REQUIRE(query.witnesses_at_link_poses(all, links, 2.6).witness_count == 2);

    motions(query, obstacles, body, q);
    certificates(query, obstacles, q);
    paths(query, obstacles, q);
    regions(query, obstacles, q);
    slides(query, obstacles, q);
    batches(query, obstacles, body, q);
    maps(query, obstacles, q);
    REQUIRE(query.statistics(true).primitive_pairs > 0);
    REQUIRE(query.statistics().primitive_pairs == 0);
    query.set_limit(1);
    REQUIRE(status_of([&] { return query.witnesses(all, q, 2.6); }) == CSTK_ERROR_LIMIT);
    query.set_limit(0);
    query.set_refinement(1e-6);
    REQUIRE(status_of([&] { return query.set_refinement(0); }) == CSTK_ERROR_INVALID_ARGUMENT);
    REQUIRE(query.witnesses(all, q, 2.6).witness_count == 2);
    const cstk_query_statistics done = query.statistics(true);
    REQUIRE(done.primitive_distances <= done.primitive_pairs);

    const cstk_signed_distance_list signed_list = query.signed_distances(all, q, 2.6);
    REQUIRE(signed_list.count > 0);
    const cstk_signed_distance &last = cstk::pairs_of(signed_list)[signed_list.count - 1];
    REQUIRE(cstk::gradient_of(signed_list, last).data() == signed_list.gradients + 2 * (signed_list.count - 1));
    REQUIRE(status_of([&] { return query.signed_distances(all, q, -1.0); }) == CSTK_ERROR_INVALID_ARGUMENT);
    pairs(query, body);
    object_pairs(query, body);
    pictures(all, q);
}
