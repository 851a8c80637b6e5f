/* Hostile input to the queries of two bodies. */
#include <math.h>

#include "check.h"
#include "fixture.h"

typedef struct question {
    cstk_query *query;
    const cstk_body *body_a;
    const double *pose_a;
    const cstk_body *body_b;
    const double *pose_b;
    double number;
    size_t max_count;
} question;

typedef union answer {
    bool within;
    cstk_distance_result distance;
    cstk_witness_list list;
    cstk_penetration_list penetrations;
    cstk_depth_result depth;
} answer;

static cstk_status distance(const question *a, answer *out) {
    return cstk_pair_distance(a->query, a->body_a, a->pose_a, a->body_b, a->pose_b, a->number,
                              out ? &out->distance : NULL);
}

static cstk_status within(const question *a, answer *out) {
    return cstk_pair_within(a->query, a->body_a, a->pose_a, a->body_b, a->pose_b, a->number,
                            out ? &out->within : NULL);
}

static cstk_status witnesses(const question *a, answer *out) {
    return cstk_pair_witnesses(a->query, a->body_a, a->pose_a, a->body_b, a->pose_b, a->number,
                               a->max_count, out ? &out->list : NULL);
}

static cstk_status penetration(const question *a, answer *out) {
    return cstk_pair_penetration(a->query, a->body_a, a->pose_a, a->body_b, a->pose_b,
                                 a->max_count, out ? &out->penetrations : NULL);
}

/* The number is the tolerance: any that is not negative will do. */
static cstk_status depth(const question *a, answer *out) {
    cstk_depth_options options;
    CHECK_OK(cstk_depth_options_default(&options, sizeof options));
    options.tolerance = a->number;
    return cstk_pair_depth(a->query, a->body_a, a->pose_a, a->body_b, a->pose_b, &options,
                           out ? &out->depth : NULL);
}

typedef struct form {
    const char *name;
    cstk_status (*ask)(const question *, answer *);
    /* The name of its number; NULL if it has none. */
    const char *number;
} form;

static const form forms[] = {
    {"distance", distance, "max_distance"},
    {"within", within, "threshold"},
    {"witnesses", witnesses, "epsilon"},
    {"penetration", penetration, NULL},
    {"depth", depth, "options->tolerance"},
};

static void refuse(const form *of, const question *a, cstk_status status, const char *culprit) {
    answer out;
    const int before = check_failures;
    CHECK_REFUSED(out, of->ask(a, &out), status, culprit);
    if (check_failures > before) {
        fprintf(stderr, "  (cstk_pair_%s)\n", of->name);
    }
}

static question good_question(const fixture *f) {
    question a = {f->query, f->body, identity_pose, f->body, identity_pose, 10.0, 16};
    return a;
}

static void handles(const fixture *f, const form *of) {
    question a = good_question(f);
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        a.query = bad->handle;
        refuse(of, &a, bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        a = good_question(f);
        a.body_a = bad->handle;
        refuse(of, &a, bad->status, "body_a");
        a = good_question(f);
        a.body_b = bad->handle;
        refuse(of, &a, bad->status, "body_b");
    }
    a = good_question(f);
    CHECK_FAILS(of->ask(&a, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
}

static void poses(const fixture *f, const form *of) {
    question a = good_question(f);
    a.pose_a = NULL;
    refuse(of, &a, CSTK_ERROR_NULL_ARGUMENT, "pose_a");
    a = good_question(f);
    a.pose_b = NULL;
    refuse(of, &a, CSTK_ERROR_NULL_ARGUMENT, "pose_b");
    EACH_BAD_POSE(bad) {
        a = good_question(f);
        a.pose_a = bad->pose;
        refuse(of, &a, bad->status, "pose_a");
        a = good_question(f);
        a.pose_b = bad->pose;
        refuse(of, &a, bad->status, "pose_b");
    }
}

static void numbers(const fixture *f, const form *of) {
    const double wrong[] = {NAN, -INFINITY, -1e-300};
    question a = good_question(f);
    for (int i = 0; i < 3 && of->number != NULL; ++i) {
        a.number = wrong[i];
        refuse(of, &a, i == 0 ? CSTK_ERROR_NOT_FINITE : CSTK_ERROR_INVALID_ARGUMENT, of->number);
    }
    answer out;
    a.number = INFINITY;
    a.max_count = SIZE_MAX;
    CHECK_OK(of->ask(&a, &out));
}

/* Bodies of the plane stay in it, and among themselves. */
static void planar(const fixture *f, const form *of) {
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const double upside_down[12] = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0};
    double raised[12];
    cstk_body_builder *builder = NULL;
    cstk_body *flat = NULL;
    CHECK_OK(cstk_body_builder_create(2, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 0));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &flat));
    CHECK_OK(cstk_body_builder_release(builder));
    question a = good_question(f);
    a.body_b = flat;
    refuse(of, &a, CSTK_ERROR_INVALID_ARGUMENT, "dimension");
    a.body_a = flat;
    translation(0, 0, 1e-9, raised);
    a.pose_b = raised;
    refuse(of, &a, CSTK_ERROR_INVALID_ARGUMENT, "pose");
    a.pose_b = upside_down;
    refuse(of, &a, CSTK_ERROR_INVALID_ARGUMENT, "pose");
    CHECK_OK(cstk_body_release(flat));
}

/* A tetrahedron of any size is measured to 1e-12 of it, or refused as too large or too small: never
 * answered wrongly. */
static void scales(const fixture *f) {
    const double sizes[] = {1e-320, 1e-300, 1e-200, 1e-160, 1e-100, 1e-60, 1e-30,
                            1e-6,   1e6,    1e30,   1e49,   1e51,   1e160, 1e300};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        const double s = sizes[i];
        const double corners[12] = {0, 0, 0, s, 0, 0, 0, s, 0, 0, 0, s};
        double apart[12];
        cstk_body_builder *builder = NULL;
        cstk_body *body = NULL;
        cstk_distance_result d;
        CHECK_OK(cstk_body_builder_create(3, &builder));
        const cstk_status status = cstk_body_builder_add_polyhedron(builder, corners, 4, 0);
        if (status == CSTK_OK) {
            CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
            translation(3 * s, 0, 0, apart);
            CHECK_OK(cstk_pair_distance(f->query, body, identity_pose, body, apart, INFINITY, &d));
            if (!(fabs(d.distance - 2 * s) <= 3e-12 * s && d.lower <= 2 * s && 2 * s <= d.upper)) {
                fprintf(stderr, "scale %g: distance %g, lower %g, upper %g; expected %g\n", s,
                        d.distance, d.lower, d.upper, 2 * s);
                ++check_failures;
            }
            cstk_penetration_list deep;
            CHECK_OK(cstk_pair_penetration(f->query, body, identity_pose, body, identity_pose, 1,
                                           &deep));
            CHECK(deep.count == 1 && deep.of_whole_bodies && !deep.truncated);
            /* The least width of the tetrahedron, that along its slanted face. */
            CHECK(fabs(deep.penetrations[0].depth - s / sqrt(3)) <= 1e-12 * s);
            CHECK_OK(cstk_body_release(body));
        } else {
            CHECK_FAILS(status, s < 1 ? CSTK_ERROR_DEGENERATE : CSTK_ERROR_INVALID_ARGUMENT, "polyhedron");
        }
        CHECK_OK(cstk_body_builder_release(builder));
    }
}

/* Options of another size or without their cookie are refused, and surfaces that meet. */
static void depths(const fixture *f) {
    cstk_depth_options options;
    cstk_depth_result out;
    CHECK_FAILS(cstk_depth_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_OK(cstk_depth_options_default(&options, sizeof options));
    CHECK(options.tolerance == 0 && options.max_steps == 0);
    options.cookie ^= 1;
    CHECK_REFUSED(out, cstk_pair_depth(f->query, f->body, identity_pose, f->body, identity_pose,
                                       &options, &out),
                  CSTK_ERROR_NOT_INITIALISED, "options");
    CHECK_OK(cstk_depth_options_default(&options, sizeof options));
    options.size = 3;
    CHECK_REFUSED(out, cstk_pair_depth(f->query, f->body, identity_pose, f->body, identity_pose,
                                       &options, &out),
                  CSTK_ERROR_NOT_INITIALISED, "options");
    const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    cstk_body *surface = NULL;
    CHECK_OK(cstk_body_builder_create(3, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, triangle, 3, 0));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &surface));
    CHECK_OK(cstk_body_builder_release(builder));
    CHECK_REFUSED(out, cstk_pair_depth(f->query, surface, identity_pose, surface, identity_pose, NULL,
                                       &out),
                  CSTK_ERROR_UNSUPPORTED, "primitive 0 of body_a");
    CHECK_OK(cstk_body_release(surface));
}

int main(void) {
    fixture f;
    fixture_create(&f);
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        handles(&f, &forms[i]);
        poses(&f, &forms[i]);
        numbers(&f, &forms[i]);
        planar(&f, &forms[i]);
        fixture_unchanged(&f);
    }
    scales(&f);
    depths(&f);
    fixture_release(&f);
    return check_result();
}
