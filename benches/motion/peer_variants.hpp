// The samplings by FCL and Coal, each in its fastest way.
#pragma once

#include "variant.hpp"

#include <vector>

/// FCL's, Coal's, and for a body that moves freely FCL's continuous collision. The fastest of a library's ways is found on `trial`, and
/// named on standard error. The scene must live as long as the variants do.
std::vector<Variant> peer_variants(const Scene &scene, const std::vector<Segment> &trial);
