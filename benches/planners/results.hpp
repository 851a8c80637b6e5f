// What planners did on the problems of a scene.
#pragma once

#include "variants.hpp"

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

struct Result {
    double milliseconds;
    std::size_t checks;
    Answer answer;
    /// FCL finds the path in contact somewhere.
    bool invalid;
    /// Of the path.
    std::size_t motions;
    double length;
};

/// The results of all runs of a variant.
class Results {
  public:
    void add(const Result &run) { runs_.push_back(run); }
    void add(const Results &others);

    void print(const std::string &scene, const Variant &variant, const Results &reference) const;

    static void print_head();

  private:
    double milliseconds(std::size_t percent) const;
    std::string solved() const;

    std::vector<Result> runs_;
};
