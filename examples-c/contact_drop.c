/* Boxes that fall on a stack, until all lie still: a simulation of contacts by impulses, which asks
 * once a step for all that is near.
 *
 *   cc -std=c99 contact_drop.c rigid_boxes.c box_picture.c svg.c $(pkg-config --cflags --libs cstk) -lm -o contact_drop
 *   ./contact_drop contact_drop.svg
 *
 * Everything within a margin of something else is listed by cstk_environment_witnesses: the boxes among themselves, and against the
 * ground, which is an environment of its own. Impulses keep each contact from closing within the step (rigid_boxes.c); a gap of
 * half a millimetre is left between boxes. Where boxes that turn fast overlap all the same, cstk_pair_penetration says how deeply, and
 * they are pushed out that way. A body here is a box and its eight corners, each a point: all
 * pairs of primitives are listed, so that a face on which a box stands has a contact at each corner, even where it is not quite
 * parallel. With the name of a file it draws four moments. Metres, seconds, kilograms.
 */
#include "box_picture.h"
#include "rigid_boxes.h"
#include "svg.h"

#include <cstk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STACK = 5, FALLING = 7, BOXES = STACK + FALLING, MIN_STEPS = 3500, MAX_STEPS = 10000, SHOTS = 4, MAX_TOUCHES = 4096 };
static const double step = 0.001, margin = 0.015, gap = 0.0005, friction = 0.6;
static const double at_rest = 0.02; /* metres a second */
static const int shot_steps[SHOTS - 1] = {0, 460, 790}; /* the last is at the end */

typedef struct simulation {
    cstk_query *query, *deep; /* the second for penetrations, while a list of the first is read */
    cstk_environment *ground, *world;
    rigid_box boxes[BOXES];
    cstk_body *bodies[BOXES + 1]; /* the last is the ground */
    double below[12];             /* the ground's pose */
    uint64_t ids[BOXES];
    cstk_environment_change moves[BOXES];
    touch touches[MAX_TOUCHES];
    size_t touch_count;
    size_t overlaps;          /* of two boxes, now */
    double nearest, deepest;  /* the least clearance so far, and the deepest penetration */
} simulation;

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

static uint64_t add(cstk_environment *environment, const double half[3], const double pose[12], cstk_body **body) {
    const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    cstk_environment_change change;
    uint64_t id = 0;
    check(cstk_body_builder_create(3, &builder));
    check(cstk_body_builder_add_box(builder, identity, half, 0));
    for (int corner = 0; corner < 8; ++corner) {
        double point[3];
        for (int k = 0; k < 3; ++k) {
            point[k] = (corner >> k & 1) ? half[k] : -half[k];
        }
        check(cstk_body_builder_add_sphere(builder, point, 0, 1));
    }
    check(cstk_body_build(builder, NULL, NULL, NULL, body));
    check(cstk_body_builder_release(builder));
    check(cstk_environment_change_default(&change, sizeof change));
    change.kind = CSTK_CHANGE_ADD;
    change.body = *body;
    for (int k = 0; k < 12; ++k) {
        change.pose[k] = pose[k];
    }
    check(cstk_environment_apply(environment, &change, 1, &id, NULL));
    return id;
}

/* A stack with some space between, and bricks above it, turned. */
static void make_boxes(simulation *s) {
    for (int i = 0; i < BOXES; ++i) {
        const int stands = i < STACK, k = i - STACK;
        const double cube[3] = {0.1, 0.1, 0.1}, brick[3] = {0.16, 0.08, 0.05};
        const double on_stack[3] = {0.01 * (i % 2), 0, 0.11 + 0.21 * i};
        const double above[3] = {0.16 * cos(2.4 * k), 0.16 * sin(2.4 * k), 1.35 + 0.4 * k};
        s->boxes[i] = make_rigid_box(stands ? cube : brick, stands ? on_stack : above, 500);
        if (!stands) {
            const double half_turn = 0.2 + 0.25 * k, axis[3] = {0.6, 0.48, 0.64};
            for (int d = 0; d < 3; ++d) {
                s->boxes[i].turn[d] = axis[d] * sin(half_turn);
            }
            s->boxes[i].turn[3] = cos(half_turn);
        }
    }
}

static simulation *make_simulation(void) {
    const double plate[3] = {3, 3, 0.1};
    simulation *s = calloc(1, sizeof *s);
    if (s == NULL) {
        abort();
    }
    s->below[0] = s->below[5] = s->below[10] = 1;
    s->below[11] = -plate[2];
    s->nearest = INFINITY;
    check(cstk_query_create(&s->query));
    check(cstk_query_create(&s->deep));
    check(cstk_environment_create(&s->ground));
    check(cstk_environment_create(&s->world));
    add(s->ground, plate, s->below, &s->bodies[BOXES]);
    make_boxes(s);
    for (int i = 0; i < BOXES; ++i) {
        double pose[12];
        box_pose(&s->boxes[i], pose);
        s->ids[i] = add(s->world, s->boxes[i].half, pose, &s->bodies[i]);
        check(cstk_environment_change_default(&s->moves[i], sizeof s->moves[i]));
        s->moves[i].kind = CSTK_CHANGE_MOVE;
        s->moves[i].id = s->ids[i];
        box_pose(&s->boxes[i], s->moves[i].pose);
    }
    return s;
}

/* The number of a box; BOXES for the ground. */
static int number_of(const simulation *s, uint64_t id) {
    int i = 0;
    while (i < BOXES && s->ids[i] != id) {
        ++i;
    }
    return i;
}

static rigid_box *box_at(simulation *s, int number) { return number < BOXES ? &s->boxes[number] : NULL; }

/* Contacts where two boxes overlap, and where corners are inside: the way out is the shortest. */
static void add_overlap(simulation *s, int r, int other) {
    cstk_penetration_list list;
    const double *pose_r = s->moves[r].pose, *pose_s = other < BOXES ? s->moves[other].pose : s->below;
    check(cstk_pair_penetration(s->deep, s->bodies[r], pose_r, s->bodies[other], pose_s, 64, &list));
    for (size_t i = 0; i < list.count; ++i) {
        const cstk_penetration *found = &list.penetrations[i];
        if (s->touch_count < MAX_TOUCHES) {
            touch *t = &s->touches[s->touch_count++];
            t->r = box_at(s, r);
            t->s = box_at(s, other);
            t->clearance = -found->depth;
            s->deepest = fmax(s->deepest, found->depth);
            for (int d = 0; d < 3; ++d) {
                t->point[d] = (found->r_point[d] + found->s_point[d]) / 2;
                t->normal[d] = found->direction[d];
            }
        }
    }
}

/* Adds the contacts of the boxes with those of another environment, or, for NULL, among themselves. */
static void find_touches(simulation *s, const cstk_environment *other) {
    cstk_witness_list list;
    check(cstk_environment_witnesses(s->query, s->world, other, margin, MAX_TOUCHES, NULL, &list));
    for (size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness *witness = &list.witnesses[i];
        const int r = number_of(s, witness->r_object), other_box = number_of(s, witness->s_object);
        if (witness->overlapping && witness->r_primitive == 0 && witness->s_primitive == 0) {
            ++s->overlaps;
            add_overlap(s, r, other_box);
        }
        for (uint32_t k = 0; k < witness->contact_count && s->touch_count < MAX_TOUCHES; ++k) {
            const cstk_contact *contact = &list.contacts[witness->first_contact + k];
            touch *t = &s->touches[s->touch_count++];
            t->r = box_at(s, r);
            t->s = box_at(s, other_box);
            t->clearance = contact->clearance;
            s->nearest = fmin(s->nearest, contact->clearance);
            for (int d = 0; d < 3; ++d) {
                t->point[d] = (contact->r_point[d] + contact->s_point[d]) / 2;
                t->normal[d] = contact->normal[d];
            }
        }
    }
}

static double total_energy(const simulation *s) {
    double energy = 0;
    for (int i = 0; i < BOXES; ++i) {
        energy += box_energy(&s->boxes[i]);
    }
    return energy;
}

static void advance(simulation *s) {
    s->touch_count = s->overlaps = 0;
    find_touches(s, NULL);
    find_touches(s, s->ground);
    accelerate(s->boxes, BOXES, step);
    push_apart(s->touches, s->touch_count, gap, friction, step);
    move_boxes(s->boxes, BOXES, step);
    for (int i = 0; i < BOXES; ++i) {
        box_pose(&s->boxes[i], s->moves[i].pose);
    }
    check(cstk_environment_apply(s->world, s->moves, BOXES, NULL, NULL));
}

static double fastest(const simulation *s) {
    double most = 0;
    for (int i = 0; i < BOXES; ++i) {
        const double *v = s->boxes[i].velocity;
        most = fmax(most, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    }
    return most;
}

static void draw_shot(FILE *svg, const simulation *s, int shot, int steps) {
    drawn_box drawn[BOXES + 1] = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -0.02}, {1, 1, 0.02}, 40}};
    char title[64];
    const double x = 150 + 300 * shot, y = 470;
    draw_boxes(svg, drawn, 1, x, y, 105); /* the ground first: it is below all others */
    for (int i = 0; i < BOXES; ++i) {
        box_pose(&s->boxes[i], drawn[i].pose);
        for (int k = 0; k < 3; ++k) {
            drawn[i].half[k] = s->boxes[i].half[k];
        }
        drawn[i].hue = i < STACK ? 210 : 20 + 12 * (i - STACK);
    }
    draw_boxes(svg, drawn, BOXES, x, y, 105);
    snprintf(title, sizeof title, "%.2f s, %zu contacts", steps * step, s->touch_count);
    svg_text(svg, x, y + 75, 16, "middle", title);
}

int main(int argc, char **argv) {
    simulation *s = make_simulation();
    double *energies = malloc(MAX_STEPS * sizeof *energies), gained = 0;
    int steps = 0;
    char title[64];
    FILE *svg = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (energies == NULL || (argc > 1 && svg == NULL)) {
        fprintf(stderr, "cannot write\n");
        return 1;
    }
    if (svg != NULL) {
        svg_begin(svg, 1200, 760);
    }
    printf("%d boxes fall; steps of a millisecond\n  time, s  energy, J  contacts  overlaps  deepest, mm\n", BOXES);
    for (int shot = 0; steps < MIN_STEPS || (steps < MAX_STEPS && fastest(s) >= at_rest); ++steps) {
        const double before = total_energy(s);
        advance(s);
        energies[steps] = total_energy(s);
        gained = fmax(gained, energies[steps] - before);
        if (steps % 500 == 0) {
            printf("%9.2f %10.3f %9zu %9zu %12.4f\n", steps * step, energies[steps], s->touch_count, s->overlaps, 1e3 * s->deepest);
        }
        if (svg != NULL && shot < SHOTS - 1 && steps == shot_steps[shot]) {
            draw_shot(svg, s, shot++, steps);
        }
    }
    if (svg != NULL) {
        draw_shot(svg, s, SHOTS - 1, steps);
        snprintf(title, sizeof title, "kinetic and potential energy over %.1f s", steps * step);
        draw_curve(svg, energies, (size_t)steps, 40, 580, 1120, 130, title);
        svg_end(svg);
        fclose(svg);
    }
    const double stack_height = s->boxes[STACK - 1].position[2];
    printf("energy gained in a step, at most: %.4f J; deepest penetration %.4f mm; fastest after %.1f s: %.4f m/s\n", gained,
           1e3 * s->deepest, steps * step, fastest(s));
    printf("the topmost box of the stack is now %.3f above the ground\n", stack_height);
    const int well = gained < 0.01 * energies[0] && s->overlaps == 0 && fastest(s) < at_rest && s->deepest < 4e-3;
    check(cstk_environment_release(s->ground));
    check(cstk_environment_release(s->world));
    check(cstk_query_release(s->query));
    check(cstk_query_release(s->deep));
    for (int i = 0; i <= BOXES; ++i) {
        check(cstk_body_release(s->bodies[i]));
    }
    free(energies);
    free(s);
    return well ? 0 : 1;
}
