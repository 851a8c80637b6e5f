#include "table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <utility>

namespace {

struct Column {
    const char *library, *variant, *title;
};

const Column ours[] = {{"cstk", "proof", "proof"},
                       {"cstk", "proof any", "proof any"},
                       {"cstk", "sampled 0.05", "0.05"},
                       {"cstk", "sampled 0.01", "0.01"},
                       {"cstk", "sampled 1 mm", "1 mm"},
                       {"cstk", "advancement", "advancement"},
                       {"cstk", "bisection", "bisection"},
                       {"cstk", "proof with pairs proved", "proof with pairs proved"},
                       {"cstk", "sampled 0.05 with pairs proved", "0.05 with pairs proved"},
                       {"cstk", "sampled 1 mm with pairs proved", "1 mm with pairs proved"}};

const Column peers[] = {
    {"fcl", "sampled 0.05", "FCL 0.05"},    {"fcl", "sampled 0.01", "FCL 0.01"},
    {"fcl", "sampled 1 mm", "FCL 1 mm"},    {"fcl", "continuous", "FCL continuous"},
    {"coal", "sampled 0.05", "Coal 0.05"},  {"coal", "sampled 0.01", "Coal 0.01"},
    {"coal", "sampled 1 mm", "Coal 1 mm"}};

// Rows that print_slowest() shows.
const std::size_t slowest_shown = 10;

std::string formatted(const char *format, ...) {
    char text[256];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

// Three digits, never as a power of ten.
std::string digits(double x) {
    const int after = x >= 100 ? 0 : x >= 10 ? 1 : 2;
    return formatted("%.*f", after, x);
}

std::vector<Column> all_columns() {
    std::vector<Column> all(std::begin(ours), std::end(ours));
    all.insert(all.end(), std::begin(peers), std::end(peers));
    return all;
}

std::string place(const Row &row) {
    return row.scene + formatted(" | %g | ", row.length) + name_of(row.kind);
}

// Sums of logarithms, for a geometric mean.
struct Ratio {
    double sum = 0;
    std::size_t count = 0;

    void add(double ratio) {
        sum += std::log(ratio);
        ++count;
    }
    std::string text() const {
        return count == 0 ? "-" : digits(std::exp(sum / static_cast<double>(count)));
    }
};

// Of the motions that both were asked about.
Ratio ratio_of(const Row &row, const Row &proof) {
    Ratio ratio;
    const std::size_t count = std::min(row.microseconds.size(), proof.microseconds.size());
    for (std::size_t i = 0; i < count; ++i) {
        ratio.add(row.microseconds[i] / proof.microseconds[i]);
    }
    return ratio;
}

// Motions that both were asked about, with another number of checks.
std::size_t differing_checks(const Row &one, const Row &other) {
    const std::size_t count = std::min(one.checks.size(), other.checks.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < count; ++i) {
        differing += one.checks[i] != other.checks[i];
    }
    return differing;
}

std::string cell(const Row *row) {
    return row ? digits(row->median()) + " (" + digits(row->mean()) + ")" : "-";
}

template <class Columns> void print_head(const std::string &first, const Columns &columns) {
    std::printf("| %s |", first.c_str());
    for (const Column &column : columns) {
        std::printf(" %s |", column.title);
    }
    std::printf("\n|");
    const auto count = static_cast<std::size_t>(std::count(first.begin(), first.end(), '|')) + 1 +
                       static_cast<std::size_t>(std::distance(std::begin(columns),
                                                              std::end(columns)));
    for (std::size_t i = 0; i < count; ++i) {
        std::printf(" --- |");
    }
    std::printf("\n");
}

} // namespace

const Row *Table::Group::find(const std::string &library, const std::string &variant) const {
    for (const Row &row : rows) {
        if (row.library == library && row.variant == variant) {
            return &row;
        }
    }
    return nullptr;
}

void Table::add(const std::vector<Row> &rows, const std::vector<Segment> &segments) {
    if (groups_.empty()) {
        std::printf("\n### The library: median (mean) of a motion, µs\n\n");
        print_head("scene | length | kind | motions", ours);
    }
    groups_.push_back({rows, segments});
    const Group &group = groups_.back();
    std::printf("| %s | %zu |", place(rows[0]).c_str(), segments.size());
    for (const Column &column : ours) {
        std::printf(" %s |", cell(group.find(column.library, column.variant)).c_str());
    }
    std::printf("\n");
    std::fflush(stdout);
}

void Table::print_peers() const {
    std::printf("\n### FCL and Coal: median (mean) of a motion, µs\n\n");
    print_head("scene | length | kind", peers);
    for (const Group &group : groups_) {
        std::printf("| %s |", place(group.rows[0]).c_str());
        for (const Column &column : peers) {
            std::printf(" %s |", cell(group.find(column.library, column.variant)).c_str());
        }
        std::printf("\n");
    }
}

void Table::print_ratios() const {
    std::printf("\n### Time of a variant / time of the proof, geometric mean over the motions of all lengths\n\n");
    const std::vector<Column> columns = all_columns();
    print_head("scene | kind", std::vector<Column>(columns.begin() + 1, columns.end()));
    // In the order of the rows.
    std::vector<std::pair<std::string, Kind>> places;
    for (const Group &group : groups_) {
        const std::pair<std::string, Kind> at = {group.rows[0].scene, group.rows[0].kind};
        if (std::find(places.begin(), places.end(), at) == places.end()) {
            places.push_back(at);
        }
    }
    for (const Kind kind : {Kind::free, Kind::hit}) {
        places.emplace_back("all", kind);
    }
    for (const auto &[scene, kind] : places) {
        std::printf("| %s | %s |", scene.c_str(), name_of(kind));
        for (std::size_t i = 1; i < columns.size(); ++i) {
            Ratio ratio;
            for (const Group &group : groups_) {
                const Row *row = group.find(columns[i].library, columns[i].variant);
                const bool counts = group.rows[0].kind == kind &&
                                    (scene == "all" || group.rows[0].scene == scene);
                if (row && counts) {
                    const Ratio one = ratio_of(*row, group.rows[0]);
                    ratio.sum += one.sum;
                    ratio.count += one.count;
                }
            }
            std::printf(" %s |", ratio.text().c_str());
        }
        std::printf("\n");
    }
}

// For each variant the row in which it does best beside the proof.
void Table::print_worst() const {
    std::printf("\n### The worst row of the proof beside each variant\n\n"
                "| variant | scene | length | kind | variant / proof | variant, µs | proof, µs | "
                "answers that differ |\n"
                "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    const std::vector<Column> columns = all_columns();
    for (std::size_t i = 1; i < columns.size(); ++i) {
        const Row *worst = nullptr, *proof = nullptr;
        double least = INFINITY;
        for (const Group &group : groups_) {
            const Row *row = group.find(columns[i].library, columns[i].variant);
            if (!row) {
                continue;
            }
            const Ratio ratio = ratio_of(*row, group.rows[0]);
            const double mean = ratio.sum / static_cast<double>(ratio.count);
            if (mean < least) {
                least = mean;
                worst = row;
                proof = &group.rows[0];
            }
        }
        if (worst) {
            std::printf("| %s %s | %s | %s | %s | %s | %zu of %zu |\n", columns[i].library,
                        columns[i].variant, place(*worst).c_str(),
                        digits(std::exp(least)).c_str(), digits(worst->median()).c_str(),
                        digits(proof->median()).c_str(), worst->differing,
                        worst->microseconds.size());
        }
    }
}

void Table::print_slowest() const {
    struct Slow {
        const Group *group;
        std::size_t segment;
        double microseconds;
    };
    std::vector<Slow> slow;
    for (const Group &group : groups_) {
        const std::vector<double> &times = group.rows[0].microseconds;
        const auto at = std::max_element(times.begin(), times.end());
        slow.push_back({&group, static_cast<std::size_t>(at - times.begin()), *at});
    }
    std::sort(slow.begin(), slow.end(),
              [](const Slow &a, const Slow &b) { return a.microseconds > b.microseconds; });
    std::printf("\n### The slowest proofs, one a row of the first table\n\n");
    for (std::size_t i = 0; i < std::min(slow.size(), slowest_shown); ++i) {
        const Row &row = slow[i].group->rows[0];
        std::printf("- %s, length %g, %s: %s µs, the row's median %s\n  %s\n", row.scene.c_str(),
                    row.length, name_of(row.kind), digits(slow[i].microseconds).c_str(),
                    digits(row.median()).c_str(),
                    text_of(slow[i].group->segments[slow[i].segment].ends).c_str());
    }
}

// Rows without a miss are left out.
void Table::print_misses() const {
    const auto is_sampling = [](const char *variant) {
        return std::string(variant).rfind("sampled", 0) == 0;
    };
    std::vector<Column> sampling;
    for (const Column &column : all_columns()) {
        if (is_sampling(column.variant)) {
            sampling.push_back(column);
        }
    }
    std::printf("\n### Hits that sampling calls free, of those asked\n\n");
    print_head("scene | length", sampling);
    for (const Group &group : groups_) {
        const bool has_misses =
            std::any_of(group.rows.begin(), group.rows.end(), [&](const Row &row) {
                return row.differing > 0 && is_sampling(row.variant.c_str());
            });
        if (group.rows[0].kind != Kind::hit || !has_misses) {
            continue;
        }
        std::printf("| %s | %g |", group.rows[0].scene.c_str(), group.rows[0].length);
        for (const Column &column : sampling) {
            const Row *row = group.find(column.library, column.variant);
            const std::string text =
                row ? formatted("%zu of %zu", row->differing, row->microseconds.size()) : "-";
            std::printf(" %s |", text.c_str());
        }
        std::printf("\n");
    }
}

void Table::print_disagreements() const {
    std::printf("\n### Answers that differ, first contacts off by more than 1 %% of the motion, and samplings of peers that end "
                "at another sample than the library's\n\n"
                "| variant | free motions | called hits | hits | called free | off in time | another sample |\n"
                "| --- | --- | --- | --- | --- | --- | --- |\n");
    for (const Column &column : all_columns()) {
        std::size_t differing[2] = {}, asked[2] = {}, off = 0, other_samples = 0;
        const std::string variant = column.variant;
        const bool is_peers_sampling =
            std::string(column.library) != "cstk" && variant.rfind("sampled", 0) == 0;
        for (const Group &group : groups_) {
            if (const Row *row = group.find(column.library, column.variant)) {
                const std::size_t at = row->kind == Kind::hit;
                differing[at] += row->differing;
                asked[at] += row->microseconds.size();
                off += row->off_in_time;
                if (is_peers_sampling) {
                    other_samples += differing_checks(*row, *group.find("cstk", variant));
                }
            }
        }
        const bool finds_first =
            variant == "proof" || variant == "advancement" || variant == "continuous";
        if (asked[0] + asked[1] > 0) {
            std::printf("| %s %s | %zu | %zu | %zu | %zu | %s | %s |\n", column.library,
                        column.variant, asked[0], differing[0], asked[1], differing[1],
                        finds_first ? std::to_string(off).c_str() : "-",
                        is_peers_sampling ? std::to_string(other_samples).c_str() : "-");
        }
    }
}

void Table::finish() const {
    if (groups_.empty()) {
        return;
    }
    print_peers();
    print_ratios();
    print_worst();
    print_slowest();
    print_misses();
    print_disagreements();
}

std::string Table::csv() const {
    std::string text = "scene,length,kind,library,variant,microseconds,checks\n";
    for (const Group &group : groups_) {
        for (const Row &row : group.rows) {
            text += row.scene + formatted(",%g,", row.length) + name_of(row.kind) + "," +
                    row.library + "," + row.variant + formatted(",%.4f,", row.median());
            text += (row.mean_checks() > 0 ? formatted("%.1f", row.mean_checks()) : "") + "\n";
        }
    }
    return text;
}
