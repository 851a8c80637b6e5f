// What is asked of many configurations: one by one, and in batches.
#pragma once

#include "problem.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// The answers in short: numbers that must be the same whatever way they were asked.
using Answers = std::vector<double>;

struct Question {
    std::string name;
    /// How many of the configurations are asked: some questions take longer.
    std::size_t share;
    std::function<Answers(cstk::Query &query, const std::vector<double> &q, std::size_t count)> one_by_one;
    std::function<Answers(const cstk::Batch &batch, std::uint32_t threads, const std::vector<double> &q, std::size_t count)> batch;
};

/// Class, distance, distance with gradient, and motions from each configuration to the next.
std::vector<Question> questions(const problems::Workcell &workcell);
