/* Meshes from arrays and from files, scaled and moved as they are added: against their vertices scaled and moved by hand.
 */
#include <math.h>

#include "check.h"

enum { VERTICES = 4, FACES = 4 };

static const double wedge[3 * VERTICES] = {0, 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 1};
static const uint32_t indices[3 * FACES] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
/* A quarter turn about z. */
static const double pose[12] = {0, -1, 0, 5, 1, 0, 0, -7, 0, 0, 1, 11};
static const char *file = "placed_meshes_test.obj";

static void write_wedge(void) {
    FILE *out = fopen(file, "w");
    CHECK(out != NULL);
    for (int i = 0; i < VERTICES; ++i) {
        fprintf(out, "v %g %g %g\n", wedge[3 * i], wedge[3 * i + 1], wedge[3 * i + 2]);
    }
    for (int i = 0; i < FACES; ++i) {
        const uint32_t *face = indices + 3 * i;
        fprintf(out, "f %u %u %u\n", face[0] + 1, face[1] + 1, face[2] + 1);
    }
    CHECK(fclose(out) == 0);
}

/* The body of the wedge as a solid, given by the array or by the file. */
static cstk_body *build(int from_file, const double *at, const double *scale) {
    cstk_body_builder *b = NULL;
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_builder_create(3, &b));
    if (from_file) {
        CHECK_OK(cstk_body_builder_add_mesh_file(b, file, at, scale));
    } else {
        CHECK_OK(cstk_body_builder_add_mesh(b, wedge, VERTICES, NULL, FACES, indices, 3 * FACES,
                                            at, scale));
    }
    CHECK_OK(cstk_body_builder_set_solid(b, true));
    CHECK_OK(cstk_body_build(b, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_builder_release(b));
    return body;
}

static void expect(const double *v, const double *at, const double *scale, double *out) {
    for (int row = 0; row < 3; ++row) {
        out[row] = at == NULL ? 0 : at[4 * row + 3];
        for (int k = 0; k < 3; ++k) {
            const double r = at == NULL ? row == k : at[4 * row + k];
            out[row] += r * v[k] * (scale == NULL ? 1 : scale[k]);
        }
    }
}

/* Each face has its own vertices, counter-clockwise seen from outside: to and fro where it is mirrored. */
static void check_faces(const cstk_body *body, const double *at, const double *scale) {
    double sixfold_volume = 0;
    for (uint32_t face = 0; face < FACES; ++face) {
        double xyz[9];
        size_t count = 0;
        cstk_primitive p;
        CHECK_OK(cstk_body_get_primitive(body, face, &p));
        CHECK(p.kind == CSTK_PRIMITIVE_POLYGON && p.vertex_count == 3 && p.tag == face);
        CHECK_OK(cstk_body_get_feature_vertices(body, face, CSTK_FEATURE_FACE, 0, 3, xyz, &count));
        CHECK(count == 3);
        for (int k = 0; k < 3; ++k) {
            int found = 0;
            for (int j = 0; j < 3; ++j) {
                double v[3];
                expect(wedge + 3 * indices[3 * face + k], at, scale, v);
                found += fabs(v[0] - xyz[3 * j]) + fabs(v[1] - xyz[3 * j + 1]) +
                             fabs(v[2] - xyz[3 * j + 2]) <
                         1e-13;
            }
            CHECK(found == 1);
        }
        const double *a = xyz, *b = xyz + 3, *c = xyz + 6;
        sixfold_volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    const double grown = scale == NULL ? 1 : fabs(scale[0] * scale[1] * scale[2]);
    CHECK(fabs(sixfold_volume - 6 * grown) < 1e-10);
}

int main(void) {
    const double scales[][3] = {{2, 0.5, 3}, {-2, 0.5, 3}, {-2, -0.5, 3}, {-2, -0.5, -3}};
    write_wedge();
    for (int from_file = 0; from_file < 2; ++from_file) {
        for (int placed = 0; placed < 2; ++placed) {
            const double *at = placed ? pose : NULL;
            for (int s = -1; s < 4; ++s) {
                const double *scale = s < 0 ? NULL : scales[s];
                cstk_body *body = build(from_file, at, scale);
                check_faces(body, at, scale);
                CHECK_OK(cstk_body_release(body));
            }
        }
    }
    remove(file);
    return check_result();
}
