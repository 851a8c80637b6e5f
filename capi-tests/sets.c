/* Sets made of others, of every kind: what is answered about a tree is what its leaves' closed
 * forms give by the rules of the header. */
#include <math.h>

#include "check.h"
#include "cube.h"

enum { NQ = CUBE_NQ };

typedef enum operation { LEAF, UNION, INTERSECTION, COMPLEMENT, DIFFERENCE } operation;

typedef struct tree {
    operation operation;
    int leaf;
    struct tree *parts[3];
    int count;
    cstk_cobject *set;
} tree;

static uint64_t random_state = 0x9E3779B97F4A7C15u;

static uint64_t random_below(uint64_t count) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (random_state >> 11) % count;
}

static void make_set(tree *t) {
    const cstk_cobject *sets[3];
    for (int i = 0; i < t->count; ++i) {
        sets[i] = t->parts[i]->set;
    }
    switch (t->operation) {
    case UNION:
        CHECK_OK(cstk_cobject_union(sets, (size_t)t->count, &t->set));
        break;
    case INTERSECTION:
        CHECK_OK(cstk_cobject_intersection(sets, (size_t)t->count, &t->set));
        break;
    case COMPLEMENT:
        CHECK_OK(cstk_cobject_complement(sets[0], &t->set));
        break;
    default:
        CHECK_OK(cstk_cobject_difference(sets[0], sets[1], &t->set));
    }
}

enum { MOST_NODES = 64 };

/* A tree over some of the leaves, each once; the last of the nodes is its root. Returns their
 * number. */
static int random_tree(const cube *c, tree nodes[MOST_NODES]) {
    static const int counts[] = {0, 2, 2, 1, 2};
    tree *open[LEAVES];
    int open_count = 0;
    int node_count = 0;
    for (int i = 0; i < LEAVES; ++i) {
        if (random_below(3) > 0 || (i == LEAVES - 1 && open_count == 0)) {
            tree *t = &nodes[node_count++];
            *t = (tree){LEAF, i, {NULL}, 0, c->leaves[i].set};
            open[open_count++] = t;
        }
    }
    while (open_count > 1 || (random_below(4) == 0 && node_count < MOST_NODES - LEAVES)) {
        tree *t = &nodes[node_count];
        const operation operation = (enum operation)(1 + random_below(4));
        int count = counts[operation];
        if (count > open_count || (count == 1 && node_count >= MOST_NODES - LEAVES)) {
            continue;
        }
        if (operation <= INTERSECTION && open_count > 2) {
            count += (int)random_below(2);
        }
        *t = (tree){operation, 0, {NULL}, count, NULL};
        for (int i = 0; i < count; ++i) {
            const int taken = (int)random_below((uint64_t)open_count);
            t->parts[i] = open[taken];
            open[taken] = open[--open_count];
        }
        make_set(t);
        open[open_count++] = t;
        ++node_count;
    }
    return node_count;
}

static void release_tree(const tree *nodes, int count) {
    for (int i = 0; i < count; ++i) {
        if (nodes[i].operation != LEAF) {
            CHECK_OK(cstk_cobject_release(nodes[i].set));
        }
    }
}

/* Whether part i is meant by its complement. */
static bool turns(const tree *t, int i) {
    return t->operation == COMPLEMENT || (t->operation == DIFFERENCE && i == 1);
}

static cstk_class class_of(const tree *t, const double *q) {
    if (t->operation == LEAF) {
        return leaf_class(t->leaf, q);
    }
    int most = CSTK_CLASS_OUTSIDE;
    int least = CSTK_CLASS_INSIDE;
    for (int i = 0; i < t->count; ++i) {
        const int part = class_of(t->parts[i], q);
        const int meant = turns(t, i) ? CSTK_CLASS_INSIDE - part : part;
        most = meant > most ? meant : most;
        least = meant < least ? meant : least;
    }
    return (cstk_class)(t->operation == UNION ? most : least);
}

/* What is known of a distance. */
typedef struct reach {
    double distance;
    bool is_exact;
} reach;

static reach leaf_reach(int leaf, const double *q, bool complement) {
    const double away = leaf_distance(leaf, q);
    if (!complement) {
        return (reach){fmax(0.0, away), true};
    }
    return (reach){leaf_knows_depth(leaf) ? fmax(0.0, -away) : 0.0,
                   leaf_knows_depth(leaf) || away > 0.0};
}

static reach reach_of(const tree *t, const double *q, bool complement) {
    if (t->operation == LEAF) {
        return leaf_reach(t->leaf, q, complement);
    }
    const bool is_union = (t->operation == UNION) != complement;
    reach all[3];
    double least = INFINITY;
    double most = 0.0;
    for (int i = 0; i < t->count; ++i) {
        all[i] = reach_of(t->parts[i], q, complement != turns(t, i));
        least = fmin(least, all[i].distance);
        most = fmax(most, all[i].distance);
    }
    if (t->count == 1) {
        return all[0];
    }
    reach found = {is_union ? least : most, !is_union && most == 0.0};
    for (int i = 0; i < t->count; ++i) {
        if (is_union) {
            found.is_exact = found.is_exact || (all[i].is_exact && all[i].distance == least);
        } else {
            found.is_exact = found.is_exact && all[i].is_exact;
        }
    }
    return found;
}

static void check_distance(const cube *c, const tree *t, const double *q) {
    cstk_distance_result d;
    bool within = false;
    const reach expected = reach_of(t, q, false);
    CHECK_OK(cstk_distance(c->query, t->set, q, NQ, INFINITY, &d));
    CHECK(d.kind == (expected.is_exact ? CSTK_DISTANCE_EXACT : CSTK_DISTANCE_LOWER_BOUND));
    CHECK(fabs(d.distance - expected.distance) < 1e-13);
    CHECK(d.lower <= d.distance && d.distance <= d.upper && d.distance - d.lower < 1e-13);
    CHECK((d.lower == 0.0) == (expected.distance == 0.0));
    CHECK(d.kind == CSTK_DISTANCE_LOWER_BOUND || d.upper - d.distance < 1e-13);
    for (int i = 0; i < 5; ++i) {
        const double threshold = 0.15 * (double)random_below(8);
        CHECK_OK(cstk_within(c->query, t->set, q, NQ, threshold, &within));
        CHECK(within == (expected.distance <= threshold));
        CHECK_OK(cstk_distance(c->query, t->set, q, NQ, threshold, &d));
        if (within) {
            CHECK(d.kind == (expected.is_exact ? CSTK_DISTANCE_EXACT : CSTK_DISTANCE_LOWER_BOUND));
            CHECK(fabs(d.distance - expected.distance) < 1e-13);
        } else {
            CHECK(d.kind == CSTK_DISTANCE_BEYOND_MAX && d.distance == INFINITY && d.upper == INFINITY);
            CHECK(fabs(d.lower - threshold) < 1e-13 && !d.has_witness && !d.has_contact);
        }
    }
}

/* A leaf where the tree has it. */
typedef struct place {
    int leaf;
    bool complemented;
    bool decisive;
} place;

static int places_of(const tree *t, const double *q, bool complemented, bool decides, place *out) {
    if (t->operation == LEAF) {
        *out = (place){t->leaf, complemented, decides};
        return 1;
    }
    int count = 0;
    const int class_here = class_of(t, q);
    for (int i = 0; i < t->count; ++i) {
        const int part = class_of(t->parts[i], q);
        const int meant = turns(t, i) ? CSTK_CLASS_INSIDE - part : part;
        count += places_of(t->parts[i], q, complemented != turns(t, i),
                           decides && meant == class_here, out + count);
    }
    return count;
}

static void check_names(const cube *c, const cstk_witness *w, int leaf) {
    CHECK(w->cobject == c->leaves[leaf].number && w->cobject_data == c->leaves[leaf].data);
    /* The world box names the link that decides. */
    const uint32_t link = leaf == WORLD ? w->r_link : leaf_is_pure(leaf) ? CSTK_NONE : CUBE_LINK;
    CHECK(w->r_link == link && w->s_link == CSTK_NONE && (leaf != WORLD || link <= CUBE_LINK));
    CHECK(!w->complemented || leaf_is_pure(leaf));
    CHECK((w->coordinate < NQ) == (leaf == LIMITS || leaf == BOX));
    CHECK(w->s_object == (leaf_is_pure(leaf) ? 0 : c->objects[leaf]) && w->r_object == 0);
    CHECK(w->r_tag == (leaf_is_pure(leaf) ? 0 : 7) && w->s_tag == w->r_tag);
    CHECK(w->r_data == NULL && w->s_data == NULL);
}

static void check_rows(const cstk_witness_list *list, const cstk_witness *w, const place *at,
                       const double *q) {
    const double sign = leaf_is_pure(at->leaf) && at->complemented ? -1.0 : 1.0;
    for (uint32_t i = w->first_contact; i < w->first_contact + w->contact_count; ++i) {
        CHECK((list->contacts[i].mode == CSTK_MODE_PURE_SET) == leaf_is_pure(at->leaf));
        for (int k = 0; k < NQ; ++k) {
            double expected;
            if (leaf_slope(at->leaf, q, k, &expected)) {
                CHECK(fabs(list->gradients[i * NQ + (uint32_t)k] - sign * expected) < 1e-6);
            }
        }
    }
}

/* Every leaf within epsilon, or its complement, whatever the tree makes of it; the nearest first.
 */
static void check_witnesses(const cube *c, const tree *t, const double *q) {
    place places[LEAVES];
    cstk_witness_list list;
    size_t expected = 0;
    const double epsilon = 0.1 + 0.2 * (double)random_below(6);
    const int count = places_of(t, q, false, true, places);
    CHECK_OK(cstk_gradients(c->query, t->set, q, NQ, epsilon, 64, &list));
    CHECK(list.nv == NQ && !list.truncated);
    for (int i = 0; i < count; ++i) {
        const place *at = &places[i];
        const reach r = leaf_reach(at->leaf, q, at->complemented && leaf_is_pure(at->leaf));
        if (r.distance > epsilon || !r.is_exact) {
            continue;
        }
        const cstk_witness *found = NULL;
        for (size_t k = 0; k < list.witness_count; ++k) {
            found = list.witnesses[k].cobject == c->leaves[at->leaf].number ? &list.witnesses[k]
                                                                            : found;
        }
        CHECK(found != NULL && fabs(found->distance - r.distance) < 1e-13);
        check_names(c, found, at->leaf);
        check_rows(&list, found, at, q);
        CHECK(found->overlapping == (found->contact_count == 0));
        ++expected;
    }
    CHECK(list.witness_count == expected);
    for (size_t k = 1; k < list.witness_count; ++k) {
        CHECK(list.witnesses[k - 1].distance <= list.witnesses[k].distance);
    }
    const double nearest = expected > 0 ? list.witnesses[0].distance : 0.0;
    CHECK_OK(cstk_gradients(c->query, t->set, q, NQ, epsilon, 1, &list));
    CHECK(list.truncated == (expected > 1) && list.witness_count == (expected > 0));
    CHECK(expected == 0 || list.witnesses[0].distance == nearest);
}

/* The class, and which leaves and pairs it rests on. Returns how many pairs were named. */
static size_t check_explanation(const cube *c, const tree *t, const double *q) {
    place places[LEAVES];
    cstk_class point_class;
    cstk_explanation why;
    const int count = places_of(t, q, false, true, places);
    CHECK_OK(cstk_classify(c->query, t->set, q, NQ, &point_class));
    CHECK_OK(cstk_explain(c->query, t->set, q, NQ, 64, &why));
    CHECK(point_class == class_of(t, q) && why.point_class == point_class);
    CHECK(why.leaf_count == (size_t)count && !why.list.truncated && why.list.gradients == NULL);
    for (int i = 0; i < count; ++i) {
        const place *at = &places[i];
        const cstk_verdict *said = NULL;
        for (size_t k = 0; k < why.leaf_count; ++k) {
            said = why.leaves[k].cobject == c->leaves[at->leaf].number ? &why.leaves[k] : said;
        }
        CHECK(said != NULL && said->data == c->leaves[at->leaf].data);
        CHECK(said->leaf_class == leaf_class(at->leaf, q));
        CHECK(said->complemented == at->complemented && said->decisive == at->decisive);
        const bool has_reason = at->decisive && said->leaf_class != CSTK_CLASS_OUTSIDE;
        CHECK(said->witness_count == has_reason);
        if (has_reason) {
            const cstk_witness *w = &why.list.witnesses[said->first_witness];
            check_names(c, w, at->leaf);
            CHECK(fabs(w->distance - fmax(0.0, leaf_distance(at->leaf, q))) < 1e-13);
        }
    }
    return why.list.witness_count;
}

static void check_pseudo_normal(const cube *c, const tree *t, const double *q) {
    cstk_distance_result d;
    cstk_witness_list list;
    cstk_pseudo_normal_result all;
    CHECK_OK(cstk_distance(c->query, t->set, q, NQ, INFINITY, &d));
    CHECK_OK(cstk_pseudo_normal(c->query, t->set, q, NQ, 0.7, 64, false, &all));
    CHECK(all.point_class == class_of(t, q) && all.distance.distance == d.distance);
    CHECK(all.distance.kind == d.kind && all.distance.lower == d.lower);
    const size_t counts[2] = {all.list.witness_count, all.list.contact_count};
    CHECK_OK(cstk_gradients(c->query, t->set, q, NQ, 0.7, 64, &list));
    CHECK(list.witness_count == counts[0] && list.contact_count == counts[1]);
}

static void random_trees(const cube *c) {
    int seen[3] = {0};
    size_t reasons = 0;
    for (int n = 0; n < 300; ++n) {
        tree nodes[MOST_NODES];
        const int count = random_tree(c, nodes);
        const tree *root = &nodes[count - 1];
        for (int i = 0; i < 4; ++i) {
            double q[NQ];
            for (int k = 0; k < NQ; ++k) {
                q[k] = 2.1 * ((double)random_below(1u << 30) / (double)(1u << 29) - 1.0);
            }
            ++seen[class_of(root, q)];
            check_distance(c, root, q);
            check_witnesses(c, root, q);
            reasons += check_explanation(c, root, q);
            check_pseudo_normal(c, root, q);
        }
        release_tree(nodes, count);
    }
    CHECK(seen[CSTK_CLASS_OUTSIDE] > 100 && seen[CSTK_CLASS_CONTACT] > 50 && seen[CSTK_CLASS_INSIDE] > 100);
    CHECK(reasons > 500);
}

static void expect_witnesses(const cube *c, cstk_cobject *set, size_t expected) {
    const double q[NQ] = {0.0, 0.0, 0.0};
    cstk_witness_list list;
    CHECK_OK(cstk_witnesses(c->query, set, q, NQ, 100.0, 64, &list));
    if (list.witness_count != expected) {
        fprintf(stderr, "%zu witnesses instead of %zu\n", list.witness_count, expected);
        ++check_failures;
    }
    CHECK_OK(cstk_cobject_release(set));
}

/* However often a leaf stands in a tree, it is listed once; a pure one once more for its
 * complement. */
static void each_leaf_once(const cube *c) {
    const cstk_cobject *a = c->leaves[OBSTACLE].set;
    const cstk_cobject *b = c->leaves[BALL].set;
    cstk_cobject *either = NULL;
    cstk_cobject *not_a = NULL;
    cstk_cobject *not_b = NULL;
    cstk_cobject *still_b = NULL;
    cstk_cobject *set = NULL;
    const cstk_cobject *both[2] = {a, c->leaves[GROWN_OBSTACLE].set};
    CHECK_OK(cstk_cobject_union(both, 2, &either));
    CHECK_OK(cstk_cobject_complement(a, &not_a));
    CHECK_OK(cstk_cobject_complement(b, &not_b));
    CHECK_OK(cstk_cobject_complement(not_b, &still_b));
    const cstk_cobject *pairs[4][2] = {{a, either}, {a, not_a}, {b, not_b}, {b, still_b}};
    const size_t expected[4] = {2, 1, 2, 1};
    for (int i = 0; i < 4; ++i) {
        CHECK_OK(cstk_cobject_intersection(pairs[i], 2, &set));
        expect_witnesses(c, set, expected[i]);
        CHECK_OK(cstk_cobject_union(pairs[i], 2, &set));
        expect_witnesses(c, set, expected[i]);
    }
    CHECK_OK(cstk_cobject_release(still_b));
    CHECK_OK(cstk_cobject_release(not_b));
    CHECK_OK(cstk_cobject_release(not_a));
    CHECK_OK(cstk_cobject_release(either));
}

int main(void) {
    cube c;
    cube_create(&c);
    random_trees(&c);
    each_leaf_once(&c);
    cube_release(&c);
    return check_result();
}
