// The C++ layer: every class and call once, exceptions both ways, copies and moves.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstk.hpp>

static void require(bool condition, const char *what) {
    if (!condition) {
        std::fprintf(stderr, "failed: %s\n", what);
        std::exit(1);
    }
}

#define REQUIRE(condition) require(condition, #condition)

template <typename Action> static cstk_status status_of(Action action) {
    try {
        action();
    } catch (const cstk::Error &error) {
        REQUIRE(std::string(error.what()).find(": ") != std::string::npos);
        return error.status();
    }
    return CSTK_OK;
}

static const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                              0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

static void bodies() {
    cstk::BodyBuilder builder;
    REQUIRE(status_of([&] { builder.build(); }) == CSTK_EMPTY);
    REQUIRE(status_of([] { cstk::BodyBuilder plane(4); }) == CSTK_INVALID_ARGUMENT);
    const std::vector<double> triangle = {0, 0, 2, 1, 0, 2, 0, 1, 2};
    builder.add_polyhedron(cube, 7).add_polygon(triangle, 8);
    builder.add_triangles(triangle, std::vector<std::uint32_t>{0, 1, 2});
    const std::uint32_t sizes[] = {3};
    builder.add_mesh(triangle, sizes, std::vector<std::uint32_t>{0, 1, 2});
    cstk::Body body = builder.build();
    REQUIRE(body.statistics().primitive_count == 4);
    REQUIRE(body.feature_vertices(0, CSTK_FACE, 0).size() == 12);
    REQUIRE(status_of([&] { builder.add_mesh_file("/nowhere.obj"); }) == CSTK_IO);

    int heard = 0;
    builder.build(cstk::hierarchy_options(), [&](double) { return ++heard > 0; });
    REQUIRE(heard > 1);
    REQUIRE(status_of([&] {
                builder.build(cstk::hierarchy_options(), [](double) { return false; });
            }) == CSTK_CANCELLED);
    bool passed = false;
    try {
        builder.build(cstk::hierarchy_options(),
                      [](double) -> bool { throw std::domain_error("mine"); });
    } catch (const std::domain_error &error) {
        passed = std::string(error.what()) == "mine";
    }
    REQUIRE(passed);

    cstk::Body copy = body;
    cstk::Body moved = std::move(body);
    REQUIRE(!body && copy.get() == moved.get());
    copy = cstk::Body();
    REQUIRE(moved.statistics().primitive_count == 4);
}

static void hierarchies() {
    const std::vector<double> triangle = {0, 0, 2, 1, 0, 2, 0, 1, 2};
    cstk::BodyBuilder builder;
    builder.add_polyhedron(cube, 7).add_polygon(triangle, 8).add_polyhedron(triangle, 9);
    cstk_hierarchy_options options = cstk::hierarchy_options();
    options.wrapper = CSTK_WRAPPER_ALIGNED_BOX;
    cstk::Body body = builder.build(options);
    const cstk_hierarchy_statistics statistics = body.hierarchy();
    REQUIRE(statistics.wrapper == CSTK_WRAPPER_ALIGNED_BOX);
    REQUIRE(statistics.node_count == 5 && statistics.leaf_count == 3 && statistics.depth == 3);
    REQUIRE(body.level(0) == std::vector<std::uint32_t>{0});
    REQUIRE(body.level(2).size() == 3 && body.level_statistics(2).leaves_above == 1);
    REQUIRE(std::fabs(body.level_statistics(0).volume - 2.0) < 1e-14);
    REQUIRE(status_of([&] { body.level(3); }) == CSTK_NOT_FOUND);
    REQUIRE(status_of([&] { body.level_statistics(3); }) == CSTK_NOT_FOUND);

    REQUIRE(body.cover(1) == body.level(0) && body.cover(2).size() == 2);
    REQUIRE(body.cover(SIZE_MAX) == body.level(2));
    REQUIRE(status_of([&] { body.cover(0); }) == CSTK_INVALID_ARGUMENT);
    const cstk_hierarchy_node root = body.node(0);
    REQUIRE(root.children[0] == 1 && root.primitive == UINT32_MAX && root.corner_count == 8);
    REQUIRE(root.center[0] == 0.5 && root.center[1] == 0.5 && root.center[2] == 1.0);
    REQUIRE(body.node_corners(0).size() == 24);
    REQUIRE(status_of([&] { body.node(5); }) == CSTK_NOT_FOUND);
    REQUIRE(status_of([&] { body.node_corners(5); }) == CSTK_NOT_FOUND);

    const char *picture = "cpp_layer_nodes.glb";
    body.show_nodes(body.level(1), picture);
    REQUIRE(std::remove(picture) == 0);
    REQUIRE(status_of([&] { body.show_nodes({0}, "/nowhere/x.glb"); }) == CSTK_IO);
    REQUIRE(status_of([&] { body.nodes_mesh({0, 5}); }) == CSTK_NOT_FOUND);
    cstk::Mesh mesh = body.nodes_mesh({0});
    cstk::Mesh copy = mesh;

    const char *file = "cpp_layer.cstk";
    body.save(file);
    cstk::Body loaded = cstk::Body::load(file);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { cstk::Body::load(file); }) == CSTK_IO);
    REQUIRE(status_of([&] { body.save("/nowhere/x"); }) == CSTK_IO);
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

static void poses() {
    const std::array<double, 6> placement = {1, 2, 3, 0.1, 0.2, 0.3};
    const std::array<double, 6> again = cstk::pose_to_euler(cstk::pose_from_euler(placement));
    for (int i = 0; i < 6; ++i) {
        REQUIRE(std::fabs(placement[i] - again[i]) < 1e-14);
    }
    REQUIRE(cstk::pose_from_quaternion({1, 2, 3, 0, 0, 0, 1}) == cstk::translation(1, 2, 3));
    REQUIRE(cstk::compose(cstk::translation(1, 2, 3), cstk::translation(1, 0, 0)) ==
            cstk::translation(2, 2, 3));
}

static void queries() {
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
    const std::vector<double> q = {0.5, 0.0};
    REQUIRE(robot.link_pose(q, 1) == cstk::translation(0.5, 3, 0));
    REQUIRE(robot.jacobian(q, 1, {1, 0, 0})[0] == 1.0);

    const cstk_range ranges[] = {cstk::interval(-10, 10), cstk::circle()};
    cstk::Space space({robot}, ranges);
    REQUIRE(space.nq() == 2 && space.nv() == 2 && space.link_count() == 2);
    REQUIRE(space.contains(q) && !space.contains(std::vector<double>{11, 0}));

    cstk::Environment environment;
    const std::uint64_t id = environment.add(body, cstk::translation(5, 0, 0));
    cstk::Environment before = environment.snapshot();
    environment.move(id, cstk::translation(4, 0, 0));
    REQUIRE(environment.object_count() == 1 && environment.version() == 2);
    REQUIRE(environment.object_pose(id) == cstk::translation(4, 0, 0));
    REQUIRE(status_of([&] { before.remove(id); }) == CSTK_UNSUPPORTED);

    cstk::CObject obstacles = cstk::CObject::induced(space, environment, cstk::cobject_options(3));
    cstk::CObject self = cstk::CObject::induced_links(space, {{0, 1}});
    cstk::CObject all = cstk::CObject::union_of({obstacles, self});
    cstk::Query query;
    REQUIRE(query.distance(obstacles, q).distance == 2.5);
    REQUIRE(query.distance(self, q).distance == 2.0);
    REQUIRE(query.distance(all, q).distance == 2.0);
    REQUIRE(query.distance(all, {0, 0}).distance == 2.0);
    REQUIRE(query.distance(all, q, 1.0).kind == CSTK_BEYOND_MAX);
    REQUIRE(query.classify(all, q) == CSTK_CONTACT);
    REQUIRE(query.within(all, q, 2.0) && !query.within(all, q, 1.9));
    REQUIRE(query.witnesses(all, q, 2.6).witness_count == 2);
    const cstk_witness_list list = query.gradients(obstacles, q, 2.6);
    REQUIRE(list.contact_count == 4 && list.nv == 2 && list.gradients[0] == -1.0);
    const cstk_pseudo_normal_result everything = query.pseudo_normal(all, q, 2.6);
    REQUIRE(everything.point_class == CSTK_CONTACT && everything.list.witness_count == 2);

    const std::vector<cstk::Pose> links = {robot.link_pose(q, 0), robot.link_pose(q, 1)};
    REQUIRE(query.classify_at(all, links) == CSTK_CONTACT);
    REQUIRE(query.within_at(all, links, 2.0));
    REQUIRE(query.distance_at(all, links).distance == 2.0);
    REQUIRE(query.witnesses_at(all, links, 2.6).witness_count == 2);

    std::vector<double> moving = q;
    const cstk_slide_result slide =
        query.slide(obstacles, moving, std::vector<double>{0.1, 0}, cstk::slide_options(0.5));
    REQUIRE(slide.outcome == CSTK_SLIDE_MOVED && std::fabs(moving[0] - 0.6) < 1e-15);
    REQUIRE(query.statistics(true).primitive_pairs > 0);
    REQUIRE(query.statistics().primitive_pairs == 0);

    const cstk::Pose here = cstk::identity(), there = cstk::translation(3, 0, 0);
    REQUIRE(query.pair_distance(body, here, body, there).distance == 2.0);
    REQUIRE(query.pair_within(body, here, body, there, 2.0));
    REQUIRE(query.pair_witnesses(body, here, body, there, 2.0).contact_count == 4);
    REQUIRE(query.pair_penetration(body, here, body, there).count == 0);
    REQUIRE(query.pair_penetration(body, here, body, here, 1).count == 1);
    REQUIRE(status_of([&] { query.pair_within(body, here, body, there, -1.0); }) ==
            CSTK_INVALID_ARGUMENT);
    const char *file = "cpp_layer.glb";
    all.show(q, file);
    REQUIRE(std::remove(file) == 0);
    REQUIRE(status_of([&] { all.show(q, "/nowhere/x.glb"); }) == CSTK_IO);
}

int main() {
    bodies();
    hierarchies();
    poses();
    queries();
    std::puts("the C++ layer holds");
}
