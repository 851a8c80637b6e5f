/* Files of bodies in a folder of the test's own. */
#ifndef CSTK_TESTS_FILE_FOLDER_H
#define CSTK_TESTS_FILE_FOLDER_H

#include <stddef.h>

#include <cstk.h>

typedef struct content {
    unsigned char *bytes;
    size_t size;
} content;

/* All names below are of files in this folder. */
void use_folder(const char *name);
/* Valid until the next call. */
const char *path_of(const char *name);
content read_file(const char *name);
void write_file(const char *name, const void *bytes, size_t size);
int same_content(const char *a, const char *b);
/* The number of files in the folder whose names hold a text. */
int files_with(const char *text);
cstk_body *load(const char *name);
/* The file of a triangle, saved as small.cstk. */
content small_file(void);

#endif
