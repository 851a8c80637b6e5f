/* Hostile input to query contexts and to the queries of a C-object. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static void query_create(const fixture *f) {
    CHECK_FAILS(cstk_query_create(NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_FAILS(cstk_query_retain(bad->handle), bad->status, "query");
        if (bad->handle != NULL) {
            CHECK_FAILS(cstk_query_release(bad->handle), bad->status, "query");
        }
    }
    fixture_unchanged(f);
}

static void get_statistics(const fixture *f) {
    cstk_query_statistics out;
    cstk_query_statistics before;
    CHECK_OK(cstk_query_get_statistics(f->query, false, &before));
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out, cstk_query_get_statistics(bad->handle, true, &out), bad->status,
                      "query");
    }
    CHECK_FAILS(cstk_query_get_statistics(f->query, true, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    /* The call that failed has not reset them either. */
    CHECK_OK(cstk_query_get_statistics(f->query, false, &out));
    CHECK(before.primitive_pairs > 0 && memcmp(&before, &out, sizeof out) == 0);
    fixture_unchanged(f);
}

static void set_limit(const fixture *f) {
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_FAILS(cstk_query_set_limit(bad->handle, 1), bad->status, "query");
        CHECK_FAILS(cstk_query_set_contacts(bad->handle, CSTK_CONTACTS_NONE), bad->status, "query");
        CHECK_FAILS(cstk_query_set_refinement(bad->handle, 1), bad->status, "query");
    }
    fixture_unchanged(f);
}

/* The arguments of a query: by coordinates or by link poses, with the number some queries take (a
 * threshold, a largest distance, a shell) and the largest count. */
typedef struct question {
    cstk_query *query;
    const cstk_cobject *cobject;
    const double *at;
    size_t count;
    double number;
    size_t max_count;
} question;

/* Room for the output of any query. */
typedef union answer {
    cstk_class point_class;
    bool within;
    cstk_distance_result distance;
    cstk_witness_list list;
    cstk_pseudo_normal_result pseudo_normal;
    cstk_signed_distance_list signed_distances;
    cstk_explanation explanation;
} answer;

typedef cstk_status (*ask_fn)(const question *, answer *);

/* With no answer at all, `out` is NULL; its members then are as well, for all begin where the union
 * begins. */
static cstk_status classify(const question *a, answer *out) {
    return cstk_classify(a->query, a->cobject, a->at, a->count, out ? &out->point_class : NULL);
}

static cstk_status classify_at(const question *a, answer *out) {
    return cstk_classify_at_link_poses(a->query, a->cobject, a->at, a->count, out ? &out->point_class : NULL);
}

static cstk_status within(const question *a, answer *out) {
    return cstk_within(a->query, a->cobject, a->at, a->count, a->number, out ? &out->within : NULL);
}

static cstk_status within_at(const question *a, answer *out) {
    return cstk_within_at_link_poses(a->query, a->cobject, a->at, a->count, a->number,
                          out ? &out->within : NULL);
}

static cstk_status distance(const question *a, answer *out) {
    return cstk_distance(a->query, a->cobject, a->at, a->count, a->number,
                         out ? &out->distance : NULL);
}

static cstk_status distance_with_gradient(const question *a, answer *out) {
    double gradient[FIXTURE_NV];
    return cstk_distance_with_gradient(a->query, a->cobject, a->at, a->count, a->number, out ? &out->distance : NULL,
                                       gradient, FIXTURE_NV);
}

static cstk_status distance_at(const question *a, answer *out) {
    return cstk_distance_at_link_poses(a->query, a->cobject, a->at, a->count, a->number,
                            out ? &out->distance : NULL);
}

static cstk_status witnesses(const question *a, answer *out) {
    return cstk_witnesses(a->query, a->cobject, a->at, a->count, a->number, a->max_count,
                          out ? &out->list : NULL);
}

static cstk_status witnesses_at(const question *a, answer *out) {
    return cstk_witnesses_at_link_poses(a->query, a->cobject, a->at, a->count, a->number, a->max_count,
                             out ? &out->list : NULL);
}

static cstk_status explain(const question *a, answer *out) {
    return cstk_explain(a->query, a->cobject, a->at, a->count, a->max_count, out ? &out->explanation : NULL);
}

static cstk_status explain_at(const question *a, answer *out) {
    return cstk_explain_at_link_poses(a->query, a->cobject, a->at, a->count, a->max_count,
                                      out ? &out->explanation : NULL);
}

static cstk_status gradients(const question *a, answer *out) {
    return cstk_gradients(a->query, a->cobject, a->at, a->count, a->number, a->max_count,
                          out ? &out->list : NULL);
}

static cstk_status pseudo_normal(const question *a, answer *out) {
    return cstk_pseudo_normal(a->query, a->cobject, a->at, a->count, a->number, a->max_count, true,
                              out ? &out->pseudo_normal : NULL);
}

static cstk_status signed_distances(const question *a, answer *out) {
    return cstk_signed_distances(a->query, a->cobject, a->at, a->count, a->number, a->max_count, NULL,
                                 out ? &out->signed_distances : NULL);
}

typedef struct form {
    const char *name;
    ask_fn ask;
    /* Takes link poses instead of q. */
    bool by_poses;
    /* What the number is called, or NULL if the query takes none. */
    const char *number;
} form;

static const form forms[] = {
    {"classify", classify, false, NULL},
    {"classify_at", classify_at, true, NULL},
    {"within", within, false, "threshold"},
    {"within_at", within_at, true, "threshold"},
    {"distance", distance, false, "max_distance"},
    {"distance_with_gradient", distance_with_gradient, false, "max_distance"},
    {"distance_at", distance_at, true, "max_distance"},
    {"witnesses", witnesses, false, "epsilon"},
    {"witnesses_at", witnesses_at, true, "epsilon"},
    {"explain", explain, false, NULL},
    {"explain_at", explain_at, true, NULL},
    {"gradients", gradients, false, "epsilon"},
    {"pseudo_normal", pseudo_normal, false, "max_shell"},
    {"signed_distances", signed_distances, false, "max_distance"},
};

static question good_question(const fixture *f, const form *of) {
    question a = {f->query,
                  f->cobject,
                  of->by_poses ? f->link_poses : f->q,
                  of->by_poses ? FIXTURE_LINKS : FIXTURE_NQ,
                  10.0,
                  16};
    return a;
}

static void refuse(const form *of, const question *a, cstk_status status, const char *culprit) {
    answer out;
    const int before = check_failures;
    CHECK_REFUSED(out, of->ask(a, &out), status, culprit);
    if (check_failures > before) {
        fprintf(stderr, "  (cstk_%s)\n", of->name);
    }
}

static void query_handles(const fixture *f, const form *of) {
    question a = good_question(f, of);
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        a.query = bad->handle;
        refuse(of, &a, bad->status, "query");
    }
    a.query = f->query;
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        a.cobject = bad->handle;
        refuse(of, &a, bad->status, "cobject");
    }
    a.cobject = f->cobject;
    CHECK_FAILS(of->ask(&a, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    a.at = NULL;
    refuse(of, &a, CSTK_ERROR_NULL_ARGUMENT, of->by_poses ? "link_poses" : "q is NULL");
}

static void query_counts(const fixture *f, const form *of) {
    question a = good_question(f, of);
    const size_t good = a.count;
    const size_t counts[] = {0, 1, good - 1, SIZE_MAX, SIZE_MAX / 8 + 2};
    for (int i = 0; i < 5; ++i) {
        a.count = counts[i];
        refuse(of, &a, CSTK_ERROR_WRONG_SIZE, "");
    }
}

static void query_numbers(const fixture *f, const form *of) {
    question a = good_question(f, of);
    if (of->number != NULL) {
        const double numbers[] = {NAN, -INFINITY, -1e-300};
        for (int i = 0; i < 3; ++i) {
            a.number = numbers[i];
            refuse(of, &a, i == 0 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT, of->number);
        }
        /* The largest count there is asks for all, and takes no memory for those that are not
         * there. */
        answer out;
        a.number = INFINITY;
        a.max_count = SIZE_MAX;
        CHECK_OK(of->ask(&a, &out));
    }
}

static void query_coordinates(const fixture *f, const form *of) {
    question a = good_question(f, of);
    double q[FIXTURE_NQ];
    a.at = q;
    for (int entry = 0; entry < FIXTURE_NQ; ++entry) {
        EACH_NOT_FINITE(i) {
            memcpy(q, f->q, sizeof q);
            q[entry] = not_finite[i];
            refuse(of, &a, CSTK_ERROR_NOT_FINITE, "configuration");
        }
    }
    q[FIXTURE_NQ - 1] = 1e300;
    refuse(of, &a, CSTK_ERROR_INVALID_ARGUMENT, "configuration");
}

static void query_poses(const fixture *f, const form *of) {
    question a = good_question(f, of);
    double poses[12 * FIXTURE_LINKS];
    a.at = poses;
    EACH_BAD_POSE(bad) {
        memcpy(poses, f->link_poses, sizeof poses);
        memcpy(poses + 12 * FIXTURE_TIP, bad->pose, sizeof bad->pose);
        refuse(of, &a, bad->status, "link_poses[3]");
    }
}

static void query_limits(const fixture *f, const form *of) {
    /* A class or a threshold may be decided by the one pair that the context remembers. */
    if (of->number == NULL || strcmp(of->number, "threshold") == 0) {
        return;
    }
    const question a = good_question(f, of);
    answer out;
    CHECK_FAILS(cstk_query_set_contacts(f->query, 3), CSTK_ERROR_INVALID_ARGUMENT, "3 is none");
    CHECK_FAILS(cstk_query_set_contacts(f->query, -1), CSTK_ERROR_INVALID_ARGUMENT, "-1 is none");
    CHECK_FAILS(cstk_query_set_refinement(f->query, 0), CSTK_ERROR_INVALID_ARGUMENT, "gap is 0");
    CHECK_FAILS(cstk_query_set_refinement(f->query, -INFINITY), CSTK_ERROR_NOT_FINITE, "gap");
    CHECK_FAILS(cstk_query_set_refinement(f->query, NAN), CSTK_ERROR_NOT_FINITE, "gap");
    CHECK_OK(cstk_query_set_refinement(f->query, 1e-300));
    CHECK_OK(of->ask(&a, &out));
    CHECK_OK(cstk_query_set_refinement(f->query, INFINITY));
    CHECK_OK(cstk_query_set_contacts(f->query, CSTK_CONTACTS_NEAREST));
    CHECK_OK(cstk_query_set_contacts(f->query, CSTK_CONTACTS_ALL));
    CHECK_OK(cstk_query_set_limit(f->query, 1));
    refuse(of, &a, CSTK_ERROR_LIMIT, "limit of 1");
    CHECK_OK(cstk_query_set_limit(f->query, UINT64_MAX));
    CHECK_OK(of->ask(&a, &out));
    CHECK_OK(cstk_query_set_limit(f->query, 0));
    CHECK_OK(of->ask(&a, &out));
}

/* A refused gradient leaves the distance alone too; else both are what others say. */
static void gradient_of_the_nearest(const fixture *f) {
    cstk_distance_result out;
    double gradient[FIXTURE_NV];
    CHECK_REFUSED(out, cstk_distance_with_gradient(f->query, f->cobject, f->q, FIXTURE_NQ, INFINITY, &out, NULL, FIXTURE_NV),
                  CSTK_ERROR_NULL_ARGUMENT, "gradient");
    const size_t counts[] = {0, FIXTURE_NV - 1, FIXTURE_NV + 1, SIZE_MAX};
    for (int i = 0; i < 4; ++i) {
        CHECK_REFUSED(out, cstk_distance_with_gradient(f->query, f->cobject, f->q, FIXTURE_NQ, INFINITY, &out, gradient, counts[i]),
                      CSTK_ERROR_WRONG_SIZE, "nv");
    }
    CHECK_REFUSED(gradient, cstk_distance_with_gradient(f->query, f->cobject, f->q, FIXTURE_NQ, -1, &out, gradient, FIXTURE_NV),
                  CSTK_ERROR_INVALID_ARGUMENT, "max_distance");
    cstk_distance_result alone;
    cstk_witness_list list;
    CHECK_OK(cstk_distance(f->query, f->cobject, f->q, FIXTURE_NQ, INFINITY, &alone));
    CHECK_OK(cstk_distance_with_gradient(f->query, f->cobject, f->q, FIXTURE_NQ, INFINITY, &out, gradient, FIXTURE_NV));
    CHECK(out.distance == alone.distance && out.has_contact && out.distance > 0);
    CHECK_OK(cstk_gradients(f->query, f->cobject, f->q, FIXTURE_NQ, out.upper, 1, &list));
    CHECK(list.nv == FIXTURE_NV && memcmp(gradient, list.gradients, sizeof gradient) == 0);
    /* Nothing is near: zeros. */
    gradient[0] = 7;
    CHECK_OK(cstk_distance_with_gradient(f->query, f->cobject, f->q, FIXTURE_NQ, 0, &out, gradient, FIXTURE_NV));
    CHECK(out.kind == CSTK_DISTANCE_BEYOND_MAX && gradient[0] == 0);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    query_create(&f);
    get_statistics(&f);
    set_limit(&f);
    gradient_of_the_nearest(&f);
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        query_handles(&f, &forms[i]);
        query_counts(&f, &forms[i]);
        query_numbers(&f, &forms[i]);
        query_limits(&f, &forms[i]);
        if (forms[i].by_poses) {
            query_poses(&f, &forms[i]);
        } else {
            query_coordinates(&f, &forms[i]);
        }
        fixture_unchanged(&f);
    }
    fixture_release(&f);
    return check_result();
}
