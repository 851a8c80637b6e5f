// Seconds and bytes that hierarchies over triangle meshes take, from arrays to bodies that can be asked, beside FCL and Coal.
// Usage: builds [--csv FILE] [--quick] [--seed N]
#include "built.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>

namespace {

const Built &fastest(const std::vector<Built> &all) {
    const Built *best = &all.front();
    for (const Built &built : all) {
        best = built.seconds < best->seconds ? &built : best;
    }
    return *best;
}

void print(const char *name, const Mesh &mesh, const std::vector<Built> &ours,
           const std::vector<Built> &fcl, const std::vector<Built> &coal) {
    const Built &best = fastest(fcl);
    std::printf("| %s | %zu | %.4f | %.4f | %.4f (%s) | ", name, mesh.triangles.size(),
                ours[0].seconds, ours[1].seconds, best.seconds, best.way.c_str());
    if (coal.empty()) {
        std::printf("- | ");
    } else {
        const Built &peer = fastest(coal);
        std::printf("%.4f (%s) | ", peer.seconds, peer.way.c_str());
    }
    std::printf("%.2f | %.0f |", best.seconds / ours[0].seconds, ours[0].bytes);
    for (const Built &built : fcl) {
        std::printf(" %s %.0f", built.way.c_str(), built.bytes);
    }
    std::printf(" |");
    for (const Built &built : coal) {
        std::printf(" %s %.0f", built.way.c_str(), built.bytes);
    }
    std::printf(" |\n");
    std::fflush(stdout);
}

void write(std::ofstream &csv, const char *name, const Mesh &mesh, const std::vector<Built> &all) {
    for (const Built &built : all) {
        const std::string start = std::string(name) + ' ' + std::to_string(mesh.triangles.size());
        const std::string library = built.library + ' ' + built.way;
        csv << start << ",-,build," << library << ',' << built.seconds * 1e9 << '\n';
        csv << start << ",-,bytes a triangle," << library << ',' << built.bytes << '\n';
    }
}

void print(const char *what, const char *name, std::size_t triangles, const Again &again, std::ofstream &csv) {
    std::printf("| %s | %s | %zu | %.4f | %.4f | %.1f | %.0f | %.0f | %.1e |\n", what, name, triangles, again.build,
                again.again, again.build / again.again, again.bytes, again.bytes_again, again.difference);
    std::fflush(stdout);
    const std::string start = std::string(name) + ' ' + std::to_string(triangles) + ",-," + what;
    csv << start << ",built anew," << again.build * 1e9 << '\n' << start << ",again," << again.again * 1e9 << '\n';
}

/// Bodies made of what is built already.
void print_again(bool quick, std::uint64_t seed, std::ofstream &csv) {
    std::printf("\n| | body | triangles | built, s | again, s | built / again | built, bytes a triangle | again, bytes a "
                "triangle | distances differ by |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    const Mesh base = bumpy_sphere(276);
    print("44 parts", "bumpy sphere", 44 * base.triangles.size(), built_of_parts(base, 44, 9), csv);
    std::vector<std::size_t> sizes = {1000, 10000, 100000};
    if (!quick) {
        sizes.push_back(1000000);
    }
    for (const std::size_t size : sizes) {
        const int times = size < 100000 ? 9 : 3;
        const Mesh ball = bumpy_sphere(size);
        print("refit", "bumpy sphere", ball.triangles.size(), refitted(ball, times), csv);
        const Mesh loose = soup(size, seed);
        print("refit", "soup", loose.triangles.size(), refitted(loose, times), csv);
    }
}

} // namespace

int main(int count, char **arguments) {
    bool quick = false;
    std::uint64_t seed = 1;
    std::ofstream csv;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(arguments[i], "--quick") == 0) {
            quick = true;
        } else if (std::strcmp(arguments[i], "--seed") == 0 && i + 1 < count) {
            seed = std::strtoull(arguments[++i], nullptr, 10);
        } else if (std::strcmp(arguments[i], "--csv") == 0 && i + 1 < count) {
            csv.open(arguments[++i]);
        } else {
            std::fprintf(stderr, "usage: builds [--csv FILE] [--quick] [--seed N]\n");
            return 2;
        }
    }
    try {
        csv << "case,poses,query,library,nanoseconds\n";
        std::printf("| body | triangles | cstk, s | all threads, s | FCL, s | Coal, s | FCL / cstk | cstk, bytes a "
                    "triangle | FCL | Coal |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
        std::vector<std::size_t> sizes = {1000, 10000, 100000};
        if (!quick) {
            sizes.push_back(1000000);
        }
        for (const std::size_t size : sizes) {
            const int times = size < 100000 ? 9 : 3;
            const std::pair<const char *, Mesh> meshes[] = {{"bumpy sphere", bumpy_sphere(size)},
                                                            {"balls on a floor", balls_on_a_floor(size, seed)},
                                                            {"soup", soup(size, seed)}};
            for (const auto &[name, mesh] : meshes) {
                if (mesh.triangles.size() < 100) {
                    continue;
                }
                const auto ours = cstk_builds(mesh, times);
                const auto fcl = fcl_builds(mesh, times);
                const auto coal = coal_builds(mesh, times);
                print(name, mesh, ours, fcl, coal);
                for (const auto *all : {&ours, &fcl, &coal}) {
                    write(csv, name, mesh, *all);
                }
            }
        }
        print_again(quick, seed, csv);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "builds: %s\n", error.what());
        return 1;
    }
}
