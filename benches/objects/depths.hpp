// Depths of bodies that meet, and distances of curved surfaces refined within the query.
#pragma once

#include "table.hpp"

#include <cstddef>
#include <cstdint>

// Bounds of the depth of two unions of so many boxes each; of two boxes FCL's penetration too, which is not always the least: answers
// are not compared.
Question depth_of_unions(std::size_t parts, std::size_t queries, std::uint64_t seed);
// The same of two hulls.
Question depth_of_hulls(std::size_t queries, std::uint64_t seed);
// The distance of two bent sheets, Bezier patches of degree 3, whose bounds are at most `gap` apart: refined within the query, or
// built that fine.
Question distance_of_sheets(double gap, bool refined, std::size_t queries, std::uint64_t seed);
