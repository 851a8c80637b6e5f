// A cstk_space as a state space of OMPL.
#pragma once

#include <cstk.hpp>

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cstk_ompl {

/// States are configurations: `values` holds the space's nq coordinates. Distances, interpolation, samples and limits are those of
/// the cstk_space, so that circles and rotations are what they are, whatever the robot's joints. Every coordinate needs a bounded
/// range; the constructor throws cstk::Error where one has none.
///
/// The bounds of OMPL are the ranges of coordinates. A world box is none of them, since states drawn within the ranges may leave it: it
/// is an obstacle, which ValidityChecker and MotionValidator add to the set that they are given.
class StateSpace : public ompl::base::RealVectorStateSpace {
  public:
    /// `is_metric` is false for robots with free joints: see cstk_space_distance.
    explicit StateSpace(const cstk::Space &space, bool is_metric = true)
        : RealVectorStateSpace(static_cast<unsigned int>(space.nq())), space_(space), is_metric_(is_metric) {
        const double pi = std::acos(-1.0);
        std::uint64_t random = 0;
        static_cast<void>(space.sample(random));
        setName("cstk" + getName());
        bool has_rotation = false;
        for (unsigned int i = 0; i < space.nq(); ++i) {
            const cstk_range range = space.range(i);
            if (range.kind == CSTK_RANGE_INTERVAL) {
                bounds_.setLow(i, range.lower);
                bounds_.setHigh(i, range.upper);
                square_extent_ += (range.upper - range.lower) * (range.upper - range.lower);
            } else if (range.kind == CSTK_RANGE_CIRCLE) {
                bounds_.setLow(i, -pi);
                bounds_.setHigh(i, pi);
                square_extent_ += pi * pi;
            } else {
                // Two rotations are at most pi apart: a quarter of its square for each coordinate of a quaternion.
                bounds_.setLow(i, -1);
                bounds_.setHigh(i, 1);
                square_extent_ += pi * pi / 4;
                has_rotation = true;
            }
        }
        if (has_rotation) {
            // Free joints go on screws: turned by up to pi, the way is up to pi / 2 times as long as the straight one.
            square_extent_ *= pi * pi / 4;
        }
    }

    const cstk::Space &space() const { return space_; }

    cstk::Span<double> configuration(const ompl::base::State *state) const {
        return {state->as<StateType>()->values, space_.nq()};
    }

    void set(ompl::base::State *state, const std::vector<double> &q) const {
        std::copy(q.begin(), q.end(), state->as<StateType>()->values);
    }

    /// Samplers that are allocated from now on draw the same states for the same seed; without one, OMPL's generator seeds them.
    void set_seed(std::uint64_t seed) { seed_ = seed; }

    double getMaximumExtent() const override { return std::sqrt(square_extent_); }
    bool isMetricSpace() const override { return is_metric_; }

    double distance(const ompl::base::State *a, const ompl::base::State *b) const override {
        return space_.distance(configuration(a), configuration(b));
    }

    bool equalStates(const ompl::base::State *a, const ompl::base::State *b) const override {
        return distance(a, b) <= 4 * std::numeric_limits<double>::epsilon();
    }

    void interpolate(const ompl::base::State *from, const ompl::base::State *to, double t,
                     ompl::base::State *state) const override {
        set(state, space_.interpolate(configuration(from), configuration(to), t));
    }

    bool satisfiesBounds(const ompl::base::State *state) const override {
        return space_.within_limits(configuration(state));
    }

    /// What to keep out of: the set, and all configurations with a link beyond the world box, if the space has one.
    cstk::CObject with_world(const cstk::CObject &contact) const {
        const cstk::CObject beyond = cstk::CObject::beyond_world(space_);
        std::uint64_t random = 0;
        const bool is_everywhere = cstk::Query().distance(beyond, space_.sample(random)).kind == CSTK_DISTANCE_EMPTY;
        return is_everywhere ? contact : cstk::CObject::union_of({contact, beyond});
    }

    void enforceBounds(ompl::base::State *state) const override {
        set(state, space_.clamp(space_.wrap(configuration(state))));
    }

    ompl::base::StateSamplerPtr allocDefaultStateSampler() const override { return std::make_shared<Sampler>(this); }

  private:
    class Sampler : public ompl::base::StateSampler {
      public:
        explicit Sampler(const StateSpace *space) : StateSampler(space), to_(*space) {
            if (space->seed_) {
                rng_.setLocalSeed(static_cast<std::uint_fast32_t>(*space->seed_));
            }
            random_ = space->seed_.value_or(static_cast<std::uint64_t>(rng_.uniformInt(0, 1 << 30)));
        }

        void sampleUniform(ompl::base::State *state) override { to_.set(state, to_.space().sample(random_)); }

        void sampleUniformNear(ompl::base::State *state, const ompl::base::State *near, double distance) override {
            std::vector<double> velocity(to_.space().nv());
            rng_.uniformInBall(distance, velocity);
            step(state, near, velocity);
        }

        void sampleGaussian(ompl::base::State *state, const ompl::base::State *mean, double deviation) override {
            std::vector<double> velocity(to_.space().nv());
            for (double &x : velocity) {
                x = rng_.gaussian(0, deviation);
            }
            step(state, mean, velocity);
        }

      private:
        void step(ompl::base::State *state, const ompl::base::State *from, const std::vector<double> &velocity) const {
            to_.set(state, to_.space().step(to_.configuration(from), velocity));
            to_.enforceBounds(state);
        }

        const StateSpace &to_;
        std::uint64_t random_;
    };

    cstk::Space space_;
    bool is_metric_;
    double square_extent_ = 0;
    std::optional<std::uint64_t> seed_;
};

} // namespace cstk_ompl
