// One way to tell whether a motion is free.
#pragma once

#include "segments.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

struct Verdict {
    bool is_hit = false;
    /// Configurations looked at; of the proof see Variant::work.
    std::size_t checks = 0;
    /// The time of contact, where the way tells it.
    std::optional<double> contact = {};
};

struct Variant {
    std::string library, name;
    std::function<Verdict(const Segment &)> ask;
    /// What the last call looked at, in place of Verdict::checks; asked outside the time.
    std::function<std::size_t()> work = {};
};
