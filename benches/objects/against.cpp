#include "against.hpp"

#include "fcl_placed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using models::Random;

// Of the first pose, and from one query to the next.
const double largest_step = 0.01, largest_turn = 0.05;

cstk::Pose random_pose(const std::array<double, 3> &at, double turn, Random &random) {
    const models::Point axis = random.direction();
    return cstk::pose_from_quaternion({at[0], at[1], at[2], std::sin(turn / 2) * axis[0], std::sin(turn / 2) * axis[1],
                                       std::sin(turn / 2) * axis[2], std::cos(turn / 2)});
}

cstk::Pose moved(const cstk::Pose &from, double by, Random &random) {
    const std::array<double, 3> origin = {0, 0, 0};
    const cstk::Pose turn = random_pose(origin, random.uniform(-largest_turn, largest_turn), random);
    cstk::Pose out = cstk::compose(from, turn);
    for (std::size_t k = 0; k < 3; ++k) {
        out[4 * k + 3] += random.uniform(-by, by);
    }
    return out;
}

template <class Place> Boxes boxes(std::size_t count, std::size_t queries, std::uint64_t seed, double step, Place place) {
    Random random(seed);
    Boxes made;
    std::vector<cstk::Pose> first;
    for (std::size_t i = 0; i < count; ++i) {
        made.half_extents.push_back({random.uniform(0.01, 0.06), random.uniform(0.01, 0.06), random.uniform(0.01, 0.06)});
        first.push_back(random_pose(place(i, random), random.uniform(0, models::pi), random));
    }
    made.poses.push_back(first);
    while (made.poses.size() < queries) {
        std::vector<cstk::Pose> next;
        // From the first, so that the grid's boxes stay apart.
        for (const cstk::Pose &pose : first) {
            next.push_back(moved(pose, step, random));
        }
        made.poses.push_back(std::move(next));
    }
    return made;
}

} // namespace

Boxes meeting_boxes(std::size_t count, std::size_t queries, std::uint64_t seed) {
    const double half = 0.5 * std::cbrt(static_cast<double>(count) / 200);
    return boxes(count, queries, seed, largest_step, [=](std::size_t, Random &random) {
        return std::array<double, 3>{random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
    });
}

Boxes boxes_apart(std::size_t count, std::size_t queries, std::uint64_t seed) {
    // The diagonal of the largest box, both boxes' steps, and a little.
    const double spacing = 2 * (0.06 * std::sqrt(3.0) + largest_step * std::sqrt(3.0)) + 0.01;
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
    return boxes(count, queries, seed, largest_step, [=](std::size_t i, Random &) {
        const std::array<std::size_t, 3> cell = {i % side, i / side % side, i / side / side};
        std::array<double, 3> at = {};
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = spacing * static_cast<double>(cell[k]);
        }
        return at;
    });
}

struct Against::Ours {
    Ours(const Boxes &boxes, bool two_sets) : boxes(boxes), split(two_sets ? boxes.half_extents.size() / 2 : boxes.half_extents.size()) {
        for (std::size_t i = 0; i < boxes.half_extents.size(); ++i) {
            const auto &half = boxes.half_extents[i];
            cstk::BodyBuilder builder;
            builder.add_box(cstk::identity(), half);
            cstk::Environment &world = i < split ? first : second;
            ids.push_back(world.add(builder.build(), boxes.poses[0][i]));
        }
        for (const auto &poses : boxes.poses) {
            std::vector<cstk_environment_change> all;
            for (std::size_t i = 0; i < poses.size(); ++i) {
                all.push_back(cstk::Environment::change(CSTK_CHANGE_MOVE, ids[i], nullptr, poses[i]));
            }
            changes.push_back(std::move(all));
        }
    }

    const cstk::Environment *other() const { return split < ids.size() ? &second : nullptr; }

    void move(std::size_t query) const {
        const cstk_environment_change *all = changes[query].data();
        cstk::check(cstk_environment_apply(first.get(), all, split, nullptr, nullptr));
        if (split < ids.size()) {
            cstk::check(cstk_environment_apply(second.get(), all + split, ids.size() - split, nullptr, nullptr));
        }
    }

    std::size_t number(std::uint64_t id) const {
        return static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
    }

    const Boxes &boxes;
    std::size_t split;
    cstk::Environment first, second;
    std::vector<std::uint64_t> ids;
    std::vector<std::vector<cstk_environment_change>> changes;
    cstk::Query query;
};

struct Against::Fcl {
    using Manager = fcl::DynamicAABBTreeCollisionManager<double>;
    using Object = fcl::CollisionObject<double>;

    Fcl(const Boxes &boxes, bool two_sets) : split(two_sets ? boxes.half_extents.size() / 2 : boxes.half_extents.size()) {
        for (const auto &all : boxes.poses) {
            poses.push_back(transforms(all));
        }
        for (std::size_t i = 0; i < boxes.half_extents.size(); ++i) {
            const auto &half = boxes.half_extents[i];
            auto box = std::make_shared<fcl::Box<double>>(2 * half[0], 2 * half[1], 2 * half[2]);
            box->computeLocalAABB();
            placed.push_back(std::make_unique<Placed>(box, nothing, i));
            placed.back()->place(poses[0][i]);
            (i < split ? first : second).registerObject(placed.back().get());
        }
        first.setup();
        second.setup();
    }

    void move(std::size_t query) {
        for (std::size_t i = 0; i < placed.size(); ++i) {
            placed[i]->place(poses[query][i]);
        }
        first.update();
        second.update();
    }

    void meet() {
        marks = 0;
        if (split < placed.size()) {
            first.collide(&second, this, add_meeting);
        } else {
            first.collide(this, add_meeting);
        }
    }

    void measure() {
        least = std::numeric_limits<double>::max();
        if (split < placed.size()) {
            first.distance(&second, this, lower_least);
        } else {
            first.distance(this, lower_least);
        }
    }

    static bool add_meeting(Object *a, Object *b, void *data) {
        Fcl &self = *static_cast<Fcl *>(data);
        fcl::CollisionResult<double> result;
        if (fcl::collide(a, b, self.any_contact, result) > 0) {
            const std::size_t i = static_cast<Placed *>(a)->number, j = static_cast<Placed *>(b)->number;
            self.marks += mark(std::min(i, j), std::max(i, j));
        }
        return false;
    }

    static bool lower_least(Object *a, Object *b, void *data, double &bound) {
        Fcl &self = *static_cast<Fcl *>(data);
        fcl::DistanceResult<double> result;
        fcl::distance(a, b, self.distance_alone, result);
        self.least = std::min(self.least, std::max(result.min_distance, 0.0));
        bound = self.least;
        return self.least <= 0;
    }

    std::size_t split;
    models::Mesh nothing;
    std::vector<std::vector<Transform>> poses;
    std::vector<std::unique_ptr<Placed>> placed;
    Manager first, second;
    const fcl::CollisionRequest<double> any_contact{1, false};
    const fcl::DistanceRequest<double> distance_alone{false};
    std::uint64_t marks = 0;
    double least = 0;
};

Against::Against(Boxes boxes, bool two_sets)
    : boxes_(std::move(boxes)), ours_(std::make_unique<Ours>(boxes_, two_sets)), fcl_(std::make_unique<Fcl>(boxes_, two_sets)) {}
Against::~Against() = default;

namespace {

// A question after a move, which is measured with it or not.
Asked after_move(std::string library, std::string variant, std::function<void()> begin, std::function<void(std::size_t)> move,
                 std::function<void()> ask, std::function<double()> answer, bool with_moves) {
    Asked made{std::move(library), std::move(variant), std::move(begin), {}, std::move(answer), {}};
    if (with_moves) {
        made.ask = [=](std::size_t query) {
            move(query);
            ask();
        };
    } else {
        made.prepare = move;
        made.ask = [=](std::size_t) { ask(); };
    }
    return made;
}

} // namespace

Question Against::meeting(bool with_moves) {
    Ours &ours = *ours_;
    Fcl &fcl = *fcl_;
    const auto list = std::make_shared<cstk_object_pair_list>();
    const std::size_t all = std::numeric_limits<std::size_t>::max();
    const auto ask = [&ours, list, all] {
        cstk::check(cstk_environment_pairs(ours.query.get(), ours.first.get(), ours.other() ? ours.second.get() : nullptr, 0, all,
                                           nullptr, list.get()));
    };
    const auto sum = [&ours, list] {
        std::uint64_t marks = 0;
        for (std::size_t i = 0; i < list->count; ++i) {
            const std::size_t a = ours.number(list->pairs[i].r_object), b = ours.number(list->pairs[i].s_object);
            marks += mark(std::min(a, b), std::max(a, b));
        }
        return as_number(marks);
    };
    Question question{boxes_.half_extents.size(), {}, {}};
    question.ours = after_move("cstk", "", [&ours] { ours.query = cstk::Query(); }, [&ours](std::size_t q) { ours.move(q); }, ask, sum,
                               with_moves);
    question.peers.push_back(after_move("FCL", "Box", [] {}, [&fcl](std::size_t q) { fcl.move(q); }, [&fcl] { fcl.meet(); },
                                        [&fcl] { return as_number(fcl.marks); }, with_moves));
    return question;
}

Question Against::nearest(bool with_moves) {
    Ours &ours = *ours_;
    Fcl &fcl = *fcl_;
    const auto found = std::make_shared<cstk_distance_result>();
    const auto ask = [&ours, found] {
        cstk::check(cstk_environment_distance(ours.query.get(), ours.first.get(), ours.other() ? ours.second.get() : nullptr,
                                              std::numeric_limits<double>::infinity(), nullptr, found.get()));
    };
    Question question{boxes_.half_extents.size(), {}, {}};
    question.ours = after_move("cstk", "", [&ours] { ours.query = cstk::Query(); }, [&ours](std::size_t q) { ours.move(q); }, ask,
                               [found] { return found->distance; }, with_moves);
    question.peers.push_back(after_move("FCL", "Box", [] {}, [&fcl](std::size_t q) { fcl.move(q); }, [&fcl] { fcl.measure(); },
                                        [&fcl] { return fcl.least; }, with_moves));
    return question;
}
