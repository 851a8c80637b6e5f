/* The environment: changes that happen whole or not at all, ids, snapshots, and answers that follow
 * the changes. */
#include <math.h>

#include "check.h"
#include "fixture.h"

static cstk_environment_change change_of(int32_t kind, uint64_t id, const cstk_body *body, double x,
                                         double y) {
    cstk_environment_change change;
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.kind = kind;
    change.id = id;
    change.body = body;
    translation(x, y, 0, change.pose);
    return change;
}

static void check_state(const cstk_environment *environment, size_t objects, uint64_t version) {
    size_t count = 99;
    uint64_t now = 99;
    CHECK_OK(cstk_environment_get_state(environment, &count, &now));
    CHECK(count == objects && now == version);
}

static void check_at(const cstk_environment *environment, uint64_t id, double x) {
    double pose[12];
    CHECK_OK(cstk_environment_get_object_pose(environment, id, pose));
    CHECK(pose[3] == x && pose[0] == 1.0);
}

/* One apply may add, move and delete, also what it added or moved itself a moment before. */
static void changes(const cstk_body *body) {
    cstk_environment *e = NULL;
    uint64_t ids[4];
    uint64_t version = 99;
    CHECK_OK(cstk_environment_create(&e));
    check_state(e, 0, 0);
    const cstk_environment_change add[3] = {change_of(CSTK_CHANGE_ADD, 0, body, 1, 0),
                                            change_of(CSTK_CHANGE_ADD, 0, body, 2, 0),
                                            change_of(CSTK_CHANGE_ADD, 0, body, 3, 0)};
    CHECK_OK(cstk_environment_apply(e, add, 3, ids, &version));
    CHECK(version == 1 && ids[0] != 0 && ids[0] < ids[1] && ids[1] < ids[2]);
    check_state(e, 3, 1);
    const cstk_environment_change mixed[4] = {change_of(CSTK_CHANGE_MOVE, ids[0], NULL, 7, 0),
                                              change_of(CSTK_CHANGE_MOVE, ids[0], NULL, 8, 0),
                                              change_of(CSTK_CHANGE_DELETE, ids[1], NULL, 0, 0),
                                              change_of(CSTK_CHANGE_ADD, 0, body, 4, 0)};
    uint64_t about[4];
    CHECK_OK(cstk_environment_apply(e, mixed, 4, about, NULL));
    CHECK(about[0] == ids[0] && about[1] == ids[0] && about[2] == ids[1] && about[3] > ids[2]);
    check_state(e, 3, 2);
    check_at(e, ids[0], 8);
    check_at(e, ids[2], 3);
    check_at(e, about[3], 4);
    double pose[12];
    CHECK_REFUSED(pose, cstk_environment_get_object_pose(e, ids[1], pose), CSTK_ERROR_NOT_FOUND, "id");
    CHECK_OK(cstk_environment_apply(e, add, 1, NULL, NULL));
    check_state(e, 4, 3);
    CHECK_OK(cstk_environment_release(e));
}

/* The last of three changes fails: none of them is seen. */
static void failed_apply(const cstk_body *body) {
    cstk_environment *e = NULL;
    uint64_t ids[3];
    CHECK_OK(cstk_environment_create(&e));
    const uint64_t first = add_object(e, body, 1, 0, 0);
    const uint64_t second = add_object(e, body, 2, 0, 0);
    const cstk_environment_change wrong[3] = {change_of(CSTK_CHANGE_MOVE, first, NULL, 9, 0),
                                              change_of(CSTK_CHANGE_DELETE, second, NULL, 0, 0),
                                              change_of(CSTK_CHANGE_MOVE, second, NULL, 9, 0)};
    CHECK_REFUSED(ids, cstk_environment_apply(e, wrong, 3, ids, NULL), CSTK_ERROR_NOT_FOUND, "change");
    check_state(e, 2, 2);
    check_at(e, first, 1);
    check_at(e, second, 2);
    CHECK_OK(cstk_environment_release(e));
}

/* Not after a deletion, not after a failure, not in another environment. */
static void ids_are_new(const cstk_body *body) {
    enum { ROUNDS = 200 };
    cstk_environment *environments[2] = {NULL, NULL};
    uint64_t last = 0;
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_environment_create(&environments[i]));
    }
    for (int i = 0; i < ROUNDS; ++i) {
        cstk_environment *e = environments[i % 2];
        const uint64_t id = add_object(e, body, i, 0, 0);
        CHECK(id > last);
        last = id;
        const cstk_environment_change gone = change_of(CSTK_CHANGE_DELETE, id, NULL, 0, 0);
        CHECK_OK(cstk_environment_apply(e, &gone, 1, NULL, NULL));
        CHECK_FAILS(cstk_environment_apply(e, &gone, 1, NULL, NULL), CSTK_ERROR_NOT_FOUND, "id");
    }
    for (int i = 0; i < 2; ++i) {
        check_state(environments[i], 0, ROUNDS);
        CHECK_OK(cstk_environment_release(environments[i]));
    }
}

static double distance_to(const fixture *f, const cstk_environment *environment) {
    cstk_cobject *cobject = NULL;
    cstk_distance_result d;
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, environment, NULL, 0, NULL, &cobject));
    CHECK_OK(cstk_distance(f->query, cobject, f->q, FIXTURE_NQ, INFINITY, &d));
    CHECK_OK(cstk_cobject_release(cobject));
    return d.distance;
}

static void snapshots(const fixture *f) {
    cstk_environment *frozen = NULL;
    uint64_t version;
    CHECK_OK(cstk_environment_snapshot(f->environment, &frozen));
    check_state(frozen, 1, 1);
    const cstk_environment_change add = change_of(CSTK_CHANGE_ADD, 0, f->body, 9, 9);
    CHECK_REFUSED(version, cstk_environment_apply(frozen, &add, 1, NULL, &version),
                  CSTK_ERROR_UNSUPPORTED, "snapshot");
    /* The live one moves on; the snapshot, and one of it, stay. */
    const cstk_environment_change move = change_of(CSTK_CHANGE_MOVE, f->box, NULL, 5, 0);
    CHECK_OK(cstk_environment_apply(f->environment, &move, 1, NULL, NULL));
    cstk_environment *again = NULL;
    CHECK_OK(cstk_environment_snapshot(frozen, &again));
    check_state(again, 1, 1);
    check_at(again, f->box, 3);
    check_at(f->environment, f->box, 5);
    CHECK(distance_to(f, frozen) == f->distance.distance);
    CHECK(distance_to(f, again) == f->distance.distance);
    CHECK(distance_to(f, f->environment) > f->distance.distance);
    const cstk_environment_change back = change_of(CSTK_CHANGE_MOVE, f->box, NULL, 3, 0.5);
    CHECK_OK(cstk_environment_apply(f->environment, &back, 1, NULL, NULL));
    CHECK(distance_to(f, f->environment) == f->distance.distance);
    CHECK_OK(cstk_environment_release(frozen));
    CHECK_OK(cstk_environment_release(again));
}

static void check_empty(const fixture *f, const cstk_cobject *cobject) {
    cstk_distance_result d;
    cstk_class class_of = CSTK_CLASS_INSIDE;
    bool within = true;
    cstk_witness_list list;
    CHECK_OK(cstk_distance(f->query, cobject, f->q, FIXTURE_NQ, INFINITY, &d));
    CHECK(d.kind == CSTK_DISTANCE_EMPTY && !d.has_witness && !d.has_contact);
    CHECK(isinf(d.distance) && isinf(d.lower) && isinf(d.upper));
    CHECK_OK(cstk_classify(f->query, cobject, f->q, FIXTURE_NQ, &class_of));
    CHECK(class_of == CSTK_CLASS_OUTSIDE);
    CHECK_OK(cstk_within(f->query, cobject, f->q, FIXTURE_NQ, 1e9, &within));
    CHECK(!within);
    CHECK_OK(cstk_witnesses(f->query, cobject, f->q, FIXTURE_NQ, INFINITY, 10, &list));
    CHECK(list.witness_count == 0 && list.contact_count == 0 && !list.truncated);
}

/* A C-object of all objects follows additions; one of named objects does not, and both follow
 * deletions. */
static void deleted_objects(void) {
    fixture f;
    cstk_cobject *named = NULL;
    cstk_class class_of = CSTK_CLASS_INSIDE;
    fixture_create(&f);
    CHECK_OK(cstk_cobject_induced(f.space, NULL, 0, f.environment, &f.box, 1, NULL, &named));
    const uint64_t inside = add_object(f.environment, f.body, 0, 0, 0);
    CHECK_OK(cstk_classify(f.query, f.cobject, f.q, FIXTURE_NQ, &class_of));
    CHECK(class_of == CSTK_CLASS_INSIDE);
    CHECK_OK(cstk_classify(f.query, named, f.q, FIXTURE_NQ, &class_of));
    CHECK(class_of == CSTK_CLASS_OUTSIDE);
    const cstk_environment_change gone = change_of(CSTK_CHANGE_DELETE, f.box, NULL, 0, 0);
    CHECK_OK(cstk_environment_apply(f.environment, &gone, 1, NULL, NULL));
    check_empty(&f, named);
    CHECK_OK(cstk_classify(f.query, f.cobject, f.q, FIXTURE_NQ, &class_of));
    CHECK(class_of == CSTK_CLASS_INSIDE);
    const cstk_environment_change last = change_of(CSTK_CHANGE_DELETE, inside, NULL, 0, 0);
    CHECK_OK(cstk_environment_apply(f.environment, &last, 1, NULL, NULL));
    check_empty(&f, f.cobject);
    CHECK_OK(cstk_cobject_release(named));
    fixture_release(&f);
}

static cstk_body *make_square(void) {
    const double square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    CHECK_OK(cstk_body_builder_create(2, &builder));
    CHECK_OK(cstk_body_builder_add_polygon(builder, square, 4, 0));
    CHECK_OK(cstk_body_build(builder, NULL, NULL, NULL, &body));
    CHECK_OK(cstk_body_builder_release(builder));
    return body;
}

/* Planar and spatial bodies do not mix, neither here nor with a robot that came first. */
static void dimensions(const fixture *f) {
    cstk_environment *e = NULL;
    cstk_cobject *cobject = NULL;
    cstk_distance_result d;
    cstk_body *square = make_square();
    CHECK_OK(cstk_environment_create(&e));
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, e, NULL, 0, NULL, &cobject));
    check_empty(f, cobject);
    const uint64_t id = add_object(e, square, 1, 2, 0);
    CHECK_REFUSED(d, cstk_distance(f->query, cobject, f->q, FIXTURE_NQ, INFINITY, &d),
                  CSTK_ERROR_INVALID_ARGUMENT, "dimension");
    cstk_environment_change change = change_of(CSTK_CHANGE_ADD, 0, f->body, 0, 0);
    CHECK_FAILS(cstk_environment_apply(e, &change, 1, NULL, NULL), CSTK_ERROR_INVALID_ARGUMENT, "planar");
    change = change_of(CSTK_CHANGE_MOVE, id, NULL, 0, 0);
    change.pose[11] = 1e-9;
    CHECK_FAILS(cstk_environment_apply(e, &change, 1, NULL, NULL), CSTK_ERROR_INVALID_ARGUMENT, "plane");
    check_state(e, 1, 1);
    check_at(e, id, 1);
    CHECK_OK(cstk_cobject_release(cobject));
    CHECK_OK(cstk_environment_release(e));
    CHECK_OK(cstk_body_release(square));
}

typedef struct placed {
    double x, y, z;
} placed;

/* What the answer holds but for ids, which follow the order of insertion. */
static cstk_distance_result ask(const fixture *f, const placed boxes[4], const int order[4],
                                double q0) {
    cstk_environment *e = NULL;
    cstk_cobject *cobject = NULL;
    cstk_distance_result d;
    const double q[FIXTURE_NQ] = {q0, 0.3, -0.4};
    CHECK_OK(cstk_environment_create(&e));
    for (int i = 0; i < 4; ++i) {
        const placed *box = &boxes[order[i]];
        add_object(e, f->body, box->x, box->y, box->z);
    }
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, e, NULL, 0, NULL, &cobject));
    CHECK_OK(cstk_distance(f->query, cobject, q, FIXTURE_NQ, INFINITY, &d));
    CHECK_OK(cstk_cobject_release(cobject));
    CHECK_OK(cstk_environment_release(e));
    return d;
}

static void insertion_order(const fixture *f) {
    const placed boxes[4] = {{3.1, 1.2, 0.3}, {-2.9, 0.4, 0.1}, {0.3, 2.8, -0.2}, {0.1, -3.3, 0.7}};
    for (int step = 0; step < 8; ++step) {
        const double q0 = 0.7 * step;
        const int sorted[4] = {0, 1, 2, 3};
        const cstk_distance_result first = ask(f, boxes, sorted, q0);
        CHECK(first.kind == CSTK_DISTANCE_EXACT);
        for (int code = 0; code < 256; ++code) {
            const int o[4] = {code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 & 3};
            if ((1 << o[0] | 1 << o[1] | 1 << o[2] | 1 << o[3]) != 15) {
                continue; /* no permutation */
            }
            const cstk_distance_result d = ask(f, boxes, o, q0);
            CHECK(memcmp(&d.distance, &first.distance, sizeof d.distance) == 0);
            CHECK(memcmp(&d.lower, &first.lower, sizeof d.lower) == 0);
            CHECK(memcmp(&d.upper, &first.upper, sizeof d.upper) == 0);
            CHECK(memcmp(d.r_point, first.r_point, sizeof d.r_point) == 0);
            CHECK(memcmp(d.s_point, first.s_point, sizeof d.s_point) == 0);
        }
    }
}

int main(void) {
    fixture f;
    fixture_create(&f);
    changes(f.body);
    failed_apply(f.body);
    ids_are_new(f.body);
    insertion_order(&f);
    dimensions(&f);
    snapshots(&f);
    fixture_release(&f);
    deleted_objects();
    return check_result();
}
