/* Hostile input to the queries of objects against objects, and what their filters may do. */
#include <math.h>

#include "check.h"
#include "fixture.h"

typedef struct question {
    cstk_query *query;
    const cstk_environment *environment;
    const cstk_environment *other;
    double number;
    size_t max_count;
    const cstk_object_pair_options *options;
} question;

typedef union answer {
    bool within;
    cstk_distance_result distance;
    cstk_witness_list list;
    cstk_object_pair_list pairs;
} answer;

static cstk_status pairs(const question *a, answer *out) {
    return cstk_environment_pairs(a->query, a->environment, a->other, a->number, a->max_count,
                                  a->options, out ? &out->pairs : NULL);
}

static cstk_status within(const question *a, answer *out) {
    return cstk_environment_within(a->query, a->environment, a->other, a->number, a->options,
                                   out ? &out->within : NULL);
}

static cstk_status distance(const question *a, answer *out) {
    return cstk_environment_distance(a->query, a->environment, a->other, a->number, a->options,
                                     out ? &out->distance : NULL);
}

static cstk_status witnesses(const question *a, answer *out) {
    return cstk_environment_witnesses(a->query, a->environment, a->other, a->number, a->max_count,
                                      a->options, out ? &out->list : NULL);
}

typedef struct form {
    const char *name;
    cstk_status (*ask)(const question *, answer *);
    const char *number;
} form;

static const form forms[] = {
    {"pairs", pairs, "distance"},
    {"within", within, "threshold"},
    {"distance", distance, "max_distance"},
    {"witnesses", witnesses, "epsilon"},
};

static void refuse(const form *of, const question *a, cstk_status status, const char *culprit) {
    answer out;
    const int before = check_failures;
    CHECK_REFUSED(out, of->ask(a, &out), status, culprit);
    if (check_failures > before) {
        fprintf(stderr, "  (cstk_environment_%s)\n", of->name);
    }
}

static void arguments(const fixture *f, const form *of, const question *good) {
    const double wrong[] = {NAN, -INFINITY, -1e-300};
    question a = *good;
    cstk_object_pair_options options;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        a.query = bad->handle;
        refuse(of, &a, bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        a = *good;
        a.environment = bad->handle;
        refuse(of, &a, bad->status, "environment");
        a = *good;
        a.other = bad->handle;
        if (a.other != NULL) {
            refuse(of, &a, bad->status, "other");
        }
    }
    CHECK_OK(cstk_object_pair_options_default(&options, sizeof options));
    EACH_BAD_OPTIONS(options, bad) {
        a = *good;
        a.options = bad->options;
        if (a.options != NULL) {
            refuse(of, &a, bad->status, "options");
        }
    }
    for (int i = 0; i < 3; ++i) {
        a = *good;
        a.number = wrong[i];
        refuse(of, &a, i == 0 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT, of->number);
    }
    CHECK_FAILS(of->ask(good, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    answer out;
    a = *good;
    a.number = INFINITY;
    a.max_count = SIZE_MAX;
    a.other = a.environment;
    CHECK_OK(of->ask(&a, &out));
}

/* Attached objects and objects of the plane. */
static void places(const fixture *f, const form *of, const question *good) {
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    cstk_body *flat = NULL;
    cstk_environment *held = NULL, *plane = NULL;
    cstk_environment_change change;
    answer out;
    CHECK_OK(cstk_environment_create(&held));
    CHECK_OK(cstk_environment_create(&plane));
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.id = add_object(held, f->body, 0, 0, 0);
    change.kind = CSTK_CHANGE_ATTACH;
    change.space = f->space;
    change.link = FIXTURE_TIP;
    CHECK_OK(cstk_environment_apply(held, &change, 1, NULL, NULL));
    question a = *good;
    a.other = held;
    refuse(of, &a, CSTK_ERROR_UNSUPPORTED, "attached");
    a.environment = held;
    a.other = NULL;
    refuse(of, &a, CSTK_ERROR_UNSUPPORTED, "attached");
    CHECK_OK(cstk_body_builder_create(2, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 0));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &flat));
    CHECK_OK(cstk_body_builder_release(builder));
    add_object(plane, flat, 0, 0, 0);
    add_object(plane, flat, 3, 0, 0);
    CHECK_OK(cstk_body_release(flat));
    a = *good;
    a.other = plane;
    refuse(of, &a, CSTK_ERROR_INVALID_ARGUMENT, "dimension");
    a.environment = plane;
    a.other = NULL;
    CHECK_OK(of->ask(&a, &out));
    CHECK_OK(cstk_environment_release(held));
    CHECK_OK(cstk_environment_release(plane));
}

typedef struct meddler {
    const question *asked;
    const form *of;
    cstk_environment *world;
    int32_t status;
    int calls;
} meddler;

static int32_t meddle(uint64_t r_object, uint64_t s_object, void *r_data, void *s_data, bool *out,
                      void *user) {
    meddler *m = user;
    answer ignored;
    ++m->calls;
    CHECK(r_object != s_object && r_data == NULL && s_data == NULL && *out);
    /* The context is busy; what the environment becomes, later calls see. */
    CHECK_FAILS(m->of->ask(m->asked, &ignored), CSTK_ERROR_BUSY, "query");
    cstk_body *body = make_box(1, 1, 1);
    add_object(m->world, body, 0, 0, 0);
    CHECK_OK(cstk_body_release(body));
    return m->status;
}

static void filters(const fixture *f, const form *of) {
    meddler m = {NULL, of, NULL, CSTK_OK, 0};
    cstk_body *body = make_box(1, 1, 1);
    cstk_object_pair_options options;
    CHECK_OK(cstk_environment_create(&m.world));
    add_object(m.world, body, 0, 0, 0);
    add_object(m.world, body, 1.5, 0, 0);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_object_pair_options_default(&options, sizeof options));
    options.filter = meddle;
    options.user = &m;
    question a = {f->query, m.world, NULL, 0, 16, &options};
    m.asked = &a;
    answer out;
    CHECK_OK(of->ask(&a, &out));
    CHECK(m.calls >= 1 && m.calls <= 2);
    m.status = 7;
    refuse(of, &a, CSTK_ERROR_CALLBACK_FAILED, "options->filter returned 7");
    CHECK_OK(cstk_environment_release(m.world));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    cstk_environment *two = NULL;
    CHECK_OK(cstk_environment_create(&two));
    add_object(two, f.body, 0, 0, 0);
    add_object(two, f.body, 100, 0, 0);
    CHECK_FAILS(cstk_object_pair_options_default(NULL, sizeof(cstk_object_pair_options)),
                CSTK_ERROR_NULL_ARGUMENT, "out");
    cstk_object_pair_options options;
    CHECK_REFUSED(options, cstk_object_pair_options_default(&options, 8), CSTK_ERROR_WRONG_SIZE,
                  "size");
    const question good = {f.query, two, f.environment, 10.0, 16, NULL};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        arguments(&f, &forms[i], &good);
        places(&f, &forms[i], &good);
        filters(&f, &forms[i]);
        fixture_unchanged(&f);
    }
    CHECK_OK(cstk_environment_release(two));
    fixture_release(&f);
    return check_result();
}
