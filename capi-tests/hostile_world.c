/* Hostile input to floors, to data of bodies, to names of links in a space, and to versions that
 * queries saw; handles that are released by functions which the library calls. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static void refuse_floor(const cstk_space *space, const uint32_t *links, size_t count,
                         const double *normal, double offset, const cstk_pure_options *options,
                         cstk_status status, const char *culprit) {
    cstk_cobject *out;
    CHECK_REFUSED(out, cstk_cobject_below_floor(space, links, count, normal, offset, options, &out),
                  status, culprit);
}

static void floors(const fixture *f) {
    const double up[3] = {0, 0, 2};
    const double none[3] = {0, 0, 0};
    const double huge[3] = {0, 1e300, 0};
    const uint32_t links[2] = {1, FIXTURE_LINKS};
    cstk_pure_options options;
    CHECK_OK(cstk_pure_options_default(&options, sizeof options));
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        refuse_floor(bad->handle, NULL, 0, up, 0, NULL, bad->status, "space");
    }
    EACH_BAD_OPTIONS(options, bad) {
        refuse_floor(f->space, NULL, 0, up, 0, bad->options, bad->status, "options");
    }
    refuse_floor(f->space, NULL, 1, up, 0, NULL, CSTK_ERROR_NULL_ARGUMENT, "links");
    refuse_floor(f->space, links, 2, up, 0, NULL, CSTK_ERROR_NOT_FOUND, "link 4");
    refuse_floor(f->space, links, SIZE_MAX, up, 0, NULL, CSTK_ERROR_WRONG_SIZE, "links");
    refuse_floor(f->space, NULL, 0, NULL, 0, NULL, CSTK_ERROR_NULL_ARGUMENT, "normal");
    refuse_floor(f->space, NULL, 0, none, 0, NULL, CSTK_ERROR_DEGENERATE, "normal");
    refuse_floor(f->space, NULL, 0, huge, 0, NULL, CSTK_ERROR_INVALID_ARGUMENT, "normal");
    EACH_NOT_FINITE(i) {
        double bad[3] = {0, 0, 1};
        bad[i] = not_finite[i];
        refuse_floor(f->space, NULL, 0, bad, 0, NULL, CSTK_ERROR_NOT_FINITE, "normal");
        refuse_floor(f->space, NULL, 0, up, not_finite[i], NULL, CSTK_ERROR_NOT_FINITE, "offset");
    }
    CHECK_FAILS(cstk_cobject_below_floor(f->space, NULL, 0, up, 0, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "out");

    cstk_cobject *ground = NULL;
    cstk_distance_result found;
    CHECK_OK(cstk_cobject_below_floor(f->space, NULL, 0, up, -20, NULL, &ground));
    CHECK_OK(cstk_distance(f->query, ground, f->q, FIXTURE_NQ, INFINITY, &found));
    CHECK(found.distance > 8 && found.distance < 10 && found.has_contact);
    CHECK(found.witness.r_link != CSTK_NONE && found.witness.coordinate == CSTK_NONE);
    CHECK(found.contact.mode == CSTK_MODE_PURE_SET && found.s_point[2] == -10);
    CHECK_OK(cstk_cobject_release(ground));
    fixture_unchanged(f);
}

static int destroyed;

static void count(void *user) { destroyed += *(int *)user; }

static void body_data(const fixture *f) {
    int one = 1;
    void *out;
    EACH_BAD_HANDLE(f, NOUN_BODY, bad) {
        CHECK_FAILS(cstk_body_set_data(bad->handle, &one, count), bad->status, "body");
        CHECK_REFUSED(out, cstk_body_get_data(bad->handle, &out), bad->status, "body");
    }
    CHECK_FAILS(cstk_body_get_data(f->body, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_OK(cstk_body_get_data(f->body, &out));
    CHECK(out == NULL);
    CHECK(destroyed == 0);

    cstk_body *body = make_box(1, 1, 1);
    cstk_environment *world = NULL;
    cstk_cobject *set = NULL;
    cstk_distance_result found;
    CHECK_OK(cstk_body_set_data(body, NULL, NULL));
    CHECK_OK(cstk_body_set_data(body, &one, count));
    int other = 100;
    CHECK_FAILS(cstk_body_set_data(body, &other, count), CSTK_ERROR_INVALID_ARGUMENT, "data already");
    CHECK_OK(cstk_body_get_data(body, &out));
    CHECK(out == &one);
    CHECK_OK(cstk_environment_create(&world));
    add_object(world, body, 0, 0, 9);
    CHECK_OK(cstk_body_release(body));
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, world, NULL, 0, NULL, &set));
    CHECK_OK(cstk_distance(f->query, set, f->q, FIXTURE_NQ, INFINITY, &found));
    CHECK(found.witness.s_data == &one && found.witness.r_data == NULL);
    CHECK_OK(cstk_cobject_release(set));
    CHECK(destroyed == 0);
    CHECK_OK(cstk_environment_release(world));
    CHECK(destroyed == 1);
    fixture_unchanged(f);
}

static void link_names(const fixture *f) {
    char name[64];
    char same[64];
    size_t length;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(length, cstk_space_get_link_name(bad->handle, 0, NULL, 0, &length), bad->status,
                      "space");
    }
    CHECK_REFUSED(length, cstk_space_get_link_name(f->space, FIXTURE_LINKS, NULL, 0, &length),
                  CSTK_ERROR_NOT_FOUND, "link 4");
    CHECK_REFUSED(length, cstk_space_get_link_name(f->space, 0, NULL, 9, &length), CSTK_ERROR_NULL_ARGUMENT,
                  "buffer");
    uint32_t link_found;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(link_found, cstk_space_find_link(bad->handle, "link0", &link_found), bad->status, "space");
    }
    CHECK_REFUSED(link_found, cstk_space_find_link(f->space, NULL, &link_found), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_REFUSED(link_found, cstk_space_find_link(f->space, "\xff", &link_found), CSTK_ERROR_INVALID_ARGUMENT, "name");
    CHECK_REFUSED(link_found, cstk_space_find_link(f->space, "elbow", &link_found), CSTK_ERROR_NOT_FOUND, "elbow");
    CHECK_FAILS(cstk_space_find_link(f->space, "link0", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    const cstk_robot *twins[2] = {f->robot, f->robot};
    cstk_space *both = NULL;
    CHECK_OK(cstk_space_create(twins, 2, NULL, 0, NULL, &both));
    CHECK_REFUSED(link_found, cstk_space_find_link(both, "link1", &link_found), CSTK_ERROR_INVALID_ARGUMENT,
                  "links 1 and 5");
    CHECK_OK(cstk_space_release(both));
    for (uint32_t link = 0; link < FIXTURE_LINKS; ++link) {
        uint32_t found = CSTK_NONE;
        CHECK_OK(cstk_space_get_link_name(f->space, link, name, sizeof name, NULL));
        CHECK_OK(cstk_space_find_link(f->space, name, &found));
        CHECK(found == link);
        CHECK_OK(cstk_robot_get_link_name(f->robot, link, same, sizeof same, NULL));
        CHECK(strcmp(name, same) == 0);
    }
    fixture_unchanged(f);
}

static void objects(const fixture *f) {
    uint64_t ids[2] = {7, 7};
    size_t count = 0;
    cstk_object_info info;
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(count, cstk_environment_get_objects(bad->handle, 0, NULL, &count), bad->status,
                      "environment");
        CHECK_REFUSED(info, cstk_environment_get_object_info(bad->handle, f->box, &info), bad->status,
                      "environment");
    }
    const cstk_environment *e = f->environment;
    CHECK_REFUSED(count, cstk_environment_get_objects(e, 1, NULL, &count), CSTK_ERROR_NULL_ARGUMENT, "ids");
    CHECK_FAILS(cstk_environment_get_objects(e, 2, ids, NULL), CSTK_ERROR_NULL_ARGUMENT, "count");
    CHECK_FAILS(cstk_environment_get_object_info(e, f->box, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_REFUSED(info, cstk_environment_get_object_info(e, f->box + 1000, &info), CSTK_ERROR_NOT_FOUND,
                  "id");
    CHECK_OK(cstk_environment_get_objects(e, 0, NULL, &count));
    CHECK(count == 1);
    CHECK_OK(cstk_environment_get_objects(e, 2, ids, &count));
    CHECK(count == 1 && ids[0] == f->box && ids[1] == 7);
    CHECK_OK(cstk_environment_get_objects(e, SIZE_MAX, ids, &count));
    CHECK(count == 1 && ids[1] == 7);
    CHECK_OK(cstk_environment_get_object_info(e, f->box, &info));
    CHECK(info.id == f->box && info.link == CSTK_NONE && info.touch_count == 0 && !info.data);
    fixture_unchanged(f);
}

static void versions(const fixture *f) {
    uint64_t out;
    cstk_query *fresh = NULL;
    cstk_class where;
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out, cstk_query_get_version(bad->handle, f->environment, &out), bad->status,
                      "query");
    }
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(out, cstk_query_get_version(f->query, bad->handle, &out), bad->status,
                      "environment");
    }
    CHECK_FAILS(cstk_query_get_version(f->query, f->environment, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_OK(cstk_query_create(&fresh));
    CHECK_REFUSED(out, cstk_query_get_version(fresh, f->environment, &out), CSTK_ERROR_NOT_FOUND,
                  "environment");
    CHECK_OK(cstk_classify(fresh, f->cobject, f->q, FIXTURE_NQ, &where));
    CHECK_OK(cstk_query_get_version(fresh, f->environment, &out));
    CHECK(out == f->distance.environment_version);
    CHECK_OK(cstk_query_release(fresh));
    fixture_unchanged(f);
}

/* Sets a world's object down in another world's place: what the last state keeps may do anything. */
typedef struct undertaker {
    cstk_environment *environment;
    const cstk_body *body;
    int calls;
} undertaker;

static void bury(void *user) {
    undertaker *u = user;
    ++u->calls;
    add_object(u->environment, u->body, 0, 0, 30);
    CHECK_OK(cstk_environment_release(u->environment));
}

static void destroy_changes_the_world(const fixture *f) {
    undertaker u = {NULL, f->body, 0};
    CHECK_OK(cstk_environment_create(&u.environment));
    CHECK_OK(cstk_environment_retain(u.environment));
    cstk_environment_change change;
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.body = f->body;
    change.data = &u;
    change.destroy = bury;
    CHECK_OK(cstk_environment_apply(u.environment, &change, 1, &change.id, NULL));
    change.kind = CSTK_CHANGE_DELETE;
    change.data = NULL;
    change.destroy = NULL;
    CHECK_OK(cstk_environment_apply(u.environment, &change, 1, NULL, NULL));
    CHECK(u.calls == 1);
    size_t objects = 0;
    CHECK_OK(cstk_environment_get_state(u.environment, &objects, NULL));
    CHECK(objects == 1);
    CHECK_OK(cstk_environment_release(u.environment));
    fixture_unchanged(f);
}

static int32_t let_go(double fraction, void *user) {
    cstk_space **space = user;
    (void)fraction;
    if (*space) {
        CHECK_OK(cstk_space_release(*space));
        *space = NULL;
    }
    return 0;
}

static void progress_releases_the_space(const fixture *f) {
    cstk_space *space = NULL;
    cstk_link_pair_list out;
    CHECK_OK(cstk_space_create((const cstk_robot *const *)&f->robot, 1, NULL, 0, NULL, &space));
    CHECK_OK(cstk_find_link_pairs(f->query, space, NULL, let_go, &space, &out));
    CHECK(space == NULL && out.count == 3 && out.pairs[0].s_robot == 0);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    floors(&f);
    body_data(&f);
    link_names(&f);
    objects(&f);
    versions(&f);
    destroy_changes_the_world(&f);
    progress_releases_the_space(&f);
    fixture_release(&f);
    return check_result();
}
