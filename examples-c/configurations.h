/* The configurations that batch_mpi.c asks about: rows of a .npy file, or seeded ones. Each rank
 * has those that it needs without the others. */
#ifndef CONFIGURATIONS_H
#define CONFIGURATIONS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { MAX_SOURCE = 128 };

typedef struct configurations {
    size_t count, width;
    FILE *file;              /* NULL for seeded ones */
    uint64_t start;          /* where the file's numbers begin, or the seed */
    char source[MAX_SOURCE]; /* one line: equal for equal configurations */
} configurations;

/* Angles from -pi to pi; each depends on the seed and its place alone. */
configurations seeded_configurations(size_t count, size_t width, uint64_t seed);

/* Opens a file with doubles in rows of `width`, as NumPy's save writes them; ends the program if it
 * holds anything else. */
configurations open_configurations(const char *name, size_t width);

/* Writes `count` of them, from number `first` on, one after the other. */
void get_configurations(const configurations *c, size_t first, size_t count, double *out);

void close_configurations(configurations *c);

#endif
