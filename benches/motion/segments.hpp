// Motions of a length, free ones and ones that hit, and whether the proof's answer stands up to dense samples.
#pragma once

#include "scene.hpp"

#include <string>
#include <vector>

enum class Kind { free, hit };

inline const char *name_of(Kind kind) { return kind == Kind::free ? "free" : "hit"; }

struct Segment {
    Ends ends;
    double length;
    /// See highest_speed(), in metres.
    double speed;
    /// When the proof finds the first contact, as a part of the motion; 1 for free motions.
    double contact;
};

struct Segments {
    std::vector<Segment> free, hit;
    /// Motions of which the proof says neither: near, or undecided. Left out.
    std::size_t near = 0;
    /// Where the proof and the samples disagree: what is wrong, with the motion.
    std::vector<std::string> faults;

    const std::vector<Segment> &of(Kind kind) const { return kind == Kind::free ? free : hit; }
};

struct DrawOptions {
    /// So many of each kind, or as many as the scene's tries give.
    std::size_t count;
    /// At most so many samples of each motion to check the proof's answer.
    std::size_t samples;
};

Segments draw_segments(const Scene &scene, double length, const DrawOptions &options,
                       Random &random);

/// The motion in full digits.
std::string text_of(const Ends &ends);
