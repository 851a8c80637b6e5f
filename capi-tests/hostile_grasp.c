/* Hostile input to grasps, to pairs that may meet, and to the choice of link pairs; and what they
 * do when all is well. */
#include <math.h>
#include <stddef.h>

#include "check.h"
#include "fixture.h"

typedef struct applied {
    uint64_t ids[1];
    uint64_t version;
} applied;

static void refuse(const fixture *f, const cstk_environment_change *change, cstk_status status,
                   const char *culprit) {
    applied out;
    CHECK_REFUSED(out, cstk_environment_apply(f->environment, change, 1, out.ids, &out.version),
                  status, culprit);
}

static void attach_refusals(const fixture *f) {
    const uint32_t touch[] = {1, 2};
    const uint32_t nowhere[] = {1, FIXTURE_LINKS};
    cstk_environment_change good;
    CHECK_OK(cstk_environment_change_default(&good, sizeof good));
    good.kind = CSTK_CHANGE_ATTACH;
    good.id = f->box;
    good.space = f->space;
    good.link = FIXTURE_TIP;
    good.touch_links = touch;
    good.touch_count = 2;
    cstk_environment_change change = good;
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        change.space = bad->handle;
        refuse(f, &change, bad->status, "changes[0].space");
    }
    change = good;
    change.id = f->box + 1000000;
    refuse(f, &change, CSTK_ERROR_NOT_FOUND, "s-object");
    change = good;
    change.link = FIXTURE_LINKS;
    refuse(f, &change, CSTK_ERROR_NOT_FOUND, "link 4");
    change = good;
    change.touch_links = nowhere;
    refuse(f, &change, CSTK_ERROR_NOT_FOUND, "touch link 4");
    change.touch_links = NULL;
    refuse(f, &change, CSTK_ERROR_NULL_ARGUMENT, "changes[0].touch_links");
    change = good;
    change.pose[3] = NAN;
    refuse(f, &change, CSTK_ERROR_NOT_FINITE, "changes[0].pose");
    change = good;
    change.pose[0] = 2;
    refuse(f, &change, CSTK_ERROR_NOT_A_ROTATION, "changes[0].pose");
    fixture_unchanged(f);
}

/* What comes attached is refused as what is attached later, and its name with it. */
static void add_attached(const fixture *f) {
    const uint32_t nowhere[] = {FIXTURE_LINKS};
    cstk_environment_change change;
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.body = f->body;
    change.name = "\xff";
    refuse(f, &change, CSTK_ERROR_INVALID_ARGUMENT, "changes[0].name");
    change.name = "cup";
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        if (bad->handle != NULL) {
            change.space = bad->handle;
            refuse(f, &change, bad->status, "changes[0].space");
        }
    }
    change.space = f->space;
    change.link = FIXTURE_LINKS;
    refuse(f, &change, CSTK_ERROR_NOT_FOUND, "link 4");
    change.link = FIXTURE_TIP;
    change.touch_links = nowhere;
    change.touch_count = 1;
    refuse(f, &change, CSTK_ERROR_NOT_FOUND, "touch link 4");
    change.touch_count = 0;
    fixture_unchanged(f);
    cstk_environment *world = NULL;
    cstk_object_info info;
    char name[8];
    size_t length = 0;
    uint64_t ids[2];
    uint64_t found = 0;
    CHECK_OK(cstk_environment_create(&world));
    CHECK_OK(cstk_environment_apply(world, &change, 1, &ids[0], NULL));
    CHECK_OK(cstk_environment_apply(world, &change, 1, &ids[1], NULL));
    CHECK_OK(cstk_environment_get_object_info(world, ids[0], &info));
    CHECK(info.link == FIXTURE_TIP && info.touch_count == 0);
    CHECK_OK(cstk_environment_get_object_name(world, ids[1], name, sizeof name, &length));
    CHECK(strcmp(name, "cup") == 0 && length == 3);
    CHECK_OK(cstk_environment_find_object(world, "cup", &found));
    CHECK(found == ids[0]);
    /* A change as programs of before this name gave it: shorter, and without one. */
    change.size = offsetof(cstk_environment_change, name);
    CHECK_OK(cstk_environment_apply(world, &change, 1, &ids[0], NULL));
    CHECK_OK(cstk_environment_get_object_name(world, ids[0], NULL, 0, &length));
    CHECK(length == 0);
    CHECK_OK(cstk_environment_release(world));
}

static void object_names(const fixture *f) {
    char name[4];
    uint64_t id;
    EACH_BAD_HANDLE(f, NOUN_ENVIRONMENT, bad) {
        CHECK_REFUSED(name, cstk_environment_get_object_name(bad->handle, f->box, name, 4, NULL), bad->status,
                      "environment");
        CHECK_REFUSED(id, cstk_environment_find_object(bad->handle, "cup", &id), bad->status, "environment");
    }
    CHECK_REFUSED(name, cstk_environment_get_object_name(f->environment, 0, name, 4, NULL), CSTK_ERROR_NOT_FOUND,
                  "id 0");
    CHECK_FAILS(cstk_environment_get_object_name(f->environment, f->box, NULL, 4, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "buffer");
    CHECK_REFUSED(id, cstk_environment_find_object(f->environment, NULL, &id), CSTK_ERROR_NULL_ARGUMENT, "name");
    CHECK_REFUSED(id, cstk_environment_find_object(f->environment, "\xff", &id), CSTK_ERROR_INVALID_ARGUMENT, "name");
    CHECK_REFUSED(id, cstk_environment_find_object(f->environment, "cup", &id), CSTK_ERROR_NOT_FOUND, "cup");
    /* Those without a name have none to be found by. */
    CHECK_REFUSED(id, cstk_environment_find_object(f->environment, "", &id), CSTK_ERROR_NOT_FOUND, "name");
    CHECK_FAILS(cstk_environment_find_object(f->environment, "cup", NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    fixture_unchanged(f);
}

/* An object in the hand of a robot of another space is refused by those that meet it, and answers
 * again when let go. */
static void attach_elsewhere(const fixture *f) {
    cstk_space *other = NULL;
    cstk_environment *world = NULL;
    cstk_cobject *set = NULL;
    cstk_class where;
    cstk_environment_change change;
    CHECK_OK(cstk_space_create((const cstk_robot *const *)&f->robot, 1, NULL, 0, NULL, &other));
    CHECK_OK(cstk_environment_create(&world));
    CHECK_OK(cstk_environment_change_default(&change, sizeof change));
    change.body = f->body;
    CHECK_OK(cstk_environment_apply(world, &change, 1, &change.id, NULL));
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, world, NULL, 0, NULL, &set));
    change.kind = CSTK_CHANGE_ATTACH;
    change.space = other;
    CHECK_OK(cstk_environment_apply(world, &change, 1, NULL, NULL));
    CHECK_FAILS(cstk_classify(f->query, set, f->q, FIXTURE_NQ, &where), CSTK_ERROR_UNSUPPORTED,
                "another space");
    change.kind = CSTK_CHANGE_MOVE;
    CHECK_OK(cstk_environment_apply(world, &change, 1, NULL, NULL));
    CHECK_OK(cstk_classify(f->query, set, f->q, FIXTURE_NQ, &where));
    CHECK_OK(cstk_cobject_release(set));
    CHECK_OK(cstk_environment_release(world));
    CHECK_OK(cstk_space_release(other));
}

static int destroyed;

static void count_destroyed(void *data) {
    CHECK(data == &destroyed);
    ++destroyed;
}

/* Held by the tip, the box is on the r-side against another one, and an s-object to the links. */
static void grasp_and_release(const fixture *f) {
    cstk_environment *world = NULL;
    cstk_cobject *set = NULL;
    cstk_environment_change changes[3] = {0};
    uint64_t ids[2];
    destroyed = 0;
    CHECK_OK(cstk_environment_create(&world));
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_environment_change_default(&changes[i], sizeof changes[i]));
        changes[i].body = f->body;
        changes[i].pose[3] = 50.0 * (i + 1);
        changes[i].data = &destroyed;
        changes[i].destroy = count_destroyed;
    }
    changes[1].pose[0] = 7;
    CHECK_FAILS(cstk_environment_apply(world, changes, 2, ids, NULL), CSTK_ERROR_NOT_A_ROTATION,
                "changes[1].pose");
    CHECK(destroyed == 0);
    changes[1].pose[0] = 1;
    changes[1].size += 8;
    CHECK_FAILS(cstk_environment_apply(world, changes, 2, ids, NULL), CSTK_ERROR_WRONG_SIZE,
                "changes[1].size");
    CHECK(destroyed == 0);
    changes[1].size -= 8;
    CHECK_OK(cstk_environment_apply(world, changes, 2, ids, NULL));
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, world, NULL, 0, NULL, &set));
    cstk_distance_result free_distance;
    cstk_distance_result held_distance;
    CHECK_OK(cstk_distance(f->query, set, f->q, FIXTURE_NQ, INFINITY, &free_distance));
    CHECK(free_distance.witness.s_data == &destroyed && free_distance.witness.r_object == 0);
    CHECK(free_distance.witness.s_link == CSTK_NONE);

    cstk_environment_change hold;
    CHECK_OK(cstk_environment_change_default(&hold, sizeof hold));
    hold.kind = CSTK_CHANGE_ATTACH;
    hold.id = ids[0];
    hold.space = f->space;
    hold.link = FIXTURE_TIP;
    hold.pose[3] = 40.0;
    CHECK_OK(cstk_environment_apply(world, &hold, 1, NULL, NULL));
    double pose[12];
    CHECK_OK(cstk_environment_get_object_pose(world, ids[0], pose));
    CHECK(pose[3] == 40.0);
    CHECK_OK(cstk_distance(f->query, set, f->q, FIXTURE_NQ, INFINITY, &held_distance));
    CHECK(held_distance.has_witness);
    cstk_witness_list list;
    CHECK_OK(cstk_witnesses(f->query, set, f->q, FIXTURE_NQ, INFINITY, 100000, &list));
    int by_hand = 0;
    for (size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness *w = &list.witnesses[i];
        CHECK(w->s_object != ids[0] || (w->s_link == FIXTURE_TIP && w->r_link != FIXTURE_TIP));
        by_hand += w->r_object == ids[0] && w->r_link == FIXTURE_TIP && w->s_object == ids[1];
    }
    CHECK(by_hand > 0);

    /* The two may meet: named in the options of another set. */
    cstk_allowed_pair pair = {FIXTURE_TIP, 0, ids[0], ids[1]};
    cstk_induced_options options;
    cstk_cobject *allowing = NULL;
    CHECK_OK(cstk_induced_options_default(&options, sizeof options));
    options.allowed = &pair;
    options.allowed_count = 1;
    CHECK_OK(cstk_cobject_induced(f->space, NULL, 0, world, NULL, 0, &options, &allowing));
    CHECK_OK(cstk_witnesses(f->query, allowing, f->q, FIXTURE_NQ, INFINITY, 100000, &list));
    for (size_t i = 0; i < list.witness_count; ++i) {
        CHECK(list.witnesses[i].r_object == 0);
    }
    CHECK_OK(cstk_cobject_release(allowing));

    hold.kind = CSTK_CHANGE_MOVE;
    hold.pose[3] = 50.0;
    CHECK_OK(cstk_environment_apply(world, &hold, 1, NULL, NULL));
    CHECK_OK(cstk_distance(f->query, set, f->q, FIXTURE_NQ, INFINITY, &held_distance));
    CHECK(held_distance.distance == free_distance.distance);
    CHECK(held_distance.environment_version == 3);

    for (int i = 0; i < 2; ++i) {
        changes[i].kind = CSTK_CHANGE_DELETE;
        changes[i].id = ids[i];
    }
    CHECK_OK(cstk_environment_apply(world, changes, 2, NULL, NULL));
    CHECK(destroyed == 2);
    CHECK_OK(cstk_cobject_release(set));
    CHECK_OK(cstk_environment_release(world));
    CHECK(destroyed == 2);
}

static void allowed_refusals(const fixture *f) {
    const uint32_t links[] = {1, 3};
    cstk_allowed_pair pair = {FIXTURE_LINKS, 0, 0, 1};
    cstk_cobject *out;
    cstk_induced_options options;
    CHECK_OK(cstk_induced_options_default(&options, sizeof options));
    options.allowed_count = 1;
    CHECK_REFUSED(out,
                  cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, &options, &out),
                  CSTK_ERROR_NULL_ARGUMENT, "allowed");
    options.allowed = &pair;
    CHECK_REFUSED(out,
                  cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, &options, &out),
                  CSTK_ERROR_NOT_FOUND, "allowed[0]");
    CHECK_REFUSED(out, cstk_cobject_induced_links(f->space, links, 1, &options, &out),
                  CSTK_ERROR_UNSUPPORTED, "allowed");
    options.allowed_count = SIZE_MAX / 2;
    CHECK_REFUSED(out,
                  cstk_cobject_induced(f->space, NULL, 0, f->environment, NULL, 0, &options, &out),
                  CSTK_ERROR_WRONG_SIZE, "allowed");
    fixture_unchanged(f);
}

static int stop(double fraction, void *user) {
    (void)fraction;
    (void)user;
    return 1;
}

static void refuse_pairs(const fixture *f, const cstk_link_pair_options *options,
                         cstk_status status, const char *culprit) {
    cstk_link_pair_list out;
    CHECK_REFUSED(out, cstk_find_link_pairs(f->query, f->space, options, NULL, NULL, &out), status,
                  culprit);
}

static void link_pairs(const fixture *f) {
    cstk_link_pair_list out;
    cstk_link_pair_options options;
    CHECK_FAILS(cstk_link_pair_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_link_pair_options_default(&options, 7), CSTK_ERROR_WRONG_SIZE, "size");
    CHECK_OK(cstk_link_pair_options_default(&options, sizeof options));
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out, cstk_find_link_pairs(bad->handle, f->space, NULL, NULL, NULL, &out),
                      bad->status, "query");
    }
    EACH_BAD_HANDLE(f, NOUN_SPACE, bad) {
        CHECK_REFUSED(out, cstk_find_link_pairs(f->query, bad->handle, NULL, NULL, NULL, &out),
                      bad->status, "space");
    }
    EACH_BAD_OPTIONS(options, bad) { refuse_pairs(f, bad->options, bad->status, "options"); }
    CHECK_FAILS(cstk_find_link_pairs(f->query, f->space, NULL, NULL, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT,
                "out");
    cstk_link_pair_options changed = options;
    changed.samples = 0;
    refuse_pairs(f, &changed, CSTK_ERROR_INVALID_ARGUMENT, "samples");
    changed.samples = UINT64_MAX;
    refuse_pairs(f, &changed, CSTK_ERROR_INVALID_ARGUMENT, "samples");
    changed = options;
    changed.margin = -1;
    refuse_pairs(f, &changed, CSTK_ERROR_INVALID_ARGUMENT, "margin");
    changed.margin = NAN;
    refuse_pairs(f, &changed, CSTK_ERROR_NOT_FINITE, "margin");
    changed = options;
    changed.always = 1.5;
    refuse_pairs(f, &changed, CSTK_ERROR_INVALID_ARGUMENT, "always");
    const double rest[FIXTURE_NQ] = {0, NAN, 0};
    changed = options;
    changed.rest = rest;
    refuse_pairs(f, &changed, CSTK_ERROR_NOT_FINITE, "rest");
    CHECK_REFUSED(out, cstk_find_link_pairs(f->query, f->space, NULL, stop, NULL, &out), CSTK_ERROR_CANCELLED,
                  "progress");

    /* Three links with bodies in a row: two joined pairs, and one of the first with the last. */
    CHECK_OK(cstk_find_link_pairs(f->query, f->space, NULL, NULL, NULL, &out));
    CHECK(out.count == 3);
    CHECK(out.pairs[0].r_link == 1 && out.pairs[0].s_link == 2);
    CHECK(out.pairs[0].verdict == CSTK_PAIR_ADJACENT && out.pairs[2].verdict == CSTK_PAIR_ADJACENT);
    CHECK(out.pairs[1].r_link == 1 && out.pairs[1].s_link == 3);
    CHECK(out.tested_count ==
          (out.pairs[1].verdict == CSTK_PAIR_TEST || out.pairs[1].verdict == CSTK_PAIR_NEVER));
    fixture_unchanged(f);
}

static void refuse_clear_pairs(const fixture *f, const cstk_cobject *cobject, const cstk_clear_pair_options *options,
                               cstk_status status, const char *culprit) {
    cstk_cobject *out = NULL;
    cstk_clear_pair_summary summary = {0}, untouched = {0};
    CHECK_REFUSED(out, cstk_prove_clear_pairs(f->query, cobject, options, NULL, NULL, &summary, &out), status, culprit);
    CHECK(memcmp(&summary, &untouched, sizeof summary) == 0);
}

static void clear_pairs(const fixture *f) {
    cstk_cobject *out, *pairs, *both;
    cstk_clear_pair_options options;
    CHECK_FAILS(cstk_clear_pair_options_default(NULL, sizeof options), CSTK_ERROR_NULL_ARGUMENT, "out");
    CHECK_FAILS(cstk_clear_pair_options_default(&options, 7), CSTK_ERROR_WRONG_SIZE, "size");
    CHECK_OK(cstk_clear_pair_options_default(&options, sizeof options));
    const uint32_t links[2] = {1, 3};
    CHECK_OK(cstk_cobject_induced_links(f->space, links, 1, NULL, &pairs));
    EACH_BAD_HANDLE(f, NOUN_QUERY, bad) {
        CHECK_REFUSED(out, cstk_prove_clear_pairs(bad->handle, pairs, NULL, NULL, NULL, NULL, &out), bad->status,
                      "query");
    }
    EACH_BAD_HANDLE(f, NOUN_COBJECT, bad) {
        CHECK_REFUSED(out, cstk_prove_clear_pairs(f->query, bad->handle, NULL, NULL, NULL, NULL, &out), bad->status,
                      "cobject");
    }
    EACH_BAD_OPTIONS(options, bad) { refuse_clear_pairs(f, pairs, bad->options, bad->status, "options"); }
    CHECK_FAILS(cstk_prove_clear_pairs(f->query, pairs, NULL, NULL, NULL, NULL, NULL), CSTK_ERROR_NULL_ARGUMENT, "out");
    cstk_clear_pair_options changed = options;
    changed.max_blocks = 0;
    refuse_clear_pairs(f, pairs, &changed, CSTK_ERROR_INVALID_ARGUMENT, "max_blocks");
    CHECK_REFUSED(out, cstk_prove_clear_pairs(f->query, pairs, NULL, stop, NULL, NULL, &out), CSTK_ERROR_CANCELLED,
                  "progress");
    /* Only a set of link pairs, alone. */
    refuse_clear_pairs(f, f->cobject, NULL, CSTK_ERROR_UNSUPPORTED, "pairs");
    const cstk_cobject *parts[2] = {f->cobject, pairs};
    CHECK_OK(cstk_cobject_union(parts, 2, &both));
    refuse_clear_pairs(f, both, NULL, CSTK_ERROR_UNSUPPORTED, "pairs");

    /* A copy answers as the set does, and has a number of its own. */
    cstk_clear_pair_summary summary;
    changed.max_blocks = 500;
    CHECK_OK(cstk_prove_clear_pairs(f->query, pairs, &changed, NULL, NULL, &summary, &out));
    CHECK(summary.pair_count == 1 && summary.proved_count <= 1);
    CHECK(summary.proved_share >= 0 && summary.proved_share <= 1 && (summary.proved_count == 0) == (summary.bytes == 0));
    uint64_t numbers[2];
    CHECK_OK(cstk_cobject_get_data(pairs, NULL, &numbers[0]));
    CHECK_OK(cstk_cobject_get_data(out, NULL, &numbers[1]));
    CHECK(numbers[0] != numbers[1]);
    for (int i = 0; i < 200; ++i) {
        double q[FIXTURE_NQ];
        for (int k = 0; k < FIXTURE_NQ; ++k) {
            q[k] = sin(1 + i * (k + 1.7)) * 3;
        }
        cstk_class expected, found;
        CHECK_OK(cstk_classify(f->query, pairs, q, FIXTURE_NQ, &expected));
        CHECK_OK(cstk_classify(f->query, out, q, FIXTURE_NQ, &found));
        CHECK(found == expected);
    }
    cstk_cobject_release(out);
    cstk_cobject_release(both);
    cstk_cobject_release(pairs);
    fixture_unchanged(f);
}

int main(void) {
    fixture f;
    fixture_create(&f);
    attach_refusals(&f);
    add_attached(&f);
    object_names(&f);
    attach_elsewhere(&f);
    grasp_and_release(&f);
    allowed_refusals(&f);
    link_pairs(&f);
    clear_pairs(&f);
    fixture_release(&f);
    return check_result();
}
