// The tables: times of each row, ratios, the worst rows, and what sampling misses.
#pragma once

#include "measure.hpp"

#include <string>
#include <vector>

class Table {
  public:
    /// Rows of one scene, length and kind, the proof first; prints the library's times.
    void add(const std::vector<Row> &rows, const std::vector<Segment> &segments);

    /// Prints the peers' times and the summaries.
    void finish() const;

    /// The rows so far, as lines of a file.
    std::string csv() const;

  private:
    struct Group {
        std::vector<Row> rows;
        std::vector<Segment> segments;

        const Row *find(const std::string &library, const std::string &variant) const;
    };

    void print_peers() const;
    void print_ratios() const;
    void print_worst() const;
    void print_slowest() const;
    void print_misses() const;
    void print_disagreements() const;

    std::vector<Group> groups_;
};
