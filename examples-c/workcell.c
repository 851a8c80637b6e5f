/* Two robots in one workcell: which configurations are free, and what is in the way of the others.
 *
 * Two arms of six joints face each other over a table. The C-object is a union of five sets with
 * names: each arm against itself, arm against arm, what is beyond a joint limit, and the arms
 * against the cell. At run time a bin is added to the cell, moved and deleted. Usage:
 *
 *   workcell FOLDER
 *
 * Pictures (workcell_free.glb, workcell_wrists.glb) go to the folder. Here is the use of the
 * library; workcell_scene.c has the arms, the table and the fixture, and workcell_report.c puts
 * answers in words. Build:
 *
 *   cc -std=c99 workcell.c workcell_scene.c workcell_report.c \
 *      $(pkg-config --cflags --libs cstk) -lm -o workcell
 */
#include "workcell_scene.h"
#include "workcell_report.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double margin = 0.01;          /* nearer than this is a collision */
static const double contact_epsilon = 0.02; /* and up to so much more, contact */
static const double radian = 0.5;           /* the length that a radian beyond a limit stands for */

/* The C-object is the union of these sets; their names are their data. */
enum { LEFT_ITSELF, RIGHT_ITSELF, ARM_BY_ARM, LIMITS, CELL, SETS };
static char names[SETS][32] = {"left arm against itself", "right arm against itself",
                               "arm against arm", "beyond a joint limit", "the cell"};

/* Coordinates of one arm. */
#define HOME 0, 0, .7, 0, .87, 0
#define FOLDED 0, 1.57, .95, 0, -1.9, 0
#define NEAR_MIDDLE 0, .37, .13, 0, 1.07, 0
#define IN_MIDDLE 0, .41, .09, 0, 1.07, 0
#define TURNED_TOO_FAR 0, 0, .7, 0, .87, 3.2
#define AT_FIXTURE 0, .9, .24, 0, .43, 0
#define AT_TABLE -.6, .9, .24, 0, .43, 0

typedef struct configuration {
    const char *what;
    double q[NQ]; /* left arm, right arm */
    expectation expected;
    const char *picture; /* or NULL */
} configuration;

static const configuration configurations[] = {
    {"both at home", {HOME, HOME}, {CSTK_CLASS_OUTSIDE, {NULL}}, "workcell_free.glb"},
    {"left elbow folded", {FOLDED, HOME}, {CSTK_CLASS_INSIDE, {names[LEFT_ITSELF]}}, NULL},
    {"wrists near", {NEAR_MIDDLE, NEAR_MIDDLE}, {CSTK_CLASS_CONTACT, {names[ARM_BY_ARM]}}, NULL},
    {"wrists meeting",
     {IN_MIDDLE, IN_MIDDLE},
     {CSTK_CLASS_INSIDE, {names[ARM_BY_ARM]}},
     "workcell_wrists.glb"},
    {"left hand turned", {TURNED_TOO_FAR, HOME}, {CSTK_CLASS_INSIDE, {names[LIMITS]}}, NULL},
    {"two reasons",
     {TURNED_TOO_FAR, AT_FIXTURE},
     {CSTK_CLASS_INSIDE, {names[LIMITS], names[CELL]}},
     NULL},
};

/* The same set with a name; releases the one without. */
static cstk_cobject *named(cstk_cobject *set, char *name) {
    cstk_cobject *out = NULL;
    check(cstk_cobject_with_data(set, name, NULL, &out));
    check(cstk_cobject_release(set));
    return out;
}

/* Links against links. Left out are pairs that always touch, such as joined ones, and those that no
 * sample brought together. That is no proof that they stay apart: without skip_never they are kept.
 */
static void make_link_sets(const cell *c, cstk_query *query, const cstk_induced_options *options,
                           cstk_cobject *sets[SETS]) {
    cstk_link_pair_options choice;
    check(cstk_link_pair_options_default(&choice, sizeof choice));
    choice.rest = configurations[0].q; /* at home */
    choice.margin = margin;
    choice.skip_never = 1;
    cstk_link_pair_list list;
    check(cstk_find_link_pairs(query, c->space, &choice, NULL, NULL, &list));

    uint32_t pairs[SETS][LINKS * LINKS][2];
    size_t counts[SETS] = {0};
    for (size_t i = 0; i < list.tested_count; ++i) {
        const uint32_t *pair = &list.tested[2 * i];
        int r = arm_of(c, pair[0]), s = arm_of(c, pair[1]);
        int set = r != s ? ARM_BY_ARM : r == LEFT ? LEFT_ITSELF : RIGHT_ITSELF;
        memcpy(pairs[set][counts[set]++], pair, sizeof pairs[set][0]);
    }
    printf("%zu of %zu pairs of links are tested: %zu and %zu within an arm, %zu between them\n",
           list.tested_count, list.count, counts[LEFT_ITSELF], counts[RIGHT_ITSELF],
           counts[ARM_BY_ARM]);
    for (int set = LEFT_ITSELF; set <= ARM_BY_ARM; ++set) {
        cstk_cobject *made = NULL;
        check(cstk_cobject_induced_links(c->space, pairs[set][0], counts[set], options, &made));
        sets[set] = named(made, names[set]);
    }
}

/* Links against what is in the cell, now or later; but for the bases, which stand on the table. */
static cstk_cobject *make_cell_set(const cell *c, const cstk_induced_options *options) {
    uint32_t links[ARMS * LINKS];
    size_t count = 0;
    for (int arm = 0; arm < ARMS; ++arm) {
        for (uint32_t link = BASE + 1; link < LINKS; ++link) {
            links[count++] = c->first[arm].link + link;
        }
    }
    cstk_cobject *made = NULL;
    check(cstk_cobject_induced(c->space, links, count, c->environment, NULL, 0, options, &made));
    return named(made, names[CELL]);
}

/* Without a scale, radians could not be compared with lengths, and distances would be refused. */
static cstk_cobject *make_limit_set(const cell *c) {
    cstk_pure_options options;
    check(cstk_pure_options_default(&options, sizeof options));
    options.scale = radian;
    cstk_cobject *made = NULL;
    check(cstk_cobject_beyond_limits(c->space, &options, &made));
    return named(made, names[LIMITS]);
}

static cstk_cobject *make_union(const cell *c, cstk_query *query) {
    cstk_induced_options options;
    check(cstk_induced_options_default(&options, sizeof options));
    options.margin = margin;
    options.contact_epsilon = contact_epsilon;
    cstk_cobject *sets[SETS], *all = NULL;
    make_link_sets(c, query, &options, sets);
    sets[LIMITS] = make_limit_set(c);
    sets[CELL] = make_cell_set(c, &options);
    check(cstk_cobject_union((const cstk_cobject *const *)sets, SETS, &all));
    for (int i = 0; i < SETS; ++i) {
        check(cstk_cobject_release(sets[i])); /* the union keeps it */
    }
    return all;
}

static void save_picture(const cstk_cobject *set, const double q[NQ], const char *folder,
                         const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    check(cstk_show(set, q, NQ, path));
}

/* Adds, moves or deletes the bin; returns the environment's new version. */
static uint64_t change_bin(cell *c, int32_t kind, double x) {
    cstk_environment_change change;
    check(cstk_environment_change_default(&change, sizeof change));
    cstk_body *body = kind == CSTK_CHANGE_ADD ? make_bin() : NULL;
    change.kind = kind;
    change.id = c->ids[BIN];
    change.body = body;
    change.pose[3] = x;
    change.pose[7] = -.3;
    uint64_t version = 0;
    check(cstk_environment_apply(c->environment, &change, 1, &c->ids[BIN], &version));
    check(cstk_body_release(body));
    return version;
}

/* A bin is put down where the left hand is, and drawn away until the hand is free again. The set
 * follows: the environment is changed, and the C-object need not be made anew. */
static bool run_bin(cell *c, cstk_query *query, const cstk_cobject *set) {
    const double q[NQ] = {AT_TABLE, HOME};
    const expectation outside = {CSTK_CLASS_OUTSIDE, {NULL}}, inside = {CSTK_CLASS_INSIDE, {names[CELL]}};
    cstk_distance_result before, after;
    bool good = report(c, query, set, "left hand low", q, &outside);
    check(cstk_distance(query, set, q, NQ, INFINITY, &before));

    int seen[3] = {0}; /* how often each class was */
    cstk_class where = CSTK_CLASS_INSIDE;
    for (int i = 0; i < 20 && where != CSTK_CLASS_OUTSIDE; ++i) {
        double x = -.28 - .02 * i;
        uint64_t version = change_bin(c, i == 0 ? CSTK_CHANGE_ADD : CSTK_CHANGE_MOVE, x);
        if (i == 0) {
            good = report(c, query, set, "bin in the way", q, &inside) && good;
        }
        cstk_class last = where;
        check(cstk_classify(query, set, q, NQ, &where));
        printf("    version %u, bin at x = %.2f: %s\n", (unsigned)version, x, class_name(where));
        good = good && where <= last; /* it goes away, and so the class never rises */
        ++seen[where];
    }
    good = good && seen[CSTK_CLASS_INSIDE] > 0 && seen[CSTK_CLASS_CONTACT] > 0 && seen[CSTK_CLASS_OUTSIDE] > 0;

    uint64_t version = change_bin(c, CSTK_CHANGE_DELETE, 0);
    good = report(c, query, set, "bin deleted", q, &outside) && good;
    check(cstk_distance(query, set, q, NQ, INFINITY, &after));
    return good && after.distance == before.distance && after.environment_version == version;
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: workcell FOLDER\n");
        return 2;
    }
    cell c = make_cell();
    cstk_query *query = NULL;
    check(cstk_query_create(&query));
    cstk_cobject *set = make_union(&c, query);
    printf("margin %g, contact up to %g from it\n\n", margin, contact_epsilon);

    bool good = true;
    for (size_t i = 0; i < sizeof configurations / sizeof configurations[0]; ++i) {
        const configuration *at = &configurations[i];
        good = report(&c, query, set, at->what, at->q, &at->expected) && good;
        if (at->picture != NULL) {
            save_picture(set, at->q, argv[1], at->picture);
        }
    }
    good = run_bin(&c, query, set) && good;
    printf("\n%s\n", good ? "all is as expected" : "SOMETHING IS NOT AS EXPECTED");

    check(cstk_cobject_release(set));
    check(cstk_query_release(query));
    release_cell(&c);
    return good ? 0 : 1;
}
