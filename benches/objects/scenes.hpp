// Many objects about an arm, and where the arm stands.
#pragma once

#include "bodies.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

// A body that stands somewhere, by its place among the shapes.
struct Item {
    std::size_t shape;
    cstk::Pose pose;
};

struct Scene {
    std::vector<Shape> shapes;
    std::vector<Item> items;
};

// The poses of all links.
using LinkPoses = std::vector<cstk::Pose>;

// Where the arm stands.
struct Station {
    std::array<double, 6> q;
    LinkPoses links;
    bool meets;
};

// Objects that are moved at once, and where to.
struct Step {
    std::vector<std::size_t> moved;
    std::vector<cstk::Pose> to;
};

// All objects that steps move, and where they stood first.
Step back_home(const Scene &scene, const std::vector<Step> &steps);

// How far objects are moved.
enum class Jump { little, far };

// How many objects are near in every scene: all of the smallest.
const std::size_t near_count = 100;

class Ours;

// The arm, the near objects, and where the arm stands: at random, and along a closed way; half of
// it meets objects.
class Workplace {
  public:
    explicit Workplace(std::uint64_t seed);

    const Arm &arm() const { return arm_; }
    const std::vector<Station> &random() const { return random_; }
    const std::vector<Station> &coherent() const { return coherent_; }

    // The near objects, and others out of the arm's reach by several times that.
    Scene far(std::size_t count) const;
    // The near objects, and others as dense as these in a ball about all.
    Scene dense(std::size_t count) const;
    // The near objects, and smaller ones among them, clear of the arm where it was free.
    Scene crowded(std::size_t count) const;

    // `count` objects at a time are moved, by little, and turned; or each to where another stood
    // first, and turned.
    std::vector<Step> steps(const Scene &scene, std::size_t count, std::size_t steps,
                            Jump jump) const;

  private:
    Station station(const std::array<double, 6> &q, Ours &ours) const;
    std::vector<Station> round_trip(Ours &ours, models::Random &random) const;
    void find_random(models::Random &random);
    void find_coherent(models::Random &random);

    std::uint64_t seed_;
    Arm arm_;
    Scene near_;
    std::vector<Station> random_, coherent_;
};
