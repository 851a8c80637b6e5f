/* Part of cstk.hpp: s-objects and their changes. */
#ifndef CSTK_ENVIRONMENT_HPP
#define CSTK_ENVIRONMENT_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/space.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cstk {

[[nodiscard]] inline cstk_scene_options scene_options() {
    cstk_scene_options options;
    check(cstk_scene_options_default(&options, sizeof options));
    return options;
}

class Environment
    : public Handle<cstk_environment, cstk_environment_retain, cstk_environment_release> {
public:
    Environment() : Handle(create()) {}

    /// Adds an s-object, with a name if given; returns its id.
    std::uint64_t add(const Body &body, const Pose &pose, const std::string &name = {}) {
        cstk_environment_change added = change(CSTK_CHANGE_ADD, 0, body.get(), pose);
        added.name = name.c_str();
        return apply_one(added);
    }

    /// Adds an s-object that is attached to a link from the first, `pose` in the link's frame: see attach().
    std::uint64_t add_attached(const Body &body, const Space &space, std::uint32_t link, const Pose &pose,
                               Span<std::uint32_t> touch_links = {}, const std::string &name = {}) {
        cstk_environment_change added = change(CSTK_CHANGE_ADD, 0, body.get(), pose);
        added.name = name.c_str();
        hold(added, space, link, touch_links);
        return apply_one(added);
    }

    void move(std::uint64_t id, const Pose &pose) {
        apply_one(change(CSTK_CHANGE_MOVE, id, nullptr, pose));
    }

    void remove(std::uint64_t id) {
        apply_one(change(CSTK_CHANGE_DELETE, id, nullptr, identity()));
    }

    /// Fixes an s-object to a link of a space, `pose` in the link's frame; move() lets it go. The links in `touch_links` may meet
    /// it: the fingers, say.
    void attach(std::uint64_t id, const Space &space, std::uint32_t link, const Pose &pose,
                Span<std::uint32_t> touch_links = {}) {
        cstk_environment_change attached = change(CSTK_CHANGE_ATTACH, id, nullptr, pose);
        hold(attached, space, link, touch_links);
        apply_one(attached);
    }

    /// Adds the objects of a MoveIt `.scene` file, with their names; returns their ids.
    std::vector<std::uint64_t> load_scene(const std::string &file,
                                          const cstk_scene_options &options = scene_options()) {
        return load(cstk_environment_load_scene, file, options);
    }

    std::vector<std::uint64_t> load_scene_text(const std::string &scene,
                                               const cstk_scene_options &options = scene_options()) {
        return load(cstk_environment_load_scene_text, scene, options);
    }

    /// Applies all changes as one; returns the ids they are about.
    std::vector<std::uint64_t> apply(Span<cstk_environment_change> changes) {
        std::vector<std::uint64_t> ids(changes.size());
        check(cstk_environment_apply(get(), changes.data(), changes.size(), ids.data(), nullptr));
        return ids;
    }

    /// One change, for apply().
    [[nodiscard]] static cstk_environment_change change(cstk_change_kind kind, std::uint64_t id,
                                          const cstk_body *body, const Pose &pose) {
        cstk_environment_change change;
        check(cstk_environment_change_default(&change, sizeof change));
        change.kind = kind;
        change.id = id;
        change.body = body;
        for (std::size_t i = 0; i < 12; ++i) {
            change.pose[i] = pose[i];
        }
        return change;
    }

    [[nodiscard]] Environment snapshot() const {
        cstk_environment *out = nullptr;
        check(cstk_environment_snapshot(get(), &out));
        return Environment(out);
    }

    [[nodiscard]] std::size_t object_count() const {
        std::size_t count = 0;
        check(cstk_environment_get_state(get(), &count, nullptr));
        return count;
    }

    [[nodiscard]] std::uint64_t version() const {
        std::uint64_t version = 0;
        check(cstk_environment_get_state(get(), nullptr, &version));
        return version;
    }

    /// The ids of all objects, in the order in which they came.
    [[nodiscard]] std::vector<std::uint64_t> objects() const {
        std::vector<std::uint64_t> ids(object_count());
        std::size_t count = 0;
        check(cstk_environment_get_objects(get(), ids.size(), ids.data(), &count));
        /* Others may have gone meanwhile. */
        ids.resize(count < ids.size() ? count : ids.size());
        return ids;
    }

    /// The name of an s-object; empty if it has none.
    [[nodiscard]] std::string object_name(std::uint64_t id) const {
        return detail::text_of([&](char *buffer, std::size_t capacity, std::size_t *length) {
            return cstk_environment_get_object_name(get(), id, buffer, capacity, length);
        });
    }

    /// The s-object with this name, of several the first; throws if there is none.
    [[nodiscard]] std::uint64_t find_object(const std::string &name) const {
        std::uint64_t id = 0;
        check(cstk_environment_find_object(get(), name.c_str(), &id));
        return id;
    }

    [[nodiscard]] cstk_object_info object(std::uint64_t id) const {
        cstk_object_info out;
        check(cstk_environment_get_object_info(get(), id, &out));
        return out;
    }

    [[nodiscard]] Pose object_pose(std::uint64_t id) const {
        Pose pose;
        check(cstk_environment_get_object_pose(get(), id, pose.data()));
        return pose;
    }

private:
    using Loader = cstk_status (*)(cstk_environment *, const char *, const cstk_scene_options *,
                                   std::size_t, std::uint64_t *, std::size_t *);

    std::vector<std::uint64_t> load(Loader loader, const std::string &scene,
                                    const cstk_scene_options &options) {
        /* As many as a scene may have. */
        std::vector<std::uint64_t> ids(std::size_t{1} << 17);
        std::size_t count = 0;
        check(loader(get(), scene.c_str(), &options, ids.size(), ids.data(), &count));
        ids.resize(count);
        return ids;
    }

    explicit Environment(cstk_environment *owned) : Handle(owned) {}

    static void hold(cstk_environment_change &change, const Space &space, std::uint32_t link,
                     Span<std::uint32_t> touch_links) {
        change.space = detail::given(space);
        change.link = link;
        change.touch_links = touch_links.data();
        change.touch_count = static_cast<std::uint32_t>(touch_links.size());
    }

    std::uint64_t apply_one(const cstk_environment_change &change) {
        std::uint64_t id = 0;
        check(cstk_environment_apply(get(), &change, 1, &id, nullptr));
        return id;
    }

    static cstk_environment *create() {
        cstk_environment *out = nullptr;
        check(cstk_environment_create(&out));
        return out;
    }
};

} // namespace cstk

#endif
