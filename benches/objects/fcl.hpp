// FCL's answers: DynamicAABBTreeCollisionManager over the objects of a scene.
#pragma once

#include "asked.hpp"
#include "scenes.hpp"

#include <memory>
#include <vector>

// All the ways FCL is asked, of which the fastest counts; the answers are those of Ours.
class Fcl {
  public:
    Fcl(const Arm &arm, const Scene &scene);
    ~Fcl();

    std::vector<Asked> classify(const std::vector<Station> &at);
    std::vector<Asked> distance(const std::vector<Station> &at);
    // Each pair of link and object whose boxes are within epsilon: all pairs of triangles within
    // epsilon, with their nearest points, by a traversal of FCL's that was made to go on.
    std::vector<Asked> witnesses(const std::vector<Station> &at, double epsilon);
    // The same pairs of link and object by FCL's own calls, which give less: the contacts of those
    // that meet, and the nearest points of the others.
    std::vector<Asked> near_objects(const std::vector<Station> &at, double epsilon);
    std::vector<Asked> after_moves(const std::vector<Station> &at, const std::vector<Step> &steps,
                                   const Step &home, Timed timed);

  private:
    struct Managers;
    std::unique_ptr<Managers> managers_;
};
