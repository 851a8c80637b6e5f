// How long each variant takes for each motion of a row.
#pragma once

#include "variant.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// One variant on motions of one scene, length and kind.
struct Row {
    std::string scene;
    double length;
    Kind kind;
    std::string library, variant;
    /// Of each motion the median of its times. A slow variant is asked about the first motions only.
    std::vector<double> microseconds;
    /// Of each motion Verdict::checks or Variant::work; 0 where the variant counts nothing.
    std::vector<std::size_t> checks = {};
    /// Answers that differ from the proof's: hits called free, or free motions called hits.
    std::size_t differing = 0;
    /// Hits whose time of contact is off by more than 1 % of the motion, for a variant that looks for the first contact.
    std::size_t off_in_time = 0;
    /// Which motions differ.
    std::vector<std::size_t> which = {};

    double median() const;
    double mean() const;
    double mean_checks() const;
};

/// Asks each variant in turn, in several passes; `budget` is about how many seconds a variant may take.
std::vector<Row> measure(const std::string &scene, double length, Kind kind,
                         const std::vector<Variant> &variants,
                         const std::vector<Segment> &segments, double budget);
