#include "check.hpp"
#include "subjects.hpp"

#include <vector>

void regions(cstk::Query &query, const cstk::CObject &obstacles, const std::vector<double> &q) {
    const std::vector<double> low = {-1, -1}, high = {2.9, 1}, beyond = {3.5, 1};
    REQUIRE(query.region_classify(obstacles, low, high).outcome == CSTK_REGION_FREE);
    std::vector<double> inside, outside;
    const cstk_region_result mixed = query.region_classify(obstacles, low, beyond,
                                                           cstk::region_options(), &inside, &outside);
    REQUIRE(mixed.outcome == CSTK_REGION_MIXED && inside.size() == 2 && outside.size() == 2);
    REQUIRE(query.classify(obstacles, inside) == CSTK_CLASS_INSIDE);
    REQUIRE(query.classify(obstacles, outside) != CSTK_CLASS_INSIDE);
    const cstk::GrownRegion grown = query.region_grow(obstacles, q, std::vector<double>{1, 1});
    REQUIRE(grown.low[0] < q[0] && grown.high[0] > 2.9 && grown.high[0] < 3 + 1e-9);
    REQUIRE(grown.sides.size() == 4);
}
