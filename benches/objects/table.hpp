// Rows of the tables: the same question at every size of a scene, of us and of FCL, in turn.
#pragma once

#include "asked.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

// A question at one size: our way to answer it, and the other's.
struct Question {
    std::size_t objects;
    Asked ours;
    std::vector<Asked> peers;
};

class Table {
  public:
    // Runs everything `repeats` times; passes over rows whose scene and name do not hold `only`.
    Table(int repeats, std::string only) : repeats_(repeats), only_(std::move(only)) {}

    // The rows that follow are of this scene; the title is printed above the first.
    void start(const std::string &scene, const std::string &title);
    // Measures the row and prints it. Answers may differ by `allowed` of ours.
    void row(const std::string &name, std::size_t queries, double allowed,
             const std::function<std::vector<Question>()> &sizes);

    // The rows so far, as lines of a file.
    const std::string &csv() const { return csv_; }
    std::size_t compared() const { return compared_; }
    std::size_t differing() const { return differing_; }

  private:
    struct Measured;

    void compare(Measured &size, std::size_t queries, double allowed, const std::string &name);
    void print(const std::string &name, const std::vector<Measured> &sizes);

    int repeats_;
    std::string only_, scene_, title_;
    std::string csv_ = "scene,objects,query,library,variant,microseconds_per_query\n";
    std::size_t compared_ = 0, differing_ = 0;
};
