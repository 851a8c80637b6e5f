// Our queries.
#pragma once

#include "asked.hpp"
#include "scenes.hpp"

#include <vector>

// The links of a space against the objects of a scene.
class Ours {
  public:
    Ours(const cstk::Space &space, const Scene &scene);

    bool within(const LinkPoses &at, double threshold);

    // The ways to answer are valid as long as this and the stations are. They ask the C functions,
    // by configurations.
    Asked classify(const std::vector<Station> &at);
    Asked distance(const std::vector<Station> &at);
    // All pairs of primitives within a distance, with their contacts. The answer is the set of the
    // pairs of primitives.
    Asked witnesses(const std::vector<Station> &at, double epsilon);
    // The same; the answer is the set of the pairs of link and object.
    Asked near_objects(const std::vector<Station> &at, double epsilon);
    // Objects moved; what is measured of it, and of the class then. Before a pass all objects are
    // moved home.
    Asked after_moves(const std::vector<Station> &at, const std::vector<Step> &steps,
                      const Step &home, Timed timed);

  private:
    using Changes = std::vector<cstk_environment_change>;

    Changes moves(const Step &step) const;
    void apply(const Changes &changes) const;
    cstk_class class_at(const Station &at) const;
    Asked listed(const std::vector<Station> &at, double epsilon, bool primitives);

    cstk::Environment environment_;
    std::vector<std::uint64_t> ids_;
    cstk::CObject cobject_;
    cstk::Query query_;
};

// A space in which one body is wherever it is said to be.
cstk::Space single_body(const Shape &shape);
