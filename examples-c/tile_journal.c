#include "tile_journal.h"

#include <errno.h>
#include <fcntl.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A line has always as many bytes: one that was cut short is seen. */
#define LINE "tile %010zu\n"
enum { LINE_LENGTH = 16, LINE_ROOM = 32 };

bool journal_exists(const char *name) { return access(name, F_OK) == 0; }

static void append(const journal *j, const char *text, size_t length) {
    while (length > 0) {
        ssize_t written = write(j->file, text, length);
        if (written < 0 && errno != EINTR) {
            fail("%s: %s", j->name, strerror(errno));
        }
        if (written > 0) {
            text += written;
            length -= (size_t)written;
        }
    }
}

static void synchronise(journal *j) {
    if (fdatasync(j->file) != 0) {
        fail("%s: %s", j->name, strerror(errno));
    }
    j->synchronised = MPI_Wtime();
}

static journal open_journal(const char *name, int flags) {
    journal j = {open(name, flags | O_APPEND | O_CLOEXEC, 0666), name, 0};
    if (j.file < 0) {
        fail("%s: %s", name, strerror(errno));
    }
    return j;
}

journal begin_journal(const char *name, const tile_work *work) {
    journal j = open_journal(name, O_CREAT | O_EXCL | O_WRONLY);
    append(&j, work->description, strlen(work->description));
    append(&j, "\n", 1);
    synchronise(&j);
    return j;
}

/* The tile of a line, or the number of tiles if it is no line of a journal. */
static size_t tile_of(const char *line, const tile_work *work) {
    char expected[LINE_ROOM];
    size_t number =
        strncmp(line, "tile ", 5) == 0 ? strtoull(line + 5, NULL, 10) : work->tile_count;
    if (number >= work->tile_count) {
        return work->tile_count;
    }
    snprintf(expected, sizeof expected, LINE, number);
    return memcmp(line, expected, LINE_LENGTH) == 0 ? number : work->tile_count;
}

size_t resume_journal(const char *name, const tile_work *work, bool *done, journal *out) {
    FILE *file = fopen(name, "rb");
    if (file == NULL) {
        fail("%s: %s", name, strerror(errno));
    }
    char head[MAX_DESCRIPTION + 2], line[LINE_LENGTH + 1] = {0};
    size_t length = strlen(work->description);
    bool is_begun = fgets(head, sizeof head, file) != NULL && strchr(head, '\n') != NULL;
    if (is_begun && (strncmp(head, work->description, length) != 0 || head[length] != '\n')) {
        fail("%s belongs to another array, \"%.*s\"; remove it to begin anew", name,
             (int)strcspn(head, "\n"), head);
    }
    size_t count = 0, sound = length + 1;
    while (is_begun && fread(line, LINE_LENGTH, 1, file) == 1) {
        size_t number = tile_of(line, work);
        if (number == work->tile_count) {
            break;
        }
        count += done[number] ? 0 : 1;
        done[number] = true;
        sound += LINE_LENGTH;
    }
    fclose(file);
    *out = open_journal(name, O_WRONLY);
    /* A line that was cut short goes, so that the next begins where it began. */
    if (ftruncate(out->file, is_begun ? (off_t)sound : 0) != 0) {
        fail("%s: %s", name, strerror(errno));
    }
    if (!is_begun) {
        append(out, work->description, length);
        append(out, "\n", 1);
    }
    synchronise(out);
    return count;
}

void add_to_journal(journal *j, size_t tile_number) {
    char line[LINE_ROOM];
    snprintf(line, sizeof line, LINE, tile_number);
    append(j, line, LINE_LENGTH);
    /* Not each line: it would keep rank 0 from answering for as long as the disk takes. */
    if (MPI_Wtime() - j->synchronised > 1) {
        synchronise(j);
    }
}

void close_journal(journal *j) {
    synchronise(j);
    close(j->file);
}
