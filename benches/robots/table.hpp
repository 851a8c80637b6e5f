// Rows of the table: the same question, of us and of Pinocchio, in turn.
#pragma once

#include "way.hpp"

#include <cstddef>
#include <string>
#include <vector>

struct Row {
    std::string robot, with, poses;
    Query query;
};

/// Nanoseconds a pose: the median of so many passes of each way, in turn.
std::vector<double> medians(const std::vector<Way> &ways, std::size_t passes, std::size_t poses);

class Table {
  public:
    /// Each row is measured in so many passes over so many poses.
    Table(std::size_t passes, std::size_t poses) : passes_(passes), poses_(poses) {}

    /// Compares the answers, measures and prints.
    void row(const Row &row, const std::vector<Way> &ours, std::vector<Way> peers);
    /// Prints the means of the ratios and how many answers differ.
    void finish() const;

    /// The rows so far, as lines of a file.
    const std::string &csv() const { return csv_; }
    /// Answers that differ, but for ties.
    std::size_t differing() const { return differing_; }

  private:
    std::vector<double> answers(const Way &way) const;
    std::size_t compare(const Row &row, const std::vector<double> &ours, const Way &peer,
                        const std::vector<double> &theirs);
    std::vector<Way> fastest(const Row &row, std::vector<Way> peers,
                             const std::vector<double> &expected) const;

    std::size_t passes_, poses_;
    std::string csv_ = "case,poses,query,library,nanoseconds\n";
    std::vector<double> ratios_;
    std::string slowest_;
    std::size_t compared_ = 0, differing_ = 0;
};
