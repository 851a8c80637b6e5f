#include "ours.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace {

std::vector<cstk_environment_change> additions(const Scene &scene) {
    std::vector<cstk_environment_change> changes;
    for (const Item &item : scene.items) {
        const cstk_body *body = scene.shapes[item.shape].body.get();
        changes.push_back(cstk::Environment::change(CSTK_CHANGE_ADD, 0, body, item.pose));
    }
    return changes;
}

double number_of(cstk_class found) { return found == CSTK_CLASS_INSIDE ? 1 : 0; }

} // namespace

Ours::Ours(const cstk::Space &space, const Scene &scene)
    : ids_(environment_.apply(additions(scene))),
      cobject_(cstk::CObject::induced(space, environment_)) {}

bool Ours::within(const LinkPoses &at, double threshold) {
    return query_.within_at_link_poses(cobject_, at, threshold);
}

Asked Ours::classify(const std::vector<Station> &at) {
    const auto found = std::make_shared<cstk_class>();
    return {"cstk", "", [this] { query_ = cstk::Query(); },
            [=, &at](std::size_t query) { *found = class_at(at[query]); },
            [found] { return number_of(*found); }};
}

Asked Ours::distance(const std::vector<Station> &at) {
    const auto found = std::make_shared<cstk_distance_result>();
    const auto ask = [=, &at](std::size_t query) {
        const auto &q = at[query].q;
        cstk::check(
            cstk_distance(query_.get(), cobject_.get(), q.data(), q.size(), INFINITY, found.get()));
    };
    return {"cstk", "", [this] { query_ = cstk::Query(); }, ask,
            [found] { return found->distance; }};
}

Asked Ours::witnesses(const std::vector<Station> &at, double epsilon) {
    return listed(at, epsilon, true);
}

Asked Ours::near_objects(const std::vector<Station> &at, double epsilon) {
    return listed(at, epsilon, false);
}

Asked Ours::listed(const std::vector<Station> &at, double epsilon, bool primitives) {
    // More than there are: none is cut off.
    const std::size_t most = std::size_t{1} << 24;
    const auto found = std::make_shared<cstk_witness_list>();
    const auto ask = [=, &at](std::size_t query) {
        const auto &q = at[query].q;
        cstk::check(cstk_witnesses(query_.get(), cobject_.get(), q.data(), q.size(), epsilon, most,
                                   found.get()));
    };
    const auto answer = [=] {
        std::set<std::uint64_t> marks;
        for (std::size_t i = 0; i < found->witness_count; ++i) {
            const cstk_witness &w = found->witnesses[i];
            const auto place =
                std::lower_bound(ids_.begin(), ids_.end(), w.s_object) - ids_.begin();
            const auto object = static_cast<std::size_t>(place);
            marks.insert(primitives ? mark(w.r_link, object, w.r_tag, w.s_tag)
                                    : mark(w.r_link, object));
        }
        std::uint64_t sum = 0;
        for (const std::uint64_t one : marks) {
            sum += one;
        }
        return as_number(sum);
    };
    return {"cstk", "", [this] { query_ = cstk::Query(); }, ask, answer};
}

Asked Ours::after_moves(const std::vector<Station> &at, const std::vector<Step> &steps,
                        const Step &home, Timed timed) {
    const auto found = std::make_shared<cstk_class>(CSTK_CLASS_OUTSIDE);
    const auto changes = std::make_shared<std::vector<Changes>>();
    for (const Step &step : steps) {
        changes->push_back(moves(step));
    }
    const Changes back = moves(home);
    const auto begin = [=, &at] {
        apply(back);
        query_ = cstk::Query();
        class_at(at[0]);
    };
    const auto change = [=](std::size_t query) { apply((*changes)[query]); };
    const auto classify = [=, &at](std::size_t query) { *found = class_at(at[query]); };
    return timed_after("cstk", "", begin, change, classify, [found] { return number_of(*found); },
                       timed);
}

Ours::Changes Ours::moves(const Step &step) const {
    Changes changes;
    for (std::size_t i = 0; i < step.moved.size(); ++i) {
        const std::uint64_t id = ids_[step.moved[i]];
        changes.push_back(cstk::Environment::change(CSTK_CHANGE_MOVE, id, nullptr, step.to[i]));
    }
    return changes;
}

void Ours::apply(const Changes &changes) const {
    cstk::check(cstk_environment_apply(environment_.get(), changes.data(), changes.size(), nullptr,
                                       nullptr));
}

cstk_class Ours::class_at(const Station &at) const {
    cstk_class found = CSTK_CLASS_OUTSIDE;
    cstk::check(cstk_classify(query_.get(), cobject_.get(), at.q.data(), at.q.size(), &found));
    return found;
}

cstk::Space single_body(const Shape &shape) {
    cstk::Link link;
    link.body = shape.body;
    cstk::RobotBuilder builder;
    builder.add_link(link);
    return cstk::Space(builder.build());
}
