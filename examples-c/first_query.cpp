// The first query in C++: two bodies, a distance with its points; failures are exceptions.
//
//   c++ -std=c++17 first_query.cpp $(pkg-config --cflags --libs cstk) -o first_query && ./first_query
#include <cstk.hpp>
#include <iostream>

int main() {
    try {
        const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                               0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
        cstk::Body body = cstk::BodyBuilder().add_polyhedron(cube).build();
        cstk::Query query;
        cstk_distance_result d =
            query.pair_distance(body, cstk::identity(), body, cstk::translation(3, 0.5, 0));
        std::cout << "distance " << d.distance << " between (" << d.r_point[0] << ", "
                  << d.r_point[1] << ", " << d.r_point[2] << ") and (" << d.s_point[0] << ", "
                  << d.s_point[1] << ", " << d.s_point[2] << ")\n";
    } catch (const cstk::Error &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
