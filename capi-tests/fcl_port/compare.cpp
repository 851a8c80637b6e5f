// Runs a program built with FCL and the same program built with cstk/fcl.hpp, and compares what they print, line by line:
//   compare FCL_PROGRAM CSTK_PROGRAM [MAX_DISAGREEMENTS [ARGUMENTS...]]
// Prints how many answers agree, those that do not, and the ratio of times.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Line {
    std::string kind, label;
    std::vector<double> numbers;
};

// What a program prints; its exit status must be 0.
std::vector<Line> answers_of(const std::string &command, bool &ok) {
    std::vector<Line> lines;
    FILE *pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        ok = false;
        return lines;
    }
    char text[512];
    while (std::fgets(text, sizeof text, pipe) != nullptr) {
        std::istringstream words(text);
        Line line;
        words >> line.kind >> line.label;
        if (line.kind == "value" || line.kind == "decision" || line.kind == "time") {
            for (std::string word; words >> word;) {
                line.numbers.push_back(std::strtod(word.c_str(), nullptr));
            }
            lines.push_back(line);
        } else {
            std::printf("%s: %s", command.c_str(), text);
        }
    }
    ok = pclose(pipe) == 0;
    return lines;
}

bool agree(const Line &a, const Line &b) {
    if (a.kind == "decision") {
        return a.numbers[0] == b.numbers[0] || std::fmin(a.numbers[1], b.numbers[1]) <= a.numbers[2];
    }
    return a.numbers[0] == b.numbers[0] || std::fabs(a.numbers[0] - b.numbers[0]) <= a.numbers[1];
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: compare FCL_PROGRAM CSTK_PROGRAM [MAX_DISAGREEMENTS [ARGUMENTS...]]\n");
        return 2;
    }
    const int allowed = argc > 3 ? std::atoi(argv[3]) : 0;
    std::string arguments;
    for (int i = 4; i < argc; ++i) {
        arguments += std::string(" ") + argv[i];
    }
    bool fcl_ok = false, cstk_ok = false;
    const std::vector<Line> theirs = answers_of(argv[1] + arguments, fcl_ok);
    const std::vector<Line> ours = answers_of(argv[2] + arguments, cstk_ok);
    if (!fcl_ok || !cstk_ok || theirs.size() != ours.size() || ours.empty()) {
        std::printf("FAILED: %s %s; %zu and %zu answers\n", fcl_ok ? "" : argv[1], cstk_ok ? "" : argv[2], theirs.size(),
                    ours.size());
        return 1;
    }
    int compared = 0, different = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const Line &a = theirs[i], &b = ours[i];
        if (a.label != b.label || a.kind != b.kind || a.numbers.size() != b.numbers.size()) {
            std::printf("FAILED: line %zu is %s here and %s there\n", i, b.label.c_str(), a.label.c_str());
            return 1;
        }
        if (a.kind == "time") {
            std::printf("%s: FCL %.3g ms, cstk %.3g ms, ratio %.2f\n", a.label.c_str(), 1e3 * a.numbers[0], 1e3 * b.numbers[0],
                        a.numbers[0] / b.numbers[0]);
            continue;
        }
        ++compared;
        if (!agree(a, b) && ++different <= 10) {
            std::printf("%s: FCL %.12g, cstk %.12g\n", a.label.c_str(), a.numbers[0], b.numbers[0]);
        }
    }
    std::printf("%d answers compared, %d differ, %d may\n", compared, different, allowed);
    return different <= allowed ? 0 : 1;
}
