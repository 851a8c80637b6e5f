// Two boxes 2 apart, and the version given on the command line; through the C++ layer.
#include <cmath>
#include <cstdio>
#include <cstk.hpp>
#include <string>

int main(int argc, char **argv) {
    const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    if (argc != 2 || std::string(argv[1]) != cstk_version()) {
        std::fprintf(stderr, "version %s, expected %s\n", cstk_version(),
                     argc == 2 ? argv[1] : "one");
        return 1;
    }
    const cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
    cstk::Query query;
    const cstk_distance_result d =
        query.pair_distance(body, cstk::identity(), body, cstk::translation(3, 0, 0));
    return std::fabs(d.distance - 2.0) < 1e-12 ? 0 : 1;
}
