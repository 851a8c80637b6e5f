/* A motion filter: Appendix A of the report, and the same on a Puma 560 with its real meshes.
 *
 * A step that would run into an obstacle is turned into one that slides along it. Usage:
 *
 *   puma_slider appendix MODELS OUT      the arm of Appendix A, meshes in the folder MODELS
 *   puma_slider puma560 MESHES OUT       a Puma 560 in a workcell, STL meshes in the folder MESHES
 *
 * Pictures of frames 10, 20, 30 and 40 (.glb) and the path (.csv) go to the folder OUT.
 */
#include "puma_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_configuration(const double *q, size_t nq) {
    printf("(");
    for (size_t i = 0; i < nq; ++i) {
        printf("%s%7.4f", i ? ", " : "", q[i]);
    }
    printf(")");
}

/* Walks straight on, without looking. Returns the first step whose configuration is inside; 0 if there is none. */
static int first_collision(const scene *s, cstk_query *query, double *joint) {
    double q[MAX_JOINTS];
    memcpy(q, s->start, sizeof q);
    for (int step = 1; step <= s->steps; ++step) {
        for (size_t i = 0; i < s->nq; ++i) {
            q[i] += s->step[i];
        }
        cstk_class where;
        check(cstk_classify(query, s->cobject, q, s->nq, &where));
        if (where == CSTK_CLASS_INSIDE) {
            *joint = q[0];
            return step;
        }
    }
    return 0;
}

static void save_frame(const scene *s, const double *q, int step, const char *folder) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s_%02d.glb", folder, s->name, step);
    check(cstk_show(s->cobject, q, s->nq, path));
}

/* What the demo promises of a slide. */
typedef struct summary {
    int moved, run, longest_run;
    double least_distance, travel, final_joint;
} summary;

/* The report's run-slider. */
static summary run_slider(const scene *s, cstk_query *query, const char *folder, FILE *path) {
    summary found = {.least_distance = INFINITY};
    cstk_slide_options options;
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = s->max_shell;
    options.desired_distance = s->desired_distance;
    options.normalize = 1;
    double q[MAX_JOINTS];
    memcpy(q, s->start, sizeof q);
    double run_travel = 0;
    for (int step = 0;; ++step) {
        cstk_distance_result d;
        check(cstk_distance(query, s->cobject, q, s->nq, INFINITY, &d));
        found.least_distance = fmin(found.least_distance, d.lower);
        for (size_t i = 0; i < s->nq; ++i) {
            fprintf(path, "%.17g,", q[i]);
        }
        fprintf(path, "%.17g\n", d.distance);
        if (step > 0 && step % 10 == 0 && step <= 40) {
            printf("  frame %d: q = ", step);
            print_configuration(q, s->nq);
            printf("  distance %.4f\n", d.distance);
            save_frame(s, q, step, folder);
        }
        if (step == s->steps) {
            break;
        }
        double next[MAX_JOINTS];
        cstk_slide_result result;
        check(cstk_slide(query, s->cobject, q, s->nq, s->step, s->nq, &options, next, &result));
        if (result.outcome != CSTK_SLIDE_MOVED) {
            printf("  step %d: %s\n", step + 1,
                   result.outcome == CSTK_SLIDE_INSIDE ? "inside" : "blocked");
            break;
        }
        ++found.moved;
        if (result.distance_before <= s->max_shell) {
            run_travel += fabs(next[1] - q[1]) + fabs(next[2] - q[2]);
            if (++found.run > found.longest_run) {
                found.longest_run = found.run;
                found.travel = run_travel;
            }
        } else {
            found.run = 0;
            run_travel = 0;
        }
        memcpy(q, next, sizeof q);
    }
    found.final_joint = q[0];
    return found;
}

static int report(const summary *found, double collision_joint) {
    double past = found->final_joint - collision_joint;
    int good = found->least_distance > 0 && found->longest_run >= 10 && found->travel >= 0.1 &&
               past >= 0.15;
    printf("  %d steps taken, never nearer than %.4g; %d of them in a row within the stand-off,\n"
           "  in which joints 2 and 3 moved %.3f rad; joint 1 ends %.3f rad past the collision\n",
           found->moved, found->least_distance, found->longest_run, found->travel, past);
    printf("  %s\n", good ? "the robot slid along the obstacle and went on" : "THE SLIDE FELL SHORT");
    return good ? 0 : 1;
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "usage: puma_slider appendix|puma560 MESH_FOLDER OUT_FOLDER\n");
        return 2;
    }
    scene s = strcmp(argv[1], "puma560") == 0 ? puma560_scene(argv[2]) : appendix_scene(argv[2]);
    cstk_query *query = NULL;
    check(cstk_query_create(&query));
    printf("%s: from ", s.name);
    print_configuration(s.start, s.nq);
    printf(" by ");
    print_configuration(s.step, s.nq);
    printf(", %d steps, stand-off %g\n", s.steps, s.max_shell);

    double collision_joint = 0;
    int collision = first_collision(&s, query, &collision_joint);
    if (collision == 0) {
        printf("  the unfiltered motion is free; there is nothing to slide along\n");
    } else {
        printf("  unfiltered, the motion runs into an obstacle at step %d (joint 1 = %.4f)\n",
               collision, collision_joint);
    }

    char name[4096];
    snprintf(name, sizeof name, "%s/%s.csv", argv[3], s.name);
    FILE *path = fopen(name, "w");
    if (path == NULL) {
        perror(name);
        return 1;
    }
    summary found = run_slider(&s, query, argv[3], path);
    fclose(path);
    int outcome = collision == 0 ? 1 : report(&found, collision_joint);
    check(cstk_query_release(query));
    release_scene(&s);
    return outcome;
}
