#include "ours.hpp"

#include <cmath>
#include <memory>

namespace {

cstk::Robot load(const std::string &folder, const std::string &urdf) {
    const std::string packages = folder + "/cmeel.prefix/share";
    const char *paths[] = {packages.c_str()};
    cstk_urdf_options options = cstk::urdf_options();
    options.package_paths = paths;
    options.package_path_count = 1;
    cstk::RobotBuilder builder;
    builder.load_urdf(packages + "/example-robot-data/robots/" + urdf, options);
    return builder.build();
}

} // namespace

Ours::Ours(const std::string &folder, const std::string &urdf) : Ours(load(folder, urdf)) {}

Poses Ours::poses(const std::vector<std::vector<double>> &at) const {
    Poses made;
    made.values.resize(at.size());
    for (std::uint32_t link = 0; link < robot_.link_count(); ++link) {
        const cstk_link_info info = robot_.link_info(link);
        if (info.joint == CSTK_JOINT_FIXED) {
            continue;
        }
        made.joints.push_back(robot_.joint_name(link));
        for (std::size_t i = 0; i < at.size(); ++i) {
            made.values[i].push_back(info.multiplier * at[i][info.coordinate] + info.offset);
        }
    }
    return made;
}

cstk::CObject Ours::itself(const std::vector<LinkPair> &pairs) const {
    std::vector<std::array<std::uint32_t, 2>> numbers;
    for (const LinkPair &pair : pairs) {
        numbers.push_back({robot_.find_link(pair.first), robot_.find_link(pair.second)});
    }
    return cstk::CObject::induced_links(space_, numbers);
}

cstk::CObject Ours::among(const Obstacles &obstacles,
                          const std::vector<std::string> &links) const {
    cstk::Environment environment;
    for (const Box &box : obstacles.boxes) {
        const cstk::Body body =
            cstk::BodyBuilder().add_box(cstk::identity(), box.half_extents).build();
        environment.add(body, cstk::translation(box.center[0], box.center[1], box.center[2]));
    }
    for (const Surface &surface : obstacles.surfaces) {
        const cstk::Body body =
            cstk::BodyBuilder().add_triangles(surface.vertices, surface.triangles).build();
        environment.add(body, cstk::identity());
    }
    std::vector<std::uint32_t> numbers;
    for (const std::string &link : links) {
        numbers.push_back(robot_.find_link(link));
    }
    return cstk::CObject::induced(space_, environment, cstk::induced_options(), numbers);
}

std::vector<Way> Ours::ways(const cstk::CObject &cobject, Query query,
                            const std::vector<std::vector<double>> &at) {
    const auto context = std::make_shared<cstk::Query>();
    if (query == Query::distance) {
        return {{"distance", [=, &at](std::size_t i) {
                     return context->distance(cobject, at[i]).distance;
                 }}};
    }
    return {{"classify",
             [=, &at](std::size_t i) {
                 return context->classify(cobject, at[i]) == CSTK_CLASS_INSIDE ? 1.0 : 0.0;
             }},
            {"within", [=, &at](std::size_t i) {
                 return context->within(cobject, at[i], 0) ? 1.0 : 0.0;
             }}};
}

Way Ours::kinematics(const std::vector<std::vector<double>> &at) const {
    const auto poses = std::make_shared<std::vector<double>>(12 * space_.link_count());
    return {"link poses", [=, &at, this](std::size_t i) {
                cstk::check(cstk_space_link_poses(space_.get(), at[i].data(), at[i].size(), poses->data()));
                return 0.0;
            }};
}
