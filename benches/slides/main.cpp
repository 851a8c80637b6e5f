// Times of slide steps: the Panda and the UR5 of example-robot-data with their collision meshes, against themselves and four
// boxes. Usage: slides FOLDER [--quick] [--seed N], the folder being that of scripts/fetch_pinocchio.sh.
#include "walk.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace {

struct Robot {
    const char *name, *urdf;
};

const Robot robots[] = {{"Panda", "panda_description/urdf/panda.urdf"},
                        {"UR5", "ur_description/urdf/ur5_robot.urdf"}};

const Shells shells[] = {{0.1, 0.1}, {0.1, 0.02}};

void print(const char *robot, const Shells &shells, const char *where, const Steps &steps) {
    std::printf("| %s | %g | %g | %s | %zu | %zu | %.1f | %.0f | %.0f |\n", robot, shells.obstacles,
                shells.links, where, steps.times.size(), steps.blocked,
                100 * steps.gone / steps.asked, steps.quantile(0.5), steps.quantile(0.95));
}

} // namespace

int main(int count, char **arguments) {
    std::size_t walks = 100;
    std::uint64_t seed = 1;
    const char *folder = nullptr;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(arguments[i], "--quick") == 0) {
            walks = 10;
        } else if (std::strcmp(arguments[i], "--seed") == 0 && i + 1 < count) {
            seed = std::strtoull(arguments[++i], nullptr, 10);
        } else if (!folder) {
            folder = arguments[i];
        }
    }
    if (!folder || !std::filesystem::exists(std::filesystem::path(folder) / "cmeel.prefix")) {
        std::fprintf(stderr, "SKIPPED: no robots in %s; see scripts/fetch_pinocchio.sh\n",
                     folder ? folder : "(no folder given)");
        return 77;
    }
    try {
        std::printf("| robot | shell of obstacles, m | shell of links, m | steps | count | blocked "
                    "| gone, %% | median, us | 95 %%, us |\n"
                    "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
        for (const Robot &robot : robots) {
            const Cell cell(folder, robot.urdf);
            for (const Shells &used : shells) {
                const Walks made = walk(cell, used, walks, seed);
                print(robot.name, used, "free", made.free);
                print(robot.name, used, "sliding", made.sliding);
                std::fflush(stdout);
            }
        }
    } catch (const std::exception &error) {
        std::fprintf(stderr, "slides: %s\n", error.what());
        return 1;
    }
}
