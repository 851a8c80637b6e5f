/* Assertions of the C tests. A failed CHECK or CHECK_STATUS ends the program; a failed CHECK_FAILS
 * is counted, so that one run lists all wrong refusals. Programs end with `return check_result();`.
 */
#ifndef CSTK_TESTS_CHECK_H
#define CSTK_TESTS_CHECK_H

#include <cstk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check_failures;

static inline int check_result(void) {
    if (check_failures > 0) {
        fprintf(stderr, "%d checks failed\n", check_failures);
    }
    return check_failures > 0 ? 1 : 0;
}

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);                \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static inline void check_status(cstk_status got, cstk_status expected, const char *call,
                                const char *file, int line) {
    if (got != expected) {
        fprintf(stderr, "%s:%d: %s\n  answered %s, expected %s: %s\n", file, line, call,
                cstk_status_name(got), cstk_status_name(expected), cstk_last_error_message());
        exit(1);
    }
}

#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)
#define CHECK_OK(call) CHECK_STATUS(call, CSTK_OK)

/* The call failed with this status, and the message names the culprit. */
static inline void check_fails(cstk_status got, cstk_status expected, const char *culprit,
                               const char *call, const char *file, int line) {
    const char *message = got == CSTK_OK ? "" : cstk_last_error_message();
    const int named = message[0] != '\0' && strstr(message, culprit) != NULL;
    if (got != expected || !named) {
        fprintf(stderr,
                "%s:%d: %s\n  answered %s \"%s\"\n  expected %s and a message with \"%s\"\n", file,
                line, call, cstk_status_name(got), message, cstk_status_name(expected), culprit);
        ++check_failures;
    }
}

#define CHECK_FAILS(call, expected, culprit)                                                       \
    check_fails((call), (expected), (culprit), #call, __FILE__, __LINE__)

/* A failed call has written no output: all bytes still hold the sentinel. */
#define CHECK_SENTINEL 0xA5

static inline void check_untouched(const void *output, size_t size, const char *call,
                                   const char *file, int line) {
    const unsigned char *bytes = output;
    for (size_t i = 0; i < size; ++i) {
        if (bytes[i] != CHECK_SENTINEL) {
            fprintf(stderr, "%s:%d: %s\n  failed, but wrote byte %zu of its output\n", file, line,
                    call, i);
            ++check_failures;
            return;
        }
    }
}

/* CHECK_FAILS for a call with an output, given as a variable or an array. */
#define CHECK_REFUSED(output, call, expected, culprit)                                             \
    do {                                                                                           \
        memset(&(output), CHECK_SENTINEL, sizeof(output));                                         \
        CHECK_FAILS(call, expected, culprit);                                                      \
        check_untouched(&(output), sizeof(output), #call, __FILE__, __LINE__);                     \
    } while (0)

#endif
