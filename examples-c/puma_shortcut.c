/* Shortcuts, proved: a Puma 560 slides under a post and past it by 130 short steps. Between which configurations of this path may it go
 * at once?
 *
 *   puma_shortcut MESHES OUT      STL meshes in the folder MESHES; two pictures (.glb) go to the folder OUT
 *
 * The straight motion from the first to the last is not free: where it first touches is drawn in shortcut_contact.glb. The path of
 * shortcuts that are, and the robot on it, is drawn in shortcut_free.glb.
 */
#include "puma_scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAX_POINTS = 131, GHOSTS = 6 };

typedef struct path {
    double q[MAX_POINTS][MAX_JOINTS]; /* one after the other: the Puma has MAX_JOINTS */
    size_t count;
} path;

/* The slide of puma_slider.c, and on. */
static path slide(const scene *s, cstk_query *query) {
    path found = {.count = 1};
    cstk_slide_options options;
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = s->max_shell;
    options.desired_distance = s->desired_distance;
    options.normalize = 1;
    memcpy(found.q[0], s->start, sizeof found.q[0]);
    for (; found.count < MAX_POINTS; ++found.count) {
        cstk_slide_result result;
        check(cstk_slide(query, s->cobject, found.q[found.count - 1], s->nq, s->step, s->nq, &options,
                         found.q[found.count], &result));
        if (result.outcome != CSTK_SLIDE_MOVED) {
            break;
        }
    }
    return found;
}

static cstk_motion_result motion(const scene *s, cstk_query *query, const double *from,
                                 const double *to, double *reached) {
    cstk_motion_result found;
    check(cstk_motion(query, s->cobject, from, to, s->nq, NULL, reached, &found));
    return found;
}

/* From each point on the farthest that a motion leads to which is proved free. */
static path shortened(const scene *s, cstk_query *query, const path *whole) {
    path found = {.count = 0};
    for (size_t at = 0;;) {
        memcpy(found.q[found.count++], whole->q[at], sizeof found.q[0]);
        if (at + 1 == whole->count) {
            return found;
        }
        size_t next = whole->count - 1;
        while (next > at + 1 && motion(s, query, whole->q[at], whole->q[next], NULL).outcome !=
                                    CSTK_MOTION_FREE) {
            --next;
        }
        at = next;
    }
}

static double length(const path *p, size_t nq) {
    double sum = 0;
    for (size_t i = 0; i + 1 < p->count; ++i) {
        double squares = 0;
        for (size_t k = 0; k < nq; ++k) {
            squares += pow(p->q[i + 1][k] - p->q[i][k], 2);
        }
        sum += sqrt(squares);
    }
    return sum;
}

/* Draws the robot at q in its workcell, and as an object at each point of a path. */
static void draw(const scene *s, const double *q, const path *ghosts, const char *folder,
                 const char *name) {
    uint64_t ids[(GHOSTS + 1) * 16];
    size_t count = 0, links = 0;
    cstk_environment_change change;
    check(cstk_environment_change_default(&change, sizeof change));
    check(cstk_robot_get_size(s->robot, NULL, NULL, &links));
    for (size_t i = 0; i < ghosts->count; ++i) {
        /* The base stays where it is. */
        for (uint32_t link = 1; link < links; ++link) {
            cstk_body *body = NULL;
            if (cstk_robot_get_body(s->robot, link, &body) != CSTK_OK) {
                continue; /* a joint without a body */
            }
            change.body = body;
            check(cstk_robot_link_pose(s->robot, ghosts->q[i], s->nq, link, change.pose));
            check(cstk_environment_apply(s->environment, &change, 1, &ids[count++], NULL));
            check(cstk_body_release(body));
        }
    }
    char file[4096];
    snprintf(file, sizeof file, "%s/%s.glb", folder, name);
    check(cstk_show(s->cobject, q, s->nq, file));
    check(cstk_environment_change_default(&change, sizeof change));
    change.kind = CSTK_CHANGE_DELETE;
    while (count > 0) {
        change.id = ids[--count];
        check(cstk_environment_apply(s->environment, &change, 1, NULL, NULL));
    }
}

/* Places at equal times of the motion from one configuration to another. */
static path places(const scene *s, const double *from, const double *to) {
    path found = {.count = GHOSTS};
    for (size_t i = 0; i < GHOSTS; ++i) {
        check(cstk_space_interpolate(s->space, from, to, s->nq, (double)i / GHOSTS, found.q[i]));
    }
    return found;
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: puma_shortcut MESHES OUT\n");
        return 2;
    }
    scene s = puma560_scene(argv[1]);
    cstk_query *query = NULL;
    check(cstk_query_create(&query));
    const path whole = slide(&s, query);
    const double *first = whole.q[0], *last = whole.q[whole.count - 1];

    double contact[MAX_JOINTS];
    const cstk_motion_result straight = motion(&s, query, first, last, contact);
    const bool meets = straight.outcome == CSTK_MOTION_HIT;
    printf("straight from the first to the last point: %s\n", meets ? "not free" : "FREE");
    if (meets) {
        char link[32];
        check(cstk_space_get_link_name(s.space, straight.distance.witness.r_link, link, sizeof link, NULL));
        printf("  free for %.6f of the way, then %s meets object %llu\n", straight.times[0], link,
               (unsigned long long)straight.distance.witness.s_object);
        const path ghosts = places(&s, first, contact);
        draw(&s, contact, &ghosts, argv[2], "shortcut_contact");
    }

    const path cut = shortened(&s, query, &whole);
    cstk_path_result proof;
    check(cstk_motion_path(query, s.cobject, cut.q[0], cut.count, s.nq, NULL, NULL, NULL, NULL,
                           &proof));
    const bool is_free = proof.motion.outcome == CSTK_MOTION_FREE;
    printf("%zu points, %.4f rad; with shortcuts %zu points, %.4f rad: %s\n", whole.count,
           length(&whole, s.nq), cut.count, length(&cut, s.nq), is_free ? "proved free" : "NOT FREE");
    draw(&s, last, &cut, argv[2], "shortcut_free");

    check(cstk_query_release(query));
    release_scene(&s);
    return meets && is_free && cut.count < whole.count && cut.count <= GHOSTS + 1 ? 0 : 1;
}
