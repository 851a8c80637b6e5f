#include "check.hpp"
#include "models.hpp"
#include "subjects.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

static std::int32_t beyond_three(const double *q, std::size_t, std::int32_t *out, void *calls) {
    ++*static_cast<int *>(calls);
    *out = q[0] >= 3 ? CSTK_CLASS_INSIDE : CSTK_CLASS_OUTSIDE;
    return CSTK_OK;
}

template <typename Action> static std::string thrown_by(Action action) {
    try {
        action();
    } catch (const std::domain_error &error) {
        return error.what();
    }
    return "";
}

void predicates(const cstk::Space &space) {
    cstk::Query query;
    int calls = 0;
    cstk_predicate plain = cstk::predicate();
    REQUIRE(status_of([&] { return cstk::CObject::predicate(space, plain); }) == CSTK_ERROR_NULL_ARGUMENT);
    plain.classify = beyond_three;
    plain.user = &calls;
    plain.destroy = count;
    cstk::CObject by_c = cstk::CObject::predicate(space, plain);
    REQUIRE(query.classify(by_c, {3, 0}) == CSTK_CLASS_INSIDE && calls == 1);
    by_c = cstk::CObject();
    REQUIRE(calls == 101);

    const auto kept = std::make_shared<double>(3);
    cstk::Predicate functions;
    REQUIRE(status_of([&] { return cstk::CObject::predicate(space, functions); }) == CSTK_ERROR_NULL_ARGUMENT);
    functions.classify = [kept](cstk::Span<double> q) {
        if (q.data()[1] == 1) {
            throw std::domain_error("mine");
        }
        return q.size() == 2 && q.data()[0] >= *kept ? CSTK_CLASS_INSIDE : CSTK_CLASS_OUTSIDE;
    };
    cstk::CObject by_class = cstk::CObject::predicate(space, functions);
    REQUIRE(query.distance(by_class, {1, 0}).kind == CSTK_DISTANCE_LOWER_BOUND);
    REQUIRE(query.classify(by_class, {3, 0}) == CSTK_CLASS_INSIDE);
    functions.distance = [kept](cstk::Span<double> q) { return *kept - q.data()[0]; };
    functions.gradient = [](cstk::Span<double> q) {
        return q.data()[1] == 2 ? std::vector<double>{-1} : std::vector<double>{-1, 0};
    };
    functions.knows_depth = true;
    cstk_pure_options doubled = cstk::pure_options();
    doubled.scale = 2;
    cstk::CObject set = cstk::CObject::predicate(space, std::move(functions), doubled);
    functions = cstk::Predicate();
    REQUIRE(query.distance(set, {1, 0}).distance == 4);
    REQUIRE(query.distance(set.complement(), {4, 0}).distance == 2);
    REQUIRE(query.gradients(set, {1, 0}, 5).gradients[0] == -2);
    REQUIRE(status_of([&] { return query.gradients(set, {1, 2}, 5); }) == CSTK_ERROR_CALLBACK_FAILED);
    for (int i = 0; i < 2; ++i) {
        REQUIRE(thrown_by([&] { (void)query.classify(set, {1, 1}); }) == "mine");
        REQUIRE(status_of([&] { return query.gradients(set, {1, 2}, 5); }) == CSTK_ERROR_CALLBACK_FAILED);
    }
    REQUIRE(status_of([&] {
                cstk::Predicate refused;
                refused.classify = [kept](cstk::Span<double>) { return CSTK_CLASS_OUTSIDE; };
                cstk_pure_options bad = cstk::pure_options();
                bad.contact_epsilon = -1;
                return cstk::CObject::predicate(space, refused, bad);
            }) == CSTK_ERROR_INVALID_ARGUMENT);
    by_class = cstk::CObject();
    REQUIRE(kept.use_count() > 1);
    set = cstk::CObject();
    REQUIRE(kept.use_count() == 1);
}
