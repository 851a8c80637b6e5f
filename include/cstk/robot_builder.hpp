/* Part of cstk.hpp: builders of robots, link by link or from URDF and SRDF files. */
#ifndef CSTK_ROBOT_BUILDER_HPP
#define CSTK_ROBOT_BUILDER_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/progress.hpp>
#include <cstk/robot.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cstk {

/// A joint by functions of yours. They must not throw.
[[nodiscard]] inline cstk_custom_joint custom_joint() {
    cstk_custom_joint joint;
    check(cstk_custom_joint_default(&joint, sizeof joint));
    return joint;
}

[[nodiscard]] inline cstk_urdf_options urdf_options() {
    cstk_urdf_options options;
    check(cstk_urdf_options_default(&options, sizeof options));
    return options;
}

[[nodiscard]] inline cstk_srdf_options srdf_options() {
    cstk_srdf_options options;
    check(cstk_srdf_options_default(&options, sizeof options));
    return options;
}

/// A link to be added: the defaults of cstk_link_def.
struct Link {
    std::string name;
    Body body;
    std::int32_t parent = -1;
    cstk_joint_kind joint = CSTK_JOINT_FIXED;
    Pose at = identity();
    std::array<double, 3> axis = {0, 0, 1};
    std::int32_t coordinate = -1;
    std::string joint_name;
    double multiplier = 1;
    double offset = 0;
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    /// For CSTK_JOINT_CUSTOM; copied by add_link.
    const cstk_custom_joint *custom = nullptr;
};

class RobotBuilder
    : public Handle<cstk_robot_builder, cstk_robot_builder_retain, cstk_robot_builder_release> {
public:
    explicit RobotBuilder(std::uint32_t dimension = 3) : Handle(create(dimension)) {}

    std::uint32_t add_link(const Link &link) {
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        def.name = link.name.empty() ? nullptr : link.name.c_str();
        def.body = link.body.get();
        def.parent = link.parent;
        def.joint = link.joint;
        for (std::size_t i = 0; i < 12; ++i) {
            def.at[i] = link.at[i];
        }
        for (std::size_t i = 0; i < 3; ++i) {
            def.axis[i] = link.axis[i];
        }
        def.coordinate = link.coordinate;
        def.joint_name = link.joint_name.empty() ? nullptr : link.joint_name.c_str();
        def.multiplier = link.multiplier;
        def.offset = link.offset;
        def.lower = link.lower;
        def.upper = link.upper;
        def.custom = link.custom;
        std::uint32_t number = 0;
        check(cstk_robot_builder_add_link(get(), &def, &number));
        return number;
    }

    /// Adds the robot of a URDF file; returns its root link. urdf_report() tells what was read and built.
    std::uint32_t load_urdf(const std::string &file,
                            const cstk_urdf_options &options = urdf_options(), Progress progress = {}) {
        detail::Report report{std::move(progress), nullptr};
        std::uint32_t root = 0;
        report.check(cstk_robot_builder_load_urdf(get(), file.c_str(), &options, report.function(), &report, &root));
        return root;
    }

    /// Adds the robot of a URDF text, a robot_description say; mesh names are relative to `folder`.
    std::uint32_t load_urdf_text(const std::string &urdf, const std::string &folder = {},
                                 const cstk_urdf_options &options = urdf_options(), Progress progress = {}) {
        detail::Report report{std::move(progress), nullptr};
        std::uint32_t root = 0;
        const char *at = folder.empty() ? nullptr : folder.c_str();
        report.check(cstk_robot_builder_load_urdf_text(get(), urdf.c_str(), at, &options, report.function(), &report,
                                                       &root));
        return root;
    }

    /// What became of the URDF file or text added last.
    [[nodiscard]] cstk_urdf_report urdf_report() const {
        cstk_urdf_report report;
        check(cstk_robot_builder_get_urdf_report(get(), &report));
        return report;
    }

    /// Adds what an SRDF file says of the links that are there.
    void load_srdf(const std::string &file, const cstk_srdf_options &options = srdf_options()) {
        check(cstk_robot_builder_load_srdf(get(), file.c_str(), &options));
    }

    void load_srdf_text(const std::string &srdf, const cstk_srdf_options &options = srdf_options()) {
        check(cstk_robot_builder_load_srdf_text(get(), srdf.c_str(), &options));
    }

    /// What became of the SRDF file or text added last.
    [[nodiscard]] cstk_srdf_report srdf_report() const {
        cstk_srdf_report report;
        check(cstk_robot_builder_get_srdf_report(get(), &report));
        return report;
    }

    /// Rules a pair of links out for self-collision.
    void disable_pair(const std::string &r_link, const std::string &s_link) {
        check(cstk_robot_builder_disable_pair(get(), r_link.c_str(), s_link.c_str()));
    }

    [[nodiscard]] Robot build() const {
        cstk_robot *out = nullptr;
        check(cstk_robot_build(get(), &out));
        return Robot(out);
    }

private:
    static cstk_robot_builder *create(std::uint32_t dimension) {
        cstk_robot_builder *out = nullptr;
        check(cstk_robot_builder_create(dimension, &out));
        return out;
    }
};

inline Robot Robot::from_urdf(const std::string &urdf, const std::string &srdf,
                              const std::vector<std::string> &package_paths) {
    std::vector<const char *> folders;
    for (const std::string &folder : package_paths) {
        folders.push_back(folder.c_str());
    }
    cstk_urdf_options options = urdf_options();
    options.package_paths = folders.data();
    options.package_path_count = folders.size();
    RobotBuilder builder;
    builder.load_urdf(urdf, options);
    if (!srdf.empty()) {
        builder.load_srdf(srdf);
    }
    return builder.build();
}

} // namespace cstk

#endif
