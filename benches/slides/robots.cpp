#include "robots.hpp"

namespace {

cstk::Space space_of(const std::string &robots, const std::string &urdf) {
    const std::string packages = robots + "/cmeel.prefix/share";
    const char *paths[] = {packages.c_str()};
    cstk_urdf_options options = cstk::urdf_options();
    options.package_paths = paths;
    options.package_path_count = 1;
    cstk::RobotBuilder builder;
    builder.load_urdf(packages + "/example-robot-data/robots/" + urdf, options);
    return cstk::Space(builder.build());
}

// A table that the robot stands on, a post on either side, and a shelf above.
cstk::Environment obstacles_around() {
    cstk::Environment environment;
    const auto add = [&](double x, double y, double z, double a, double b, double c) {
        const cstk::Body box = cstk::BodyBuilder().add_box(cstk::identity(), {a, b, c}).build();
        environment.add(box, cstk::translation(x, y, z));
    };
    add(0.6, 0, -0.05, 0.4, 0.6, 0.04);
    add(0.45, 0.45, 0.4, 0.05, 0.05, 0.4);
    add(0.45, -0.45, 0.4, 0.05, 0.05, 0.4);
    add(0.6, 0, 0.85, 0.3, 0.5, 0.02);
    return environment;
}

} // namespace

Cell::Cell(const std::string &robots, const std::string &urdf)
    : space(space_of(robots, urdf)), environment(obstacles_around()) {
    const auto tested = cstk::Query().find_link_pairs(space).tested;
    pairs = tested.size();
    itself = cstk::CObject::induced_links(space, tested);
    obstacles = cstk::CObject::induced(space, environment);
}
