/* Certificates with bad handles, numbers, options and files; and what they say of clear cases. */
#include <math.h>

#include "check.h"
#include "fixture.h"

typedef struct made {
    double reached[FIXTURE_NQ];
    cstk_motion_result result;
    cstk_certificate *certificate;
} made;

static void arguments_of_motion(const fixture *f) {
    made out;
    const double *q = f->q;
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_certificate(bad->handle, f->cobject, q, q, nq, NULL, out.reached,
                                              &out.result, &out.certificate),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_certificate(f->query, bad->handle, q, q, nq, NULL, out.reached,
                                              &out.result, &out.certificate),
                      bad->status, "cobject");
    }
    CHECK_REFUSED(out,
                  cstk_motion_certificate(f->query, f->cobject, NULL, q, nq, NULL, out.reached,
                                          &out.result, &out.certificate),
                  CSTK_ERROR_NULL_ARGUMENT, "q0");
    CHECK_REFUSED(out,
                  cstk_motion_certificate(f->query, f->cobject, q, NULL, nq, NULL, out.reached,
                                          &out.result, &out.certificate),
                  CSTK_ERROR_NULL_ARGUMENT, "q1");
    CHECK_REFUSED(out,
                  cstk_motion_certificate(f->query, f->cobject, q, q, nq, NULL, out.reached, NULL,
                                          &out.certificate),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out,
                  cstk_motion_certificate(f->query, f->cobject, q, q, nq, NULL, out.reached,
                                          &out.result, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "certificate");
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1};
    for (int i = 0; i < 3; ++i) {
        CHECK_REFUSED(out,
                      cstk_motion_certificate(f->query, f->cobject, q, q, counts[i], NULL, NULL,
                                              &out.result, &out.certificate),
                      CSTK_ERROR_WRONG_SIZE, "q0");
    }
    EACH_NOT_FINITE(i) {
        const double wrong[FIXTURE_NQ] = {q[0], not_finite[i], q[2]};
        CHECK_REFUSED(out,
                      cstk_motion_certificate(f->query, f->cobject, wrong, q, nq, NULL, out.reached,
                                              &out.result, &out.certificate),
                      CSTK_ERROR_NOT_FINITE, "q0");
        CHECK_REFUSED(out,
                      cstk_motion_certificate(f->query, f->cobject, q, wrong, nq, NULL, out.reached,
                                              &out.result, &out.certificate),
                      CSTK_ERROR_NOT_FINITE, "q1");
    }
    cstk_motion_options good;
    CHECK_OK(cstk_motion_options_default(&good, sizeof good));
    EACH_BAD_OPTIONS(good, bad) {
        CHECK_REFUSED(out,
                      cstk_motion_certificate(f->query, f->cobject, q, q, nq, bad->options,
                                              out.reached, &out.result, &out.certificate),
                      bad->status, "options");
    }
    good.threshold = -1;
    CHECK_REFUSED(out,
                  cstk_motion_certificate(f->query, f->cobject, q, q, nq, &good, out.reached,
                                          &out.result, &out.certificate),
                  CSTK_ERROR_INVALID_ARGUMENT, "threshold");
    cstk_cobject *complement = NULL;
    CHECK_OK(cstk_cobject_complement(f->cobject, &complement));
    CHECK_REFUSED(out,
                  cstk_motion_certificate(f->query, complement, q, q, nq, NULL, out.reached,
                                          &out.result, &out.certificate),
                  CSTK_ERROR_UNSUPPORTED, "C-object");
    CHECK_OK(cstk_cobject_release(complement));
}

static void arguments_of_verify(const fixture *f) {
    const double *q = f->q;
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_CERTIFICATE, bad) {
        CHECK_FAILS(cstk_certificate_verify(bad->handle, f->cobject, q, q, nq, 0), bad->status,
                    "certificate");
        CHECK_FAILS(cstk_certificate_retain(bad->handle), bad->status, "certificate");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_FAILS(cstk_certificate_verify(f->certificate, bad->handle, q, q, nq, 0), bad->status,
                    "cobject");
    }
    CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, NULL, q, nq, 0),
                CSTK_ERROR_NULL_ARGUMENT, "q0");
    CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, q, NULL, nq, 0),
                CSTK_ERROR_NULL_ARGUMENT, "q1");
    CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, q, q, nq - 1, 0),
                CSTK_ERROR_WRONG_SIZE, "q0");
    EACH_NOT_FINITE(i) {
        const double wrong[FIXTURE_NQ] = {q[0], not_finite[i], q[2]};
        CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, wrong, q, nq, 0),
                    CSTK_ERROR_NOT_FINITE, "q0");
        CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, q, wrong, nq, 0),
                    CSTK_ERROR_NOT_FINITE, "q1");
        CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, q, q, nq, not_finite[i]),
                    CSTK_ERROR_NOT_PROVED, "threshold");
    }
    CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, q, q, nq, 1e-9),
                CSTK_ERROR_NOT_PROVED, "threshold");
    const double other[FIXTURE_NQ] = {q[0], q[1], nextafter(q[2], 1)};
    CHECK_FAILS(cstk_certificate_verify(f->certificate, f->cobject, q, other, nq, 0),
                CSTK_ERROR_NOT_PROVED, "motion");
}

static void arguments_of_entries(const fixture *f) {
    cstk_certificate_summary summary;
    cstk_certificate_entry entry;
    struct {
        double q0[FIXTURE_NQ];
        double q1[FIXTURE_NQ];
    } ends;
    struct {
        uint32_t primitives[4];
        size_t count;
    } list;
    EACH_BAD_HANDLE(f, NOUN_CERTIFICATE, bad) {
        CHECK_REFUSED(summary, cstk_certificate_get_summary(bad->handle, &summary), bad->status,
                      "certificate");
        CHECK_REFUSED(entry, cstk_certificate_get_entry(bad->handle, 0, &entry), bad->status,
                      "certificate");
        CHECK_REFUSED(ends, cstk_certificate_get_ends(bad->handle, FIXTURE_NQ, ends.q0, ends.q1),
                      bad->status, "certificate");
        CHECK_REFUSED(
            list,
            cstk_certificate_get_primitives(bad->handle, 0, 0, 4, list.primitives, &list.count),
            bad->status, "certificate");
    }
    CHECK_FAILS(cstk_certificate_get_summary(f->certificate, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_certificate_get_entry(f->certificate, 0, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "out");
    CHECK_FAILS(cstk_certificate_get_ends(f->certificate, FIXTURE_NQ, NULL, ends.q1),
                CSTK_ERROR_NULL_ARGUMENT, "q0");
    CHECK_FAILS(cstk_certificate_get_ends(f->certificate, FIXTURE_NQ, ends.q0, NULL),
                CSTK_ERROR_NULL_ARGUMENT, "q1");
    CHECK_REFUSED(ends, cstk_certificate_get_ends(f->certificate, SIZE_MAX, ends.q0, ends.q1),
                  CSTK_ERROR_WRONG_SIZE, "nq");
    CHECK_OK(cstk_certificate_get_summary(f->certificate, &summary));
    CHECK(summary.nq == FIXTURE_NQ && summary.entry_count > 0 && summary.threshold == 0);
    const size_t beyond[] = {summary.entry_count, SIZE_MAX};
    for (int i = 0; i < 2; ++i) {
        CHECK_REFUSED(entry, cstk_certificate_get_entry(f->certificate, beyond[i], &entry),
                      CSTK_ERROR_NOT_FOUND, "entry");
        CHECK_REFUSED(list,
                      cstk_certificate_get_primitives(f->certificate, beyond[i], 0, 4,
                                                      list.primitives, &list.count),
                      CSTK_ERROR_NOT_FOUND, "entry");
    }
    CHECK_REFUSED(
        list,
        cstk_certificate_get_primitives(f->certificate, 0, 2, 4, list.primitives, &list.count),
        CSTK_ERROR_INVALID_ARGUMENT, "side");
    CHECK_REFUSED(list, cstk_certificate_get_primitives(f->certificate, 0, 0, 4, NULL, &list.count),
                  CSTK_ERROR_NULL_ARGUMENT, "primitives");
    CHECK_REFUSED(list,
                  cstk_certificate_get_primitives(f->certificate, 0, 0, 4, list.primitives, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "count");
    CHECK_OK(cstk_certificate_get_ends(f->certificate, FIXTURE_NQ, ends.q0, ends.q1));
    CHECK(memcmp(ends.q0, f->q, sizeof ends.q0) == 0 && memcmp(ends.q1, f->q, sizeof ends.q1) == 0);
    for (size_t i = 0; i < summary.entry_count; ++i) {
        CHECK_OK(cstk_certificate_get_entry(f->certificate, i, &entry));
        CHECK(entry.times[0] == 0 && entry.times[1] == 1 && entry.carrier <= 1);
        CHECK(entry.gap - entry.displacement > 0 && entry.displacement == 0);
        CHECK(entry.links[0] < FIXTURE_LINKS && entry.links[1] == UINT32_MAX);
        CHECK_OK(cstk_certificate_get_primitives(f->certificate, i, 1, 0, NULL, &list.count));
        CHECK(list.count == 1 && entry.primitive_counts[1] == 1);
    }
}

static void files(const fixture *f) {
    const char *file = "hostile_certificate_file";
    cstk_certificate *loaded = NULL;
    EACH_BAD_HANDLE(f, NOUN_CERTIFICATE, bad) {
        CHECK_FAILS(cstk_certificate_save(bad->handle, file), bad->status, "certificate");
    }
    CHECK_FAILS(cstk_certificate_save(f->certificate, NULL), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_FAILS(cstk_certificate_save(f->certificate, "/nowhere/x"), CSTK_ERROR_IO, "/nowhere/x");
    CHECK_REFUSED(loaded, cstk_certificate_load(NULL, &loaded), CSTK_ERROR_NULL_ARGUMENT, "file");
    CHECK_REFUSED(loaded, cstk_certificate_load("/nowhere/x", &loaded), CSTK_ERROR_IO, "/nowhere/x");
    CHECK_OK(cstk_certificate_save(f->certificate, file));
    CHECK_FAILS(cstk_certificate_load(file, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_OK(cstk_certificate_load(file, &loaded));
    CHECK_OK(cstk_certificate_verify(loaded, f->cobject, f->q, f->q, FIXTURE_NQ, 0));
    CHECK_OK(cstk_certificate_release(loaded));
    /* A body file is no certificate, nor is half of one. */
    CHECK_OK(cstk_body_save(f->body, file));
    CHECK_REFUSED(loaded, cstk_certificate_load(file, &loaded), CSTK_ERROR_PARSE, "certificate");
    FILE *half = fopen(file, "wb");
    CHECK(half != NULL && fwrite("cstkcert", 1, 8, half) == 8 && fclose(half) == 0);
    CHECK_REFUSED(loaded, cstk_certificate_load(file, &loaded), CSTK_ERROR_PARSE, "truncated");
    CHECK(remove(file) == 0);
}

static void answers(const fixture *f) {
    made out;
    double turned[FIXTURE_NQ] = {f->q[0] + 0.05, f->q[1] - 0.1, f->q[2]};
    CHECK_OK(cstk_motion_certificate(f->query, f->cobject, f->q, turned, FIXTURE_NQ, NULL,
                                     out.reached, &out.result, &out.certificate));
    CHECK(out.result.outcome == CSTK_MOTION_FREE && out.certificate != NULL);
    CHECK_OK(cstk_certificate_verify(out.certificate, f->cobject, f->q, turned, FIXTURE_NQ, 0));
    /* Of the environment as it is now. */
    const uint64_t added = add_object(f->environment, f->body, 0, 9, 0);
    CHECK_FAILS(cstk_certificate_verify(out.certificate, f->cobject, f->q, turned, FIXTURE_NQ, 0),
                CSTK_ERROR_NOT_PROVED, "bodies");
    cstk_environment_change gone;
    CHECK_OK(cstk_environment_change_default(&gone, sizeof gone));
    gone.kind = CSTK_CHANGE_DELETE;
    gone.id = added;
    CHECK_OK(cstk_environment_apply(f->environment, &gone, 1, NULL, NULL));
    CHECK_OK(cstk_certificate_verify(out.certificate, f->cobject, f->q, turned, FIXTURE_NQ, 0));
    CHECK_OK(cstk_certificate_release(out.certificate));
    /* Another box in the way. */
    add_object(f->environment, f->body, 0, 1, 0);
    turned[0] += 3.0;
    CHECK_OK(cstk_motion_certificate(f->query, f->cobject, f->q, turned, FIXTURE_NQ, NULL,
                                     out.reached, &out.result, &out.certificate));
    CHECK(out.result.outcome == CSTK_MOTION_HIT && out.certificate == NULL);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    arguments_of_motion(&f);
    arguments_of_verify(&f);
    arguments_of_entries(&f);
    files(&f);
    fixture_unchanged(&f);
    answers(&f);
    fixture_release(&f);
    return check_result();
}
