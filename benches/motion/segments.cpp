#include "segments.hpp"

#include "motion_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

// The samples that check an answer are so far apart where their number allows, in metres.
const double dense_step = 5e-4;

std::string numbers(const Numbers &q) {
    std::string text = "{";
    for (const double x : q) {
        char number[32];
        std::snprintf(number, sizeof number, "%s%.17g", text.size() > 1 ? ", " : "", x);
        text += number;
    }
    return text + "}";
}

// Checks answers of the proof; keeps what is wrong.
class Judge {
  public:
    Judge(const Scene &scene, const DrawOptions &options, std::vector<std::string> &faults)
        : scene_(scene), options_(options), faults_(faults) {}

    void check(const Segment &segment, const cstk_motion_result &proof, const Numbers &reached) {
        const bool is_hit = proof.outcome == CSTK_MOTION_HIT;
        if (is_hit && !is_inside(reached)) {
            fault(segment, "HIT, and the configuration reached is not inside");
        }
        const double end = is_hit ? proof.times[0] : 1;
        const double wanted = std::ceil(segment.speed * end / dense_step);
        const auto steps = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1,
                                                   options_.samples);
        for (std::size_t i = 0; i < steps; ++i) {
            const double t = end * static_cast<double>(i) / static_cast<double>(steps);
            const Ends &ends = segment.ends;
            if (is_inside(scene_.space.interpolate(ends.q0, ends.q1, t))) {
                char text[96];
                std::snprintf(text, sizeof text, "%s from %.9g on, and inside at t = %.17g",
                              is_hit ? "HIT" : "FREE", end, t);
                fault(segment, text);
                return;
            }
        }
    }

    void fault(const Segment &segment, const std::string &what) {
        char length[32];
        std::snprintf(length, sizeof length, ", length %g: ", segment.length);
        faults_.push_back(scene_.name + length + what + "\n  " + text_of(segment.ends));
    }

  private:
    bool is_inside(const Numbers &q) {
        return query_.classify(scene_.contact, q) == CSTK_CLASS_INSIDE;
    }

    const Scene &scene_;
    const DrawOptions &options_;
    std::vector<std::string> &faults_;
    cstk::Query query_;
};

} // namespace

std::string text_of(const Ends &ends) {
    return "q0 = " + numbers(ends.q0) + ", q1 = " + numbers(ends.q1);
}

Segments draw_segments(const Scene &scene, double length, const DrawOptions &options,
                       Random &random) {
    Segments made;
    cstk::Query query;
    Judge judge(scene, options, made.faults);
    cstk_motion_options any = cstk::motion_options();
    any.any_contact = 1;
    const auto is_full = [&](Kind kind) { return made.of(kind).size() >= options.count; };
    for (std::size_t i = 0; i < scene.tries && !(is_full(Kind::free) && is_full(Kind::hit)); ++i) {
        const std::optional<Ends> ends = scene.draw(length, random);
        if (!ends || query.classify(scene.contact, ends->q0) != CSTK_CLASS_OUTSIDE) {
            continue;
        }
        const cstk_motion_outcome quick =
            query.motion(scene.contact, ends->q0, ends->q1, any).outcome;
        const Kind kind = quick == CSTK_MOTION_FREE ? Kind::free : Kind::hit;
        if (is_full(kind)) {
            continue;
        }
        Numbers reached;
        const cstk_motion_result proof = query.motion(scene.contact, ends->q0, ends->q1,
                                                      cstk::motion_options(), &reached);
        const Segment segment = {*ends, length, highest_speed(scene, *ends), proof.times[1]};
        if (proof.outcome != CSTK_MOTION_FREE && proof.outcome != CSTK_MOTION_HIT) {
            ++made.near;
            continue;
        }
        if (proof.outcome != quick && quick != CSTK_MOTION_NEAR) {
            judge.fault(segment, "any_contact and the first contact disagree");
        }
        judge.check(segment, proof, reached);
        (proof.outcome == CSTK_MOTION_FREE ? made.free : made.hit).push_back(segment);
    }
    return made;
}
