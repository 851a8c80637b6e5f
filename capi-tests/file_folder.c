#include "file_folder.h"

#include <dirent.h>
#include <sys/stat.h>

#include "bodies.h"
#include "check.h"

static const char *folder;

void use_folder(const char *name) {
    folder = name;
    mkdir(folder, 0777);
}

const char *path_of(const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

content read_file(const char *name) {
    content c = {NULL, 0};
    FILE *file = fopen(path_of(name), "rb");
    CHECK(file != NULL && fseek(file, 0, SEEK_END) == 0);
    c.size = (size_t)ftell(file);
    c.bytes = malloc(c.size + 1);
    CHECK(c.bytes != NULL);
    rewind(file);
    CHECK(fread(c.bytes, 1, c.size, file) == c.size && fclose(file) == 0);
    return c;
}

void write_file(const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(path_of(name), "wb");
    CHECK(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
}

int same_content(const char *a, const char *b) {
    content of_a = read_file(a);
    content of_b = read_file(b);
    const int same = of_a.size == of_b.size && memcmp(of_a.bytes, of_b.bytes, of_a.size) == 0;
    free(of_a.bytes);
    free(of_b.bytes);
    return same;
}

int files_with(const char *text) {
    int count = 0;
    DIR *listing = opendir(folder);
    CHECK(listing != NULL);
    for (struct dirent *entry = readdir(listing); entry != NULL; entry = readdir(listing)) {
        count += strstr(entry->d_name, text) != NULL;
    }
    CHECK(closedir(listing) == 0);
    return count;
}

cstk_body *load(const char *name) {
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_load(path_of(name), &body));
    return body;
}

content small_file(void) {
    const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, triangle, 3, 0));
    cstk_body *body = build_body(builder, NULL);
    CHECK_OK(cstk_body_save(body, path_of("small.cstk")));
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_body_builder_release(builder));
    return read_file("small.cstk");
}
