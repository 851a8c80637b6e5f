/* Slides, and steps along lists of contacts, with bad handles, numbers, options and lists. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void slide_arguments(const fixture *f, const cstk_slide_options *options) {
    struct {
        double reached[FIXTURE_NQ];
        cstk_slide_result result;
    } out;
    const double *q = f->q;
    const double step[FIXTURE_NQ] = {0.01, 0, 0};
    const size_t nq = FIXTURE_NQ;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(
            out,
            cstk_slide(bad->handle, f->cobject, q, nq, step, nq, options, out.reached, &out.result),
            bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(
            out,
            cstk_slide(f->query, bad->handle, q, nq, step, nq, options, out.reached, &out.result),
            bad->status, "cobject");
    }
    const struct {
        const double *q;
        const double *step;
        const cstk_slide_options *options;
        double *reached;
        cstk_slide_result *result;
        const char *culprit;
    } null[] = {
        {NULL, step, options, out.reached, &out.result, "q"},
        {q, NULL, options, out.reached, &out.result, "step"},
        {q, step, NULL, out.reached, &out.result, "slide_options"},
        {q, step, options, NULL, &out.result, "reached"},
        {q, step, options, out.reached, NULL, "out"},
    };
    for (int i = 0; i < 5; ++i) {
        CHECK_REFUSED(out,
                      cstk_slide(f->query, f->cobject, null[i].q, nq, null[i].step, nq,
                                 null[i].options, null[i].reached, null[i].result),
                      CSTK_ERROR_NULL_ARGUMENT, null[i].culprit);
    }
    const size_t counts[] = {0, 1, FIXTURE_NQ - 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out,
                      cstk_slide(f->query, f->cobject, q, counts[i], step, nq, options, out.reached,
                                 &out.result),
                      CSTK_ERROR_WRONG_SIZE, "");
        CHECK_REFUSED(out,
                      cstk_slide(f->query, f->cobject, q, nq, step, counts[i], options, out.reached,
                                 &out.result),
                      CSTK_ERROR_WRONG_SIZE, "step");
    }
}

static void slide_numbers(const fixture *f, const cstk_slide_options *good) {
    struct {
        double reached[FIXTURE_NQ];
        cstk_slide_result result;
    } out;
    const double step[FIXTURE_NQ] = {0.01, 0, 0};
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            double bad[FIXTURE_NQ] = {0};
            bad[entry] = not_finite[i];
            CHECK_REFUSED(out,
                          cstk_slide(f->query, f->cobject, bad, FIXTURE_NQ, step, FIXTURE_NQ, good,
                                     out.reached, &out.result),
                          CSTK_ERROR_NOT_FINITE, "configuration");
            CHECK_REFUSED(out,
                          cstk_slide(f->query, f->cobject, f->q, FIXTURE_NQ, bad, FIXTURE_NQ, good,
                                     out.reached, &out.result),
                          CSTK_ERROR_NOT_FINITE, "step");
        }
    }
    const double far[] = {1e60, 1e200, 1e300};
    for (int i = 0; i < 3; ++i) {
        const double too_far[FIXTURE_NQ] = {far[i], 0, 0};
        CHECK_REFUSED(out,
                      cstk_slide(f->query, f->cobject, f->q, FIXTURE_NQ, too_far, FIXTURE_NQ, good,
                                 out.reached, &out.result),
                      CSTK_ERROR_INVALID_ARGUMENT, "step");
    }
}

static void slide_options(const fixture *f, const cstk_slide_options *good) {
    struct {
        double reached[FIXTURE_NQ];
        cstk_slide_result result;
    } out;
    const double step[FIXTURE_NQ] = {0.01, 0, 0};
    EACH_BAD_OPTIONS(*good, bad) {
        CHECK_REFUSED(out,
                      cstk_slide(f->query, f->cobject, f->q, FIXTURE_NQ, step, FIXTURE_NQ,
                                 bad->options, out.reached, &out.result),
                      bad->status, "slide_options");
    }
    const struct {
        double max_shell;
        double desired_distance;
        uint32_t max_witnesses;
        double floor;
        cstk_status status;
        const char *culprit;
    } wrong[] = {
        {NAN, -1, 256, 0.01, CSTK_ERROR_NOT_FINITE, "max_shell"},
        {INFINITY, -1, 256, 0.01, CSTK_ERROR_NOT_FINITE, "max_shell"},
        {0, -1, 256, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "max_shell"},
        {-1, -1, 256, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "max_shell"},
        {0.1, NAN, 256, 0.01, CSTK_ERROR_NOT_FINITE, "desired_distance"},
        {0.1, 0.2, 256, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "desired_distance"},
        {0.1, -1, 0, 0.01, CSTK_ERROR_INVALID_ARGUMENT, "max_witnesses"},
        {0.1, -1, 256, NAN, CSTK_ERROR_NOT_FINITE, "floor"},
        {0.1, -1, 256, INFINITY, CSTK_ERROR_NOT_FINITE, "floor"},
        {0.1, -1, 256, 0, CSTK_ERROR_INVALID_ARGUMENT, "floor"},
        {0.1, -1, 256, -0.01, CSTK_ERROR_INVALID_ARGUMENT, "floor"},
        {0.1, -1, 256, 1e-300, CSTK_ERROR_INVALID_ARGUMENT, "floor"},
        {0.1, -1, 256, 1.01, CSTK_ERROR_INVALID_ARGUMENT, "floor"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        cstk_slide_options options = *good;
        options.max_shell = wrong[i].max_shell;
        options.desired_distance = wrong[i].desired_distance;
        options.max_witnesses = wrong[i].max_witnesses;
        options.floor = wrong[i].floor;
        CHECK_REFUSED(out,
                      cstk_slide(f->query, f->cobject, f->q, FIXTURE_NQ, step, FIXTURE_NQ, &options,
                                 out.reached, &out.result),
                      wrong[i].status, wrong[i].culprit);
    }
}

static void slide(const fixture *f) {
    cstk_slide_options options;
    CHECK_OK(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = 0.1;
    slide_arguments(f, &options);
    slide_numbers(f, &options);
    slide_options(f, &options);
    fixture_unchanged(f);
}

/* A list with gradients at q, in a query context that lives as long as it does. */
static cstk_witness_list list_at(const fixture *f, cstk_query *query, double epsilon) {
    cstk_witness_list list;
    CHECK_OK(cstk_gradients(query, f->cobject, f->q, FIXTURE_NQ, epsilon, 16, &list));
    CHECK(list.nv == FIXTURE_NQ && (list.contact_count > 0) == (epsilon > f->distance.distance));
    return list;
}

typedef struct step_taken {
    double step[FIXTURE_NQ];
    bool found;
} step_taken;

static const double asked[FIXTURE_NQ] = {0.01, 0, 0};

/* Both functions of a list refuse it. */
static void refuse_list(const cstk_witness_list *list, size_t nv, cstk_status status,
                        const char *culprit) {
    step_taken out;
    CHECK_REFUSED(out, cstk_slide_step(list, asked, nv, 0.1, true, out.step, &out.found), status,
                  culprit);
    CHECK_REFUSED(out, cstk_spring_step(list, nv, 0.1, out.step, &out.found), status, culprit);
}

static void list_arrays(const cstk_witness_list *good) {
    refuse_list(NULL, FIXTURE_NQ, CSTK_ERROR_NULL_ARGUMENT, "list is NULL");
    cstk_witness_list bad = *good;
    bad.contacts = NULL;
    refuse_list(&bad, FIXTURE_NQ, CSTK_ERROR_NULL_ARGUMENT, "contacts");
    bad = *good;
    bad.gradients = NULL;
    refuse_list(&bad, FIXTURE_NQ, CSTK_ERROR_NULL_ARGUMENT, "gradients");
    const size_t counts[] = {SIZE_MAX, SIZE_MAX / sizeof(cstk_contact) + 1};
    for (int i = 0; i < 2; ++i) {
        bad = *good;
        bad.contact_count = counts[i];
        refuse_list(&bad, FIXTURE_NQ, CSTK_ERROR_WRONG_SIZE, "list->");
    }
    const size_t lengths[] = {0, 1, FIXTURE_NQ - 1, FIXTURE_NQ + 1};
    for (int i = 0; i < 4; ++i) {
        refuse_list(good, lengths[i], CSTK_ERROR_WRONG_SIZE, "nv");
    }
}

/* What the caller has spoiled after the query. */
static void list_numbers(const cstk_witness_list *good) {
    cstk_contact contact = good->contacts[0];
    double gradient[FIXTURE_NQ];
    cstk_witness_list bad = *good;
    bad.contacts = &contact;
    bad.gradients = gradient;
    bad.contact_count = 1;
    memcpy(gradient, good->gradients, sizeof gradient);
    EACH_NOT_FINITE(i) {
        contact.clearance = not_finite[i];
        refuse_list(&bad, FIXTURE_NQ, CSTK_ERROR_NOT_FINITE, "contacts[0]");
    }
    contact.clearance = 0.05;
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            memcpy(gradient, good->gradients, sizeof gradient);
            gradient[entry] = not_finite[i];
            refuse_list(&bad, FIXTURE_NQ, CSTK_ERROR_NOT_FINITE, "gradients");
        }
    }
}

static void list_arguments(const cstk_witness_list *list) {
    step_taken out;
    const size_t nv = FIXTURE_NQ;
    CHECK_REFUSED(out, cstk_slide_step(list, NULL, nv, 0.1, false, out.step, &out.found),
                  CSTK_ERROR_NULL_ARGUMENT, "step");
    CHECK_REFUSED(out, cstk_slide_step(list, asked, nv, 0.1, false, NULL, &out.found),
                  CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(out, cstk_slide_step(list, asked, nv, 0.1, false, out.step, NULL),
                  CSTK_ERROR_NULL_ARGUMENT, "found");
    CHECK_REFUSED(out, cstk_spring_step(list, nv, 0.1, NULL, &out.found), CSTK_ERROR_NULL_ARGUMENT,
                  "out");
    CHECK_REFUSED(out, cstk_spring_step(list, nv, 0.1, out.step, NULL), CSTK_ERROR_NULL_ARGUMENT,
                  "found");
    // More entries than there are addresses, where an empty list does not say how many.
    const cstk_witness_list none = {0};
    CHECK_REFUSED(out, cstk_spring_step(&none, SIZE_MAX, 0.1, out.step, &out.found),
                  CSTK_ERROR_WRONG_SIZE, "out");
    CHECK_REFUSED(out, cstk_slide_step(&none, asked, SIZE_MAX, 0.1, false, out.step, &out.found),
                  CSTK_ERROR_WRONG_SIZE, "out");
    const double distances[] = {NAN, INFINITY, -INFINITY, -1e-300, -1};
    for (int i = 0; i < 5; ++i) {
        const cstk_status status = i < 3 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT;
        CHECK_REFUSED(out,
                      cstk_slide_step(list, asked, nv, distances[i], false, out.step, &out.found),
                      status, "desired_distance");
        CHECK_REFUSED(out, cstk_spring_step(list, nv, distances[i], out.step, &out.found), status,
                      "desired_distance");
    }
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        double step[FIXTURE_NQ] = {0};
        EACH_NOT_FINITE(i) {
            step[entry] = not_finite[i];
            CHECK_REFUSED(out, cstk_slide_step(list, step, nv, 0.1, false, out.step, &out.found),
                          CSTK_ERROR_NOT_FINITE, "step");
        }
        step[entry] = entry == 1 ? -1e51 : 1e300;
        CHECK_REFUSED(out, cstk_slide_step(list, step, nv, 0.1, false, out.step, &out.found),
                      CSTK_ERROR_INVALID_ARGUMENT, "step");
    }
}

static void steps_of_lists(const fixture *f) {
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    cstk_witness_list list = list_at(f, query, 10.0);
    list_arrays(&list);
    list_numbers(&list);
    list_arguments(&list);
    /* Without contacts too the length must be that of the list. */
    list = list_at(f, query, 1e-3);
    refuse_list(&list, FIXTURE_NQ - 1, CSTK_ERROR_WRONG_SIZE, "nv");
    refuse_list(&list, FIXTURE_NQ + 1, CSTK_ERROR_WRONG_SIZE, "nv");
    /* A list that came without gradients. */
    CHECK_OK(cstk_witnesses(query, f->cobject, f->q, FIXTURE_NQ, 10.0, 16, &list));
    refuse_list(&list, FIXTURE_NQ, CSTK_ERROR_INVALID_ARGUMENT, "without gradients");
    /* And lists without all contacts, by which nothing would stand in the way. */
    CHECK_OK(cstk_query_set_contacts(query, CSTK_CONTACTS_NONE));
    CHECK_OK(cstk_gradients(query, f->cobject, f->q, FIXTURE_NQ, 10, 16, &list));
    CHECK(list.contacts_left_out && list.contact_count == 0);
    refuse_list(&list, list.nv, CSTK_ERROR_INVALID_ARGUMENT, "without all contacts");
    CHECK_OK(cstk_query_set_contacts(query, CSTK_CONTACTS_NEAREST));
    CHECK_OK(cstk_gradients(query, f->cobject, f->q, FIXTURE_NQ, 10, 16, &list));
    refuse_list(&list, list.nv, CSTK_ERROR_INVALID_ARGUMENT, "without all contacts");
    CHECK_OK(cstk_query_set_contacts(query, CSTK_CONTACTS_ALL));
    CHECK_OK(cstk_query_release(query));
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    slide(&f);
    steps_of_lists(&f);
    fixture_release(&f);
    return check_result();
}
