// A library with one way to answer the queries of a row, and how long it takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// What is measured of changes and of the classes after them: the change and the class, the change
// alone, the first class after it, or the second.
enum class Timed { both, change, first_class, next_class };

struct Asked {
    std::string library, variant;
    // Before a pass: forgets what the last one left.
    std::function<void()> begin;
    // The query with this number: this is measured.
    std::function<void(std::size_t)> ask;
    // What the last query found, as a number.
    std::function<double()> answer;
    // Before each query, unmeasured; may be empty.
    std::function<void(std::size_t)> prepare = {};
};

// One way, at one size of a scene, as it is measured.
class Runner {
  public:
    Runner(Asked asked, std::size_t queries) : asked_(std::move(asked)), queries_(queries) {}

    const std::string &library() const { return asked_.library; }
    const std::string &variant() const { return asked_.variant; }

    // All queries, unmeasured.
    std::vector<double> answers();
    // All queries, so often that it takes a while; keeps the time.
    void run();
    // The median of the runs, microseconds a query.
    double microseconds() const;

  private:
    double pass();

    Asked asked_;
    std::size_t queries_;
    std::vector<double> times_;
};

// A change and a class, of which a part is measured. The class before is that of the query before.
Asked timed_after(std::string library, std::string variant, std::function<void()> begin,
                  std::function<void(std::size_t)> change,
                  std::function<void(std::size_t)> classify, std::function<double()> answer,
                  Timed timed);

// A number for a pair of a link and an object, or of their primitives too. The sum of those of a
// set stands for it.
inline std::uint64_t mark(std::size_t link, std::size_t object, std::size_t link_primitive = 0,
                          std::size_t object_primitive = 0) {
    std::uint64_t bits = 0;
    for (const std::uint64_t part : {link, object, link_primitive, object_primitive}) {
        bits = (bits + part + 1) * 0x9e3779b97f4a7c15u;
        bits ^= bits >> 29;
    }
    return bits * 0xbf58476d1ce4e5b9u;
}

// As an answer.
inline double as_number(std::uint64_t sum) { return static_cast<double>(sum >> 11); }
