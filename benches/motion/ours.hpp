// The library's ways: the proof, and what callers wrote before it over the library's queries at configurations.
#pragma once

#include "variant.hpp"

#include <vector>

/// Each way has a query context of its own. The scene must live as long as they do.
std::vector<Variant> our_variants(const Scene &scene);
