/* Mesh files: what is read, what is refused, and with which message. The files are written by the
 * test itself. */
#include <math.h>
#include <sys/stat.h>

#include "check.h"
#include "fixture.h"

static const char *folder = "files_test";

static const char *path_of(const char *name) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(path_of(name), "wb");
    CHECK(file != NULL);
    CHECK(fwrite(bytes, 1, size, file) == size);
    CHECK(fclose(file) == 0);
}

static void write_text(const char *name, const char *text) { write_file(name, text, strlen(text)); }

static cstk_body_statistics load(const char *name) {
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    cstk_body_statistics statistics;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_mesh_file(builder, path_of(name), NULL, NULL));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_get_statistics(body, &statistics));
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    return statistics;
}

static void check_loads(const char *name, uint64_t primitives, uint64_t split, uint64_t dropped) {
    const cstk_body_statistics s = load(name);
    if (s.primitive_count != primitives || s.faces_split != split || s.faces_dropped != dropped) {
        fprintf(stderr, "%s: %d primitives, %d split, %d dropped\n", name, (int)s.primitive_count,
                (int)s.faces_split, (int)s.faces_dropped);
        ++check_failures;
    }
}

/* Refused; the message names the file, and nothing was added. */
static void check_refused(const char *name, cstk_status status, const char *culprit) {
    cstk_body_builder *builder = NULL;
    cstk_body *body;
    const int before = check_failures;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_FAILS(cstk_body_builder_add_mesh_file(builder, path_of(name), NULL, NULL), status,
                culprit);
    CHECK_FAILS(cstk_body_builder_add_mesh_file(builder, path_of(name), NULL, NULL), status, name);
    CHECK_REFUSED(body, cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "body");
    CHECK_OK(cstk_body_builder_release(builder));
    if (check_failures > before) {
        fprintf(stderr, "  (%s)\n", name);
    }
}

static void refuse_text(const char *name, const char *text, cstk_status status,
                        const char *culprit) {
    write_text(name, text);
    check_refused(name, status, culprit);
}

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void obj(void) {
    write_text("plain.obj", "# a comment\no square\n" SQUARE "f 1 2 3 4\n");
    check_loads("plain.obj", 1, 0, 0);
    const cstk_body_statistics s = load("plain.obj");
    CHECK(s.low[0] == 0 && s.high[0] == 1 && s.low[2] == 0 && s.high[2] == 0);
    write_text("UPPER.OBJ", SQUARE "f 1 2 3 4\n");
    check_loads("UPPER.OBJ", 1, 0, 0);
    write_text("negative.obj", SQUARE "f -4 -3 -2\nf -4 -2 -1\n");
    check_loads("negative.obj", 2, 0, 0);
    write_text("textured.obj",
               "mtllib none.mtl\n" SQUARE
               "vt 0 0\nvn 0 0 1\nusemtl x\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\n");
    check_loads("textured.obj", 2, 0, 0);
    write_text("crlf.obj", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n");
    check_loads("crlf.obj", 1, 0, 0);
    write_text("unended.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    check_loads("unended.obj", 1, 0, 0);
    /* Two groups number their vertices through. */
    write_text("groups.obj", "o a\n" SQUARE "f 1 2 3 4\no b\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 5 6 7\n");
    check_loads("groups.obj", 2, 0, 0);
    CHECK(load("groups.obj").high[2] == 5);
    write_text("precise.obj", "v 0 0 0\nv 0.1 0 0\nv 0 1000000.123456789 0\nf 1 2 3\n");
    CHECK(load("precise.obj").high[0] == 0.1 && load("precise.obj").high[1] == 1000000.123456789);
}

static void obj_faces(void) {
    /* An L of six corners, a square with a corner raised, and a face along a line. */
    write_text("faces.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                            "v 5 0 0\nv 6 0 0\nv 6 1 0.25\nv 5 1 0\n"
                            "v 8 0 0\nv 9 0 0\nv 10 0 0\n"
                            "f 1 2 3 4 5 6\nf 7 8 9 10\nf 11 12 13\nf 11 11 12\n");
    check_loads("faces.obj", 4 + 2, 2, 2);
    /* A face of two corners has no area either. */
    write_text("two_corners.obj", SQUARE "f 1 2\nf 1 2 3\n");
    check_loads("two_corners.obj", 1, 0, 1);
    /* Nothing but faces without area: no primitive is left. */
    cstk_body_builder *builder = NULL;
    cstk_body *body;
    write_text("lines.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_mesh_file(builder, path_of("lines.obj"), NULL, NULL));
    CHECK_REFUSED(body, cstk_body_build(builder, NULL, NULL, NULL, &body), CSTK_ERROR_EMPTY, "area");
    CHECK_OK(cstk_body_builder_release(builder));
}

static void damaged_obj(void) {
    refuse_text("empty.obj", "", CSTK_ERROR_EMPTY, "face");
    refuse_text("vertices.obj", SQUARE, CSTK_ERROR_EMPTY, "face");
    refuse_text("beyond.obj", SQUARE "f 1 2 5\n", CSTK_ERROR_PARSE, "");
    refuse_text("zero.obj", SQUARE "f 0 1 2\n", CSTK_ERROR_PARSE, "");
    refuse_text("far_negative.obj", SQUARE "f -5 -3 -2\n", CSTK_ERROR_PARSE, "");
    refuse_text("overflow.obj", SQUARE "f 1 2 99999999999999999999\n", CSTK_ERROR_PARSE, "");
    refuse_text("word.obj", SQUARE "f 1 2 three\n", CSTK_ERROR_PARSE, "");
    refuse_text("cut_vertex.obj", "v 0 0 0\nv 1 0 0\nv 1", CSTK_ERROR_PARSE, "");
    refuse_text("short_vertex.obj", "v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n", CSTK_ERROR_PARSE, "");
    refuse_text("word_vertex.obj", "v 0 0 x\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", CSTK_ERROR_PARSE, "");
    refuse_text("nan.obj", "v 0 0 0\nv nan 0 0\nv 1 1 0\nf 1 2 3\n", CSTK_ERROR_NOT_FINITE, "face 0");
    refuse_text("inf.obj", "v 0 0 0\nv inf 0 0\nv 1 1 0\nf 1 2 3\n", CSTK_ERROR_NOT_FINITE, "face 0");
    refuse_text("crossing.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 3 0\nf 1 3 2 4\n", CSTK_ERROR_NOT_CONVEX,
                "face 0");
    refuse_text("garbage.obj", "\x01\x02\xff\xfe garbage \x80\n", CSTK_ERROR_PARSE, "");
}

/* Messages about texts say which line is to blame. */
static void lines(void) {
    refuse_text("line5.obj", SQUARE "f 1 2 5\n", CSTK_ERROR_PARSE, "line 5");
    refuse_text("line6.obj", SQUARE "\nf 1 2 three\n", CSTK_ERROR_PARSE, "line 6");
    refuse_text("line2.obj", "v 0 0 0\nv 1 0\nv 1 1 0\nf 1 2 3\n", CSTK_ERROR_PARSE, "line 2");
    refuse_text("line4.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex one 0 0\nvertex 1 0 0\n"
                "vertex 0 1 0\nendloop\nendfacet\nendsolid x\n",
                CSTK_ERROR_PARSE, "line 4");
}

static const char ascii_stl[] = "solid x\n"
                                " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n"
                                "   vertex 1 0 0\n   vertex 0 1e0 0\n  endloop\n endfacet\n"
                                "endsolid x\n";

static void ascii(void) {
    char cut[sizeof ascii_stl];
    write_text("ascii.stl", ascii_stl);
    check_loads("ascii.stl", 1, 0, 0);
    /* Cut anywhere before the last word, it is not whole. */
    const size_t whole = strlen(ascii_stl) - strlen("endsolid x\n");
    for (size_t size = 1; size <= whole; size += 7) {
        memcpy(cut, ascii_stl, size);
        cut[size] = '\0';
        refuse_text("ascii_cut.stl", cut, CSTK_ERROR_PARSE, "");
    }
    refuse_text("ascii_nan.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\nvertex 1 0 0\n"
                "vertex 0 1 0\nendloop\nendfacet\nendsolid x\n",
                CSTK_ERROR_NOT_FINITE, "NaN");
    refuse_text("ascii_word.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex one 0 0\nvertex 1 0 0\n"
                "vertex 0 1 0\nendloop\nendfacet\nendsolid x\n",
                CSTK_ERROR_PARSE, "");
    refuse_text("ascii_two.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                "endloop\nendfacet\nendsolid x\n",
                CSTK_ERROR_PARSE, "");
    refuse_text("ascii_none.stl", "solid x\nendsolid x\n", CSTK_ERROR_EMPTY, "face");
}

enum { HEADER = 80, TRIANGLE = 50, TRIANGLES = 2 };

typedef struct binary_stl {
    unsigned char bytes[HEADER + 4 + TRIANGLE * TRIANGLES];
} binary_stl;

static void set_count(binary_stl *stl, uint32_t count) {
    for (int i = 0; i < 4; ++i) {
        stl->bytes[HEADER + i] = (unsigned char)(count >> 8 * i);
    }
}

/* Two triangles. The format is little-endian; the numbers are copied as they lie in memory. */
static binary_stl make_binary(const char *header, float x) {
    binary_stl stl;
    memset(&stl, 0, sizeof stl);
    memcpy(stl.bytes, header, strlen(header));
    set_count(&stl, TRIANGLES);
    for (int t = 0; t < TRIANGLES; ++t) {
        const float numbers[12] = {0, 0, 1, x, 0, (float)t, 1, 0, (float)t, 0, 1, (float)t};
        memcpy(stl.bytes + HEADER + 4 + TRIANGLE * t, numbers, sizeof numbers);
    }
    return stl;
}

static void binary(void) {
    binary_stl stl = make_binary("binary", 0);
    write_file("binary.stl", &stl, sizeof stl);
    check_loads("binary.stl", 2, 0, 0);
    CHECK(load("binary.stl").high[2] == 1);
    const size_t sizes[] = {
        1, HEADER, HEADER + 3, HEADER + 4, HEADER + 4 + TRIANGLE, sizeof stl - 1};
    for (int i = 0; i < 6; ++i) {
        write_file("binary_cut.stl", &stl, sizes[i]);
        check_refused("binary_cut.stl", CSTK_ERROR_PARSE, "");
    }
    const uint32_t counts[] = {TRIANGLES - 1, TRIANGLES + 1, 0x7FFFFFFF, UINT32_MAX};
    for (int i = 0; i < 4; ++i) {
        set_count(&stl, counts[i]);
        write_file("binary_count.stl", &stl, sizeof stl);
        check_refused("binary_count.stl", CSTK_ERROR_PARSE, "");
    }
    set_count(&stl, 0);
    write_file("binary_none.stl", &stl, HEADER + 4);
    check_refused("binary_none.stl", CSTK_ERROR_EMPTY, "face");
    stl = make_binary("solid, and binary all the same", 0);
    write_file("binary_solid.stl", &stl, sizeof stl);
    check_loads("binary_solid.stl", 2, 0, 0);
    set_count(&stl, UINT32_MAX);
    write_file("binary_solid_count.stl", &stl, sizeof stl);
    check_refused("binary_solid_count.stl", CSTK_ERROR_PARSE, "");
    stl = make_binary("binary", (float)NAN);
    write_file("binary_nan.stl", &stl, sizeof stl);
    check_refused("binary_nan.stl", CSTK_ERROR_NOT_FINITE, "face 0");
    stl = make_binary("binary", 1); /* its first two corners are one */
    write_file("binary_sliver.stl", &stl, sizeof stl);
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_mesh_file(builder, path_of("binary_sliver.stl"), NULL, NULL));
    CHECK_OK(cstk_body_builder_release(builder));
    refuse_text("garbage.stl", "\x01\x02\xff\xfe garbage", CSTK_ERROR_PARSE, "");
    refuse_text("empty.stl", "", CSTK_ERROR_PARSE, "");
}

static void paths(void) {
    CHECK(mkdir(path_of("folder.obj"), 0777) == 0 || load("plain.obj").primitive_count == 1);
    check_refused("folder.obj", CSTK_ERROR_IO, "");
    check_refused("missing.obj", CSTK_ERROR_IO, "");
    check_refused("missing.stl", CSTK_ERROR_IO, "");
    check_refused("plain.obj/below.obj", CSTK_ERROR_IO, "");
    refuse_text("mesh.ply", "ply\n", CSTK_ERROR_PARSE, "mesh.ply");
    refuse_text("mesh", SQUARE "f 1 2 3\n", CSTK_ERROR_UNSUPPORTED, "obj");
    refuse_text(".obj", SQUARE "f 1 2 3\n", CSTK_ERROR_UNSUPPORTED, "obj");
    /* STL in a file called OBJ, and the other way round. */
    refuse_text("stl_inside.obj", ascii_stl, CSTK_ERROR_EMPTY, "face");
    refuse_text("obj_inside.stl", SQUARE "f 1 2 3\n", CSTK_ERROR_PARSE, "");
}

int main(void) {
    mkdir(folder, 0777);
    obj();
    obj_faces();
    damaged_obj();
    lines();
    ascii();
    binary();
    paths();
    return check_result();
}
