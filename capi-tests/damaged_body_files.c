/* Files that are no bodies, or no whole ones: each is refused, or is a body that can be asked. */
#include <math.h>
#include <sys/stat.h>

#include "bodies.h"
#include "check.h"
#include "file_folder.h"
#include "fixture.h"

static void refuse(const char *name, cstk_status status, const char *culprit) {
    cstk_body *out;
    CHECK_REFUSED(out, cstk_body_load(path_of(name), &out), status, culprit);
    CHECK_FAILS(cstk_body_load(path_of(name), &out), status, name);
}

static void refuse_bytes(const void *bytes, size_t size, cstk_status status, const char *culprit) {
    write_file("refused.cstk", bytes, size);
    refuse("refused.cstk", status, culprit);
}

static void not_a_body(void) {
    const char text[] = "This is a text that is longer than the header of a body file.\n";
    unsigned char zeros[1000] = {0};
    refuse("missing.cstk", CSTK_ERROR_IO, "missing.cstk");
    refuse("missing/a.cstk", CSTK_ERROR_IO, "missing/a.cstk");
    mkdir(path_of("folder.cstk"), 0777);
    refuse("folder.cstk", CSTK_ERROR_IO, "folder.cstk");
    refuse_bytes("", 0, CSTK_ERROR_PARSE, "truncated");
    refuse_bytes(text, 5, CSTK_ERROR_PARSE, "no body file");
    refuse_bytes(text, sizeof text, CSTK_ERROR_PARSE, "no body file");
    refuse_bytes(zeros, sizeof zeros, CSTK_ERROR_PARSE, "no body file");
    refuse_bytes("v 0 0 0\n", 8, CSTK_ERROR_PARSE, "no body file");
}

enum { VERSION_AT = 8, SUM_AT = 24, HEADER_SUM_AT = 28, HEADER_SIZE = 32 };

static void truncated(const content *whole) {
    for (size_t size = 0; size < whole->size; ++size) {
        refuse_bytes(whole->bytes, size, CSTK_ERROR_PARSE, size < 8 ? "" : "truncated");
    }
    unsigned char *longer = calloc(whole->size + 1, 1);
    CHECK(longer != NULL);
    memcpy(longer, whole->bytes, whole->size);
    refuse_bytes(longer, whole->size + 1, CSTK_ERROR_PARSE, "damaged");
    free(longer);
}

static void altered(const content *whole) {
    for (size_t place = 0; place < whole->size; ++place) {
        const unsigned char masks[] = {0x01, 0x80, 0xFF};
        const int version = place >= VERSION_AT && place < VERSION_AT + 4;
        whole->bytes[place] ^= masks[place % 3];
        refuse_bytes(whole->bytes, whole->size, version ? CSTK_ERROR_UNSUPPORTED : CSTK_ERROR_PARSE,
                     version ? "version" : "");
        whole->bytes[place] ^= masks[place % 3];
    }
    /* Nothing but the altered bytes was to blame. */
    write_file("refused.cstk", whole->bytes, whole->size);
    CHECK_OK(cstk_body_release(load("refused.cstk")));
}

/* CRC-32 as in ISO 3309, bit by bit. */
static uint32_t checksum(const unsigned char *bytes, size_t size) {
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; ++i) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) {
            sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0);
        }
    }
    return ~sum;
}

static void put(unsigned char *bytes, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        bytes[i] = (unsigned char)(value >> 8 * i);
    }
}

static void sign(content *file) {
    put(file->bytes + SUM_AT, checksum(file->bytes + HEADER_SIZE, file->size - HEADER_SIZE));
    put(file->bytes + HEADER_SUM_AT, checksum(file->bytes, HEADER_SUM_AT));
}

/* The version counts before all else, whether the rest is right or not. */
static void newer(content *whole) {
    const uint32_t versions[] = {6, 8, 0x00010000, UINT32_MAX};
    for (int i = 0; i < 4; ++i) {
        char text[32];
        snprintf(text, sizeof text, "version %u", (unsigned)versions[i]);
        put(whole->bytes + VERSION_AT, versions[i]);
        sign(whole);
        refuse_bytes(whole->bytes, whole->size, CSTK_ERROR_UNSUPPORTED, text);
        put(whole->bytes + SUM_AT, 0);
        refuse_bytes(whole->bytes, HEADER_SIZE + 1, CSTK_ERROR_UNSUPPORTED, text);
    }
    put(whole->bytes + VERSION_AT, 7);
    sign(whole);
    CHECK(checksum((const unsigned char *)"123456789", 9) == 0xCBF43926u);
    write_file("signed.cstk", whole->bytes, whole->size);
    CHECK(same_content("signed.cstk", "small.cstk"));
}

/* A file that somebody made up, checksums and all: it is refused, or it is a body that can be
 * asked. */
static void ask_forged(const cstk_body *body) {
    cstk_query *query = NULL;
    cstk_hierarchy_statistics s;
    CHECK_OK(cstk_query_create(&query));
    CHECK_OK(cstk_body_get_hierarchy_statistics(body, &s));
    for (uint32_t i = 0; i < s.node_count; ++i) {
        cstk_hierarchy_node node;
        cstk_mesh *mesh = NULL;
        CHECK_OK(cstk_body_get_node(body, i, &node));
        const cstk_status status = cstk_mesh_create_from_nodes(body, &i, 1, &mesh);
        CHECK(status != CSTK_ERROR_INTERNAL);
        CHECK_OK(cstk_mesh_release(mesh));
    }
    for (int i = 0; i < 2; ++i) {
        cstk_distance_result d;
        cstk_witness_list list;
        double pose[12];
        random_pose(i, 2.0, pose);
        CHECK(cstk_pair_distance(query, body, identity_pose, body, pose, INFINITY, &d) !=
              CSTK_ERROR_INTERNAL);
        CHECK(cstk_pair_witnesses(query, body, identity_pose, body, pose, 1.0, 9, &list) !=
              CSTK_ERROR_INTERNAL);
    }
    CHECK_OK(cstk_query_release(query));
}

static void forged(content *whole) {
    const uint32_t values[] = {0, 1, 3, 0x7FF00000, 0x80000000, UINT32_MAX};
    content copy = {malloc(whole->size), whole->size};
    int loaded = 0;
    CHECK(copy.bytes != NULL);
    for (size_t place = HEADER_SIZE; place + 4 <= whole->size; place += 4) {
        for (size_t i = place / 4 % 2; i < 6; i += 2) {
            cstk_body *body = NULL;
            memcpy(copy.bytes, whole->bytes, whole->size);
            put(copy.bytes + place, values[i]);
            sign(&copy);
            write_file("forged.cstk", copy.bytes, copy.size);
            const cstk_status status = cstk_body_load(path_of("forged.cstk"), &body);
            CHECK(status == CSTK_OK || status == CSTK_ERROR_PARSE);
            if (status == CSTK_OK) {
                ask_forged(body);
                CHECK_OK(cstk_body_release(body));
                ++loaded;
            }
        }
    }
    CHECK(loaded > 0);
    free(copy.bytes);
}

int main(void) {
    use_folder("damaged_body_files_test");
    not_a_body();
    content small = small_file();
    truncated(&small);
    altered(&small);
    newer(&small);
    forged(&small);
    free(small.bytes);
    return check_result();
}
