/* Two boxes 2 apart, and the version given on the command line. */
#include <cstk.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

int main(int argc, char **argv) {
    const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    const double here[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const double there[12] = {1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    cstk_query *query = NULL;
    cstk_distance_result d = {0};
    if (argc != 2 || strcmp(argv[1], cstk_version()) != 0) {
        fprintf(stderr, "version %s, expected %s\n", cstk_version(), argc == 2 ? argv[1] : "one");
        return 1;
    }
    if (cstk_body_builder_create(3, &builder) != CSTK_OK ||
        cstk_body_builder_add_polyhedron(builder, cube, 8, 0) != CSTK_OK ||
        cstk_body_build(builder, NULL, NULL, NULL, &body) != CSTK_OK ||
        cstk_query_create(&query) != CSTK_OK ||
        cstk_pair_distance(query, body, here, body, there, INFINITY, &d) != CSTK_OK) {
        fprintf(stderr, "%s\n", cstk_last_error_message());
        return 1;
    }
    cstk_query_release(query);
    cstk_body_release(body);
    cstk_body_builder_release(builder);
    return fabs(d.distance - 2.0) < 1e-12 ? 0 : 1;
}
