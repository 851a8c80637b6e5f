/* Part of cstk.hpp: motions proved free, and their clearances. */
#ifndef CSTK_MOTION_HPP
#define CSTK_MOTION_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/certificate.hpp>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/span.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

namespace cstk {

/// The default options of a motion.
[[nodiscard]] inline cstk_motion_options motion_options(double threshold = 0) {
    cstk_motion_options options;
    check(cstk_motion_options_default(&options, sizeof options));
    options.threshold = threshold;
    return options;
}

/// The options of a clearance, whose bounds are to be within the tolerance.
[[nodiscard]] inline cstk_clearance_options clearance_options(double tolerance) {
    cstk_clearance_options options;
    check(cstk_clearance_options_default(&options, sizeof options));
    options.tolerance = tolerance;
    return options;
}

namespace detail {

/* A function that gives a motion. What it throws is kept, and thrown again after the call: no exception may pass through C. */
template <typename F> struct Motion {
    F &function;
    std::exception_ptr thrown;

    void check(cstk_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        cstk::check(status);
    }

    static std::int32_t call(double t, double *q, double *rates, double *accelerations, std::size_t,
                             void *user) noexcept {
        Motion &motion = *static_cast<Motion *>(user);
        try {
            motion.function(t, q, rates, accelerations);
            return 0;
        } catch (...) {
            motion.thrown = std::current_exception();
            return 1;
        }
    }
};

/// What Query answers of motions.
template <typename Query> class MotionQueries {
public:
    /// Proves the motion from q0 to q1 free, or finds its first contact; `reached`, if given, receives the configuration there.
    [[nodiscard]] cstk_motion_result motion(const CObject &cobject, Span<double> q0, Span<double> q1,
                              const cstk_motion_options &options = motion_options(),
                              std::vector<double> *reached = nullptr) {
        cstk_motion_result out;
        const std::size_t nq = detail::same_size(q0, q1);
        /* Planners ask for many motions and for few contacts: nothing is allocated for what is not wanted. */
        std::vector<double> found(reached != nullptr ? nq : 0);
        check(cstk_motion(query_of(*this), cobject.get(), q0.data(), q1.data(), nq, &options,
                          reached != nullptr ? found.data() : nullptr, &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same with a certificate, which is empty where the motion is not free; `result`, if given, receives how it ends.
    [[nodiscard]] Certificate motion_certificate(const CObject &cobject, Span<double> q0, Span<double> q1,
                                   const cstk_motion_options &options = motion_options(),
                                   cstk_motion_result *result = nullptr,
                                   std::vector<double> *reached = nullptr) {
        cstk_certificate *certificate = nullptr;
        cstk_motion_result out;
        std::vector<double> found(detail::same_size(q0, q1));
        check(cstk_motion_certificate(query_of(*this), cobject.get(), q0.data(), q1.data(), q0.size(), &options,
                                      found.data(), &out, &certificate));
        Certificate made(certificate);
        if (result != nullptr) {
            *result = out;
        }
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return made;
    }

    /// The same on a Bezier curve: `points` holds `count` control points, one configuration after the other.
    [[nodiscard]] cstk_motion_result motion_curve(const CObject &cobject, Span<double> points, std::size_t count,
                                    const cstk_motion_options &options = motion_options(),
                                    std::vector<double> *reached = nullptr) {
        cstk_motion_result out;
        std::vector<double> found(detail::parts_of(points, count));
        check(cstk_motion_curve(query_of(*this), cobject.get(), points.data(), count, found.size(), &options,
                                found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same on a B-spline with `count` control points and count + degree + 1 knots.
    [[nodiscard]] cstk_motion_result motion_spline(const CObject &cobject, std::size_t degree, Span<double> knots,
                                     Span<double> points, std::size_t count,
                                     const cstk_motion_options &options = motion_options(),
                                     std::vector<double> *reached = nullptr) {
        cstk_motion_result out;
        std::vector<double> found(detail::parts_of(points, count));
        check(cstk_motion_spline(query_of(*this), cobject.get(), degree, knots.data(), knots.size(),
                                 points.data(), count, found.size(), &options, found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same on a motion that `function` gives: function(t, q, rates, accelerations) writes the configuration at time t and the
    /// derivatives of its coordinates, each list as long as max_rates. The proof holds if the bounds do.
    template <typename F>
    [[nodiscard]] cstk_motion_result motion_function(const CObject &cobject, F &&function,
                                       Span<double> max_rates, Span<double> max_accelerations,
                                       const cstk_motion_options &options = motion_options(),
                                       std::vector<double> *reached = nullptr) {
        cstk_motion_result out;
        const std::size_t nq = detail::same_size(max_rates, max_accelerations);
        std::vector<double> found(nq);
        detail::Motion<F> motion{function, nullptr};
        motion.check(cstk_motion_function(query_of(*this), cobject.get(), &detail::Motion<F>::call, &motion,
                                          max_rates.data(), max_accelerations.data(), nq, &options,
                                          found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same of two bodies, each on a screw from its start to its end; `reached`, if given, receives both poses at the contact.
    [[nodiscard]] cstk_motion_result pair_motion(const Body &a, const Pose &start_a, const Pose &end_a,
                                   const Body &b, const Pose &start_b, const Pose &end_b,
                                   const cstk_motion_options &options = motion_options(),
                                   std::pair<Pose, Pose> *reached = nullptr) {
        cstk_motion_result out;
        double poses[24];
        check(cstk_pair_motion(query_of(*this), a.get(), start_a.data(), end_a.data(), b.get(), start_b.data(),
                               end_b.data(), &options, poses, &out));
        if (reached != nullptr) {
            std::copy(poses, poses + 12, reached->first.begin());
            std::copy(poses + 12, poses + 24, reached->second.begin());
        }
        return out;
    }

    /// The least distance along the motion from q0 to q1; `nearest`, if given, receives the configuration there.
    [[nodiscard]] cstk_clearance_result motion_clearance(const CObject &cobject, Span<double> q0, Span<double> q1,
                                           const cstk_clearance_options &options,
                                           std::vector<double> *nearest = nullptr) {
        cstk_clearance_result out;
        std::vector<double> found(detail::same_size(q0, q1));
        check(cstk_motion_clearance(query_of(*this), cobject.get(), q0.data(), q1.data(), q0.size(), &options,
                                    found.data(), &out));
        if (nearest != nullptr) {
            *nearest = std::move(found);
        }
        return out;
    }
};

} // namespace detail

} // namespace cstk

#endif
