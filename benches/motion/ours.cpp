#include "ours.hpp"

#include "motion_bounds.hpp"
#include "sampling.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <limits>
#include <memory>
#include <numeric>

namespace {

// Contact is found this exactly, as a part of the motion: as cstk_motion's default.
const double tolerance = 1e-6;
// Advancement that needs more configurations gives up: the motion counts as one that hits.
const std::size_t max_checks = 5000;

Variant proof(const std::string &name, const cstk::CObject &contact, bool any_contact) {
    const auto query = std::make_shared<cstk::Query>();
    cstk_motion_options options = cstk::motion_options();
    options.tolerance = tolerance;
    options.any_contact = any_contact;
    const auto ask = [=](const Segment &segment) {
        const Ends &ends = segment.ends;
        cstk_motion_result found;
        cstk::check(cstk_motion(query->get(), contact.get(), ends.q0.data(), ends.q1.data(),
                                ends.q0.size(), &options, nullptr, &found));
        const bool is_hit = found.outcome != CSTK_MOTION_FREE;
        return Verdict{is_hit, 0, is_hit ? std::optional(found.times[1]) : std::nullopt};
    };
    const auto work = [query] {
        const cstk_query_statistics counted = query->statistics(true);
        return static_cast<std::size_t>(counted.node_pairs + counted.primitive_pairs);
    };
    return {"cstk", name, ask, work};
}

Variant sampling(const std::string &name, const Scene &scene, const cstk::CObject &contact, const Step &step) {
    const auto query = std::make_shared<cstk::Query>();
    const auto q = std::make_shared<Numbers>();
    const auto ask = [=, &scene](const Segment &segment) {
        return sampled(scene.space, segment, step, *q, [&](const Numbers &at) {
            cstk_class found = CSTK_CLASS_OUTSIDE;
            cstk::check(
                cstk_classify(query->get(), contact.get(), at.data(), at.size(), &found));
            return found == CSTK_CLASS_INSIDE;
        });
    };
    return {"cstk", name, ask};
}

// Each link with all obstacles, and each pair of links, is asked for its own distance and has its own bound: a link near the base moves
// little, however far the hand goes.
class Parts {
  public:
    explicit Parts(const Scene &scene) : scene_(scene), arms_(scene.robot) {
        const cstk_induced_options options = cstk::induced_options();
        for (const std::uint32_t link : scene.moving) {
            sets_.push_back({cstk::CObject::induced(scene.space, scene.environment, options, {link}),
                             link,
                             {}});
        }
        for (const LinkPair &pair : scene.pairs) {
            sets_.push_back(
                {cstk::CObject::induced_links(scene.space, {pair}, options), pair[0], pair[1]});
        }
        poses_.resize(scene.space.link_count());
    }

    std::size_t count() const { return sets_.size(); }

    /// Computes the bounds for a motion.
    void start(const Ends &ends) {
        ends_ = &ends;
        const Numbers v = scene_.space.difference(ends.q0, ends.q1);
        bounds_.clear();
        for (const Set &set : sets_) {
            bounds_.push_back(arms_.bound(set.link, set.other, ends.q0, v));
        }
    }

    /// How far the points of a part move at most on the whole motion.
    double bound(std::size_t part) const { return bounds_[part]; }

    /// The distances that follow are at this time.
    void place(double t) {
        q_.resize(ends_->q0.size());
        cstk::check(cstk_space_interpolate(scene_.space.get(), ends_->q0.data(), ends_->q1.data(),
                                           q_.size(), t, q_.data()));
        cstk::check(cstk_space_link_poses(scene_.space.get(), q_.data(), q_.size(),
                                          poses_.data()->data()));
    }

    /// Larger than `max_distance` where the distance is.
    double distance(std::size_t part, double max_distance) {
        return query_.distance_at_link_poses(sets_[part].cobject, poses_, max_distance).distance;
    }

    bool within(std::size_t part, double threshold) {
        return query_.within_at_link_poses(sets_[part].cobject, poses_, threshold);
    }

  private:
    struct Set {
        cstk::CObject cobject;
        std::uint32_t link;
        std::optional<std::uint32_t> other;
    };

    const Scene &scene_;
    LeverArms arms_;
    std::vector<Set> sets_;
    cstk::Query query_;
    const Ends *ends_ = nullptr;
    std::vector<double> bounds_;
    Numbers q_;
    std::vector<cstk::Pose> poses_;
};

// Conservative advancement: a part whose distance is d is free until it has moved by d.
class Advancement {
  public:
    explicit Advancement(const Scene &scene) : parts_(scene) {}

    Verdict ask(const Segment &segment) {
        parts_.start(segment.ends);
        free_until_.assign(parts_.count(), 0);
        for (std::size_t checks = 1; checks <= max_checks; ++checks) {
            const double t = *std::min_element(free_until_.begin(), free_until_.end());
            if (t > 1) {
                return {false, checks - 1, {}};
            }
            parts_.place(t);
            for (std::size_t part = 0; part < free_until_.size(); ++part) {
                if (free_until_[part] > t) {
                    continue;
                }
                // A distance beyond what is left of the motion ends it.
                const double left = parts_.bound(part) * (1 - t);
                const double distance = parts_.distance(part, left);
                if (distance > left) {
                    free_until_[part] = std::numeric_limits<double>::infinity();
                    continue;
                }
                const double step = distance / parts_.bound(part);
                if (distance <= 0 || step < tolerance) {
                    return {true, checks, t};
                }
                free_until_[part] = t + step;
            }
        }
        return {true, max_checks, {}};
    }

  private:
    Parts parts_;
    std::vector<double> free_until_;
};

// Bisection: a part is free over an interval if its distance at the middle is more than it moves on half of it; otherwise both halves
// are looked at, the longest intervals first.
class Bisection {
  public:
    explicit Bisection(const Scene &scene) : parts_(scene) {}

    Verdict ask(const Segment &segment) {
        parts_.start(segment.ends);
        std::vector<std::size_t> all(parts_.count());
        std::iota(all.begin(), all.end(), std::size_t{0});
        intervals_.clear();
        intervals_.push_back({0.5, 0.5, std::move(all)});
        std::size_t checks = 0;
        while (!intervals_.empty()) {
            const Interval interval = std::move(intervals_.front());
            intervals_.pop_front();
            parts_.place(interval.middle);
            ++checks;
            std::vector<std::size_t> left;
            for (const std::size_t part : interval.parts) {
                if (parts_.within(part, parts_.bound(part) * interval.half)) {
                    if (parts_.within(part, 0)) {
                        return {true, checks, interval.middle};
                    }
                    left.push_back(part);
                }
            }
            if (left.empty()) {
                continue;
            }
            if (2 * interval.half < tolerance || checks >= max_checks) {
                return {true, checks, {}};
            }
            const double half = 0.5 * interval.half;
            intervals_.push_back({interval.middle - half, half, left});
            intervals_.push_back({interval.middle + half, half, std::move(left)});
        }
        return {false, checks, {}};
    }

  private:
    struct Interval {
        double middle, half;
        std::vector<std::size_t> parts;
    };

    Parts parts_;
    std::deque<Interval> intervals_;
};

template <class Way> Variant made(const Scene &scene, const char *name) {
    const auto way = std::make_shared<Way>(scene);
    return {"cstk", name, [way](const Segment &segment) { return way->ask(segment); }};
}

cstk::CObject contact_with_pairs_proved(const Scene &scene) {
    const cstk::CObject obstacles = cstk::CObject::induced(scene.space, scene.environment,
                                                           cstk::induced_options(), scene.moving);
    const auto start = std::chrono::steady_clock::now();
    const cstk::CObject links = cstk::CObject::induced_links(scene.space, scene.pairs);
    cstk_clear_pair_summary summary;
    const cstk::CObject proved =
        cstk::Query().prove_clear_pairs(links, cstk::clear_pair_options(), &summary);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::fprintf(stderr, "\n%s: %zu of %zu pairs proved in %.0f %% of their cells, %.1f s\n", scene.name.c_str(),
                 summary.proved_count, summary.pair_count, 100 * summary.proved_share, seconds.count());
    return cstk::CObject::union_of({obstacles, proved});
}

} // namespace

std::vector<Variant> our_variants(const Scene &scene) {
    std::vector<Variant> all = {proof("proof", scene.contact, false), proof("proof any", scene.contact, true)};
    for (const Step &step : steps) {
        all.push_back(sampling(step.name, scene, scene.contact, step));
    }
    all.push_back(made<Advancement>(scene, "advancement"));
    all.push_back(made<Bisection>(scene, "bisection"));
    if (!scene.pairs.empty()) {
        const cstk::CObject proved = contact_with_pairs_proved(scene);
        all.push_back(proof("proof with pairs proved", proved, false));
        for (const Step &step : steps) {
            all.push_back(sampling(std::string(step.name) + " with pairs proved", scene, proved, step));
        }
    }
    return all;
}
