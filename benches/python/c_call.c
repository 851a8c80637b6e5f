/* What a program in C pays for a batch of classes: the call of batch_time.py, on the same handles. */
#include <cstk.h>

#include <time.h>

typedef cstk_status classify_fn(cstk_batch *, const cstk_cobject *, const double *, size_t, size_t,
                                const cstk_batch_options *, cstk_progress_fn, void *, cstk_class *,
                                cstk_status *, cstk_batch_result *);

/* The seconds of one call, or -1 if it fails. The function is the one that Python calls: the
 * library is loaded once. */
double c_call(classify_fn *classify, cstk_batch *batch, const cstk_cobject *cobject,
              const double *q, size_t count, size_t nq, const cstk_batch_options *options,
              cstk_class *classes, cstk_status *statuses) {
    struct timespec start, end;
    cstk_batch_result done;
    clock_gettime(CLOCK_MONOTONIC, &start);
    cstk_status status = classify(batch, cobject, q, count, nq, options, NULL, NULL, classes,
                                  statuses, &done);
    clock_gettime(CLOCK_MONOTONIC, &end);
    return status == CSTK_OK && done.failed == 0
               ? (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec)
               : -1;
}
