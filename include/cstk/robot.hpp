/* Part of cstk.hpp: robots, and what SRDF files say of them. */
#ifndef CSTK_ROBOT_HPP
#define CSTK_ROBOT_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/span.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cstk {

class Robot : public Handle<cstk_robot, cstk_robot_retain, cstk_robot_release> {
public:
    using Handle::Handle;

    /// The robot of a URDF file and, if given, of its SRDF file: `package_paths` are folders that hold the packages of package:// names.
    /// RobotBuilder takes options, texts and several files, and reports what it read. Defined in robot_builder.hpp.
    [[nodiscard]] static Robot from_urdf(const std::string &urdf, const std::string &srdf = {},
                                         const std::vector<std::string> &package_paths = {});

    [[nodiscard]] std::size_t nq() const {
        std::size_t nq = 0;
        check(cstk_robot_get_size(get(), &nq, nullptr, nullptr));
        return nq;
    }

    [[nodiscard]] std::size_t nv() const {
        std::size_t nv = 0;
        check(cstk_robot_get_size(get(), nullptr, &nv, nullptr));
        return nv;
    }

    [[nodiscard]] std::size_t link_count() const {
        std::size_t count = 0;
        check(cstk_robot_get_size(get(), nullptr, nullptr, &count));
        return count;
    }

    /// The link's body; throws if it has none.
    [[nodiscard]] Body body(std::uint32_t link) const {
        cstk_body *out = nullptr;
        check(cstk_robot_get_body(get(), link, &out));
        return Body(out);
    }

    [[nodiscard]] std::uint32_t find_link(const std::string &name) const {
        std::uint32_t link = 0;
        check(cstk_robot_find_link(get(), name.c_str(), &link));
        return link;
    }

    /// The link that the joint moves.
    [[nodiscard]] std::uint32_t find_joint(const std::string &name) const {
        std::uint32_t link = 0;
        check(cstk_robot_find_joint(get(), name.c_str(), &link));
        return link;
    }

    [[nodiscard]] cstk_link_info link_info(std::uint32_t link) const {
        cstk_link_info out;
        check(cstk_robot_get_link_info(get(), link, &out));
        return out;
    }

    [[nodiscard]] std::string link_name(std::uint32_t link) const { return name(cstk_robot_get_link_name, link); }

    /// The name of the joint that moves the link.
    [[nodiscard]] std::string joint_name(std::uint32_t link) const { return name(cstk_robot_get_joint_name, link); }

    /// What SRDF files say of the robot. Names and arrays of groups, states and end effectors live as long as the robot.
    [[nodiscard]] cstk_semantics semantics() const {
        cstk_semantics out;
        check(cstk_robot_get_semantics(get(), &out));
        return out;
    }

    [[nodiscard]] std::uint32_t find_group(const std::string &name) const {
        std::uint32_t group = 0;
        check(cstk_robot_find_group(get(), name.c_str(), &group));
        return group;
    }

    /// An empty group stands for none.
    [[nodiscard]] std::uint32_t find_state(const std::string &group, const std::string &name) const {
        std::uint32_t state = 0;
        const char *of = group.empty() ? nullptr : group.c_str();
        check(cstk_robot_find_state(get(), of, name.c_str(), &state));
        return state;
    }

    [[nodiscard]] std::uint32_t find_end_effector(const std::string &name) const {
        std::uint32_t end_effector = 0;
        check(cstk_robot_find_end_effector(get(), name.c_str(), &end_effector));
        return end_effector;
    }

    [[nodiscard]] cstk_joint_group group(std::uint32_t index) const {
        cstk_joint_group out;
        check(cstk_robot_get_group(get(), index, &out));
        return out;
    }

    [[nodiscard]] cstk_named_state state(std::uint32_t index) const {
        cstk_named_state out;
        check(cstk_robot_get_state(get(), index, &out));
        return out;
    }

    [[nodiscard]] cstk_end_effector end_effector(std::uint32_t index) const {
        cstk_end_effector out;
        check(cstk_robot_get_end_effector(get(), index, &out));
        return out;
    }

    [[nodiscard]] cstk_virtual_joint virtual_joint(std::uint32_t index) const {
        cstk_virtual_joint out;
        check(cstk_robot_get_virtual_joint(get(), index, &out));
        return out;
    }

    /// q with the values of a named state.
    [[nodiscard]] std::vector<double> apply_state(std::uint32_t state, Span<double> q) const {
        std::vector<double> out(q.data(), q.data() + q.size());
        check(cstk_robot_apply_state(get(), state, out.data(), out.size()));
        return out;
    }

    /// The robot of which only the joints that move these links are left, the others frozen at q.
    [[nodiscard]] Robot frozen(Span<std::uint32_t> joints, Span<double> q) const {
        cstk_robot *out = nullptr;
        check(cstk_robot_create_frozen(get(), joints.data(), joints.size(), q.data(), q.size(), &out));
        Robot made(out);
        made.whole_nq_ = nq();
        return made;
    }

    /// Of a robot that frozen() made: the configuration of the robot that it was made from.
    [[nodiscard]] std::vector<double> to_whole(Span<double> q) const {
        std::vector<double> out(whole_nq_);
        check(cstk_robot_to_whole(get(), q.data(), q.size(), out.data(), out.size()));
        return out;
    }

    /// The other way.
    [[nodiscard]] std::vector<double> from_whole(Span<double> whole) const {
        std::vector<double> out(nq());
        check(cstk_robot_from_whole(get(), whole.data(), whole.size(), out.data(), out.size()));
        return out;
    }

    [[nodiscard]] Pose link_pose(Span<double> q, std::uint32_t link) const {
        Pose pose;
        check(cstk_robot_link_pose(get(), q.data(), q.size(), link, pose.data()));
        return pose;
    }

    /// 6 rows of nv doubles.
    [[nodiscard]] std::vector<double> jacobian(Span<double> q, std::uint32_t link,
                                 const std::array<double, 3> &point) const {
        std::vector<double> out(6 * nv());
        check(cstk_robot_jacobian(get(), q.data(), q.size(), link, point.data(), out.data()));
        return out;
    }

private:
    using NameOf = cstk_status (*)(const cstk_robot *, std::uint32_t, char *, std::size_t,
                                   std::size_t *);

    std::string name(NameOf name_of, std::uint32_t link) const {
        return detail::text_of([&](char *buffer, std::size_t capacity, std::size_t *length) {
            return name_of(get(), link, buffer, capacity, length);
        });
    }

    /* Of the robot that frozen() was called of. */
    std::size_t whole_nq_ = 0;
};

} // namespace cstk

#endif
