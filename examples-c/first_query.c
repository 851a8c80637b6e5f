/* Two bodies, a distance with its points, every status checked.
 *
 *   cc first_query.c $(pkg-config --cflags --libs cstk) -o first_query && ./first_query
 */
#include <cstk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

int main(void) {
    const double cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                           0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    cstk_body_builder *builder = NULL;
    check(cstk_body_builder_create(3, &builder));
    check(cstk_body_builder_add_polyhedron(builder, cube, 8, 0));
    cstk_body *body = NULL;
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    cstk_query *query = NULL;
    check(cstk_query_create(&query));

    const double here[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; /* rows of [R | t] */
    const double there[12] = {1, 0, 0, 3, 0, 1, 0, 0.5, 0, 0, 1, 0};
    cstk_distance_result d;
    check(cstk_pair_distance(query, body, here, body, there, INFINITY, &d));
    printf("distance %g between (%g, %g, %g) and (%g, %g, %g)\n", d.distance, d.r_point[0],
           d.r_point[1], d.r_point[2], d.s_point[0], d.s_point[1], d.s_point[2]);

    check(cstk_query_release(query));
    check(cstk_body_release(body));
    check(cstk_body_builder_release(builder));
    return 0;
}
