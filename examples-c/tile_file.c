#include "tile_file.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { ALIGNMENT = 64 };

/* Ends the program with MPI's message. */
static void require_mpi(int code, const char *what) {
    if (code != MPI_SUCCESS) {
        char message[MPI_MAX_ERROR_STRING];
        int length = 0;
        MPI_Error_string(code, message, &length);
        fail("%s: %s", what, message);
    }
}

size_t header_of(const tile_work *work, char header[MAX_HEADER]) {
    enum { BEFORE = 10 };
    char *text = header + BEFORE;
    int length =
        snprintf(text, MAX_HEADER - BEFORE, "{'descr': '%s', 'fortran_order': False, 'shape': (",
                 work->value_size == 1 ? "|u1" : "<f8");
    for (size_t i = 0; i < work->axis_count; ++i) {
        length +=
            snprintf(text + length, MAX_HEADER - BEFORE - (size_t)length, "%zu, ", work->sides[i]);
    }
    length += snprintf(text + length, MAX_HEADER - BEFORE - (size_t)length, "), }");
    while ((BEFORE + length + 1) % ALIGNMENT != 0) {
        text[length++] = ' ';
    }
    text[length++] = '\n';
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    header[8] = (char)(length & 255);
    header[9] = (char)(length >> 8);
    return BEFORE + (size_t)length;
}

static MPI_Offset size_of_values(const tile_work *work) {
    MPI_Offset size = (MPI_Offset)work->value_size;
    for (size_t i = 0; i < work->axis_count; ++i) {
        size *= (MPI_Offset)work->sides[i];
    }
    return size;
}

void create_tile_file(const char *name, const tile_work *work) {
    char header[MAX_HEADER];
    size_t length = header_of(work, header);
    MPI_File file;
    require_mpi(
        MPI_File_open(MPI_COMM_SELF, name, MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file),
        name);
    require_mpi(MPI_File_set_size(file, (MPI_Offset)length + size_of_values(work)), name);
    require_mpi(MPI_File_write_at(file, 0, header, (int)length, MPI_BYTE, MPI_STATUS_IGNORE), name);
    require_mpi(MPI_File_sync(file), name);
    require_mpi(MPI_File_close(&file), name);
}

tile_file open_tile_file(const char *name, const tile_work *work) {
    char expected[MAX_HEADER], found[MAX_HEADER] = {0};
    tile_file f = {.header_size = (MPI_Offset)header_of(work, expected), .work = work};
    MPI_Offset size = 0;
    require_mpi(MPI_File_open(MPI_COMM_SELF, name, MPI_MODE_RDWR, MPI_INFO_NULL, &f.file), name);
    require_mpi(MPI_File_get_size(f.file, &size), name);
    require_mpi(MPI_File_read_at(f.file, 0, found, (int)f.header_size, MPI_BYTE, MPI_STATUS_IGNORE),
                name);
    if (size != f.header_size + size_of_values(work) ||
        memcmp(found, expected, (size_t)f.header_size) != 0) {
        fail("%s is not the file of this array; remove it, and its journal, to begin anew", name);
    }
    return f;
}

void write_tile(tile_file *f, const tile *t, const void *bytes) {
    const tile_work *work = f->work;
    MPI_Datatype value = work->value_size == 1 ? MPI_BYTE : MPI_DOUBLE;
    int sizes[MAX_AXES], counts[MAX_AXES], firsts[MAX_AXES];
    size_t size = tile_size(work, t);
    for (size_t i = 0; i < work->axis_count; ++i) {
        if (work->sides[i] > INT_MAX || size > INT_MAX) {
            fail("MPI counts in ints: axis %zu has too many values, or a tile has", i);
        }
        sizes[i] = (int)work->sides[i];
        counts[i] = (int)t->count[i];
        firsts[i] = (int)t->first[i];
    }
    MPI_Datatype place;
    require_mpi(MPI_Type_create_subarray((int)work->axis_count, sizes, counts, firsts, MPI_ORDER_C,
                                         value, &place),
                "a tile's place");
    require_mpi(MPI_Type_commit(&place), "a tile's place");
    require_mpi(MPI_File_set_view(f->file, f->header_size, value, place, "native", MPI_INFO_NULL),
                "a tile's place");
    MPI_Status status;
    int written = 0;
    require_mpi(MPI_File_write_at(f->file, 0, bytes, (int)size, MPI_BYTE, &status), "a tile");
    require_mpi(MPI_Get_count(&status, MPI_BYTE, &written), "a tile");
    if (written != (int)size) {
        fail("only %d of %zu bytes of a tile could be written", written, size);
    }
    require_mpi(MPI_Type_free(&place), "a tile's place");
}

void synchronise_tiles(tile_file *f) { require_mpi(MPI_File_sync(f->file), "the file of tiles"); }

void close_tile_file(tile_file *f) { require_mpi(MPI_File_close(&f->file), "the file of tiles"); }
