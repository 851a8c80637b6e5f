#include "configurations.h"
#include "tile_work.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#define PI 3.14159265358979323846

/* Of a file's header; NumPy's own are 128 bytes long. */
enum { MAX_TEXT = 4096 };

/* Number n of a sequence (splitmix64), as an angle. */
static double angle(uint64_t seed, uint64_t n) {
    uint64_t x = seed + (n + 1) * 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    x ^= x >> 31;
    return PI * (2 * 0x1p-53 * (double)(x >> 11) - 1);
}

configurations seeded_configurations(size_t count, size_t width, uint64_t seed) {
    configurations c = {.count = count, .width = width, .start = seed};
    snprintf(c.source, sizeof c.source, "%zu of seed %llu", count, (unsigned long long)seed);
    return c;
}

/* The header's text, with a terminator; returns where the numbers begin, or 0 if this is no .npy
 * file. */
static uint64_t read_header(FILE *file, char text[MAX_TEXT]) {
    unsigned char head[12] = {0};
    /* From version 2 on the length has four bytes. */
    bool is_npy = fread(head, 10, 1, file) == 1 && memcmp(head, "\x93NUMPY", 6) == 0;
    size_t before = head[6] == 1 ? 10 : 12;
    if (!is_npy || head[6] == 0 || head[6] > 3 ||
        (before == 12 && fread(head + 10, 2, 1, file) != 1)) {
        return 0;
    }
    size_t length =
        head[8] | (size_t)head[9] << 8 | (size_t)head[10] << 16 | (size_t)head[11] << 24;
    if (length >= MAX_TEXT || fread(text, 1, length, file) != length) {
        return 0;
    }
    text[length] = '\0';
    return before + length;
}

configurations open_configurations(const char *name, size_t width) {
    configurations c = {.width = width, .file = fopen(name, "rb")};
    struct stat status;
    if (c.file == NULL || fstat(fileno(c.file), &status) != 0) {
        fail("%s: %s", name, strerror(errno));
    }
    char text[MAX_TEXT] = {0};
    size_t columns = 0;
    uint64_t size = (uint64_t)status.st_size, row = width * sizeof(double);
    c.start = read_header(c.file, text);
    const char *shape = strstr(text, "'shape': (");
    bool is_known = c.start > 0 && shape != NULL && strstr(text, "'descr': '<f8'") != NULL &&
                    strstr(text, "'fortran_order': False") != NULL &&
                    sscanf(shape, "'shape': (%zu, %zu", &c.count, &columns) == 2;
    if (!is_known || columns != width || c.count == 0 || c.count > size / row ||
        size != c.start + c.count * row) {
        fail("%s is no .npy file of little-endian doubles in rows of %zu", name, width);
    }
    snprintf(c.source, sizeof c.source, "%zu of a file of %lld.%09ld", c.count,
             (long long)status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
    return c;
}

void get_configurations(const configurations *c, size_t first, size_t count, double *out) {
    if (c->file == NULL) {
        for (size_t i = 0; i < count * c->width; ++i) {
            out[i] = angle(c->start, first * c->width + i);
        }
        return;
    }
    off_t place = (off_t)(c->start + first * c->width * sizeof *out);
    if (fseeko(c->file, place, SEEK_SET) != 0 ||
        fread(out, c->width * sizeof *out, count, c->file) != count) {
        fail("configurations from number %zu on cannot be read: %s", first, strerror(errno));
    }
}

void close_configurations(configurations *c) {
    if (c->file != NULL) {
        fclose(c->file);
    }
}
