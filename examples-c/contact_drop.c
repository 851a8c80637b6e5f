/* Boxes that fall onto the ground and onto each other, and come to rest in stacks: a simulation of contacts by impulses, which asks
 * once a step for all that is near.
 *
 *   cc -std=c99 contact_drop.c rigid_boxes.c box_picture.c svg.c $(pkg-config --cflags --libs cstk) -lm -o contact_drop
 *   ./contact_drop contact_drop.svg
 *
 * Everything within a margin of something else is listed by cstk_environment_witnesses: the boxes among themselves, and against the
 * ground, which is an environment of its own. Impulses keep each contact from closing within the step (rigid_boxes.c), so that boxes
 * never overlap; a gap of half a millimetre is left between them. A body here is a box and its eight corners, each a point: all
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

enum { STACK = 5, FALLING = 7, BOXES = STACK + FALLING, STEPS = 1200, SHOTS = 4, MAX_TOUCHES = 4096 };
static const double step = 1.0 / 240, margin = 0.03, gap = 0.0005, friction = 0.6;
static const int shot_steps[SHOTS] = {0, 100, 170, STEPS - 1};

typedef struct simulation {
    cstk_query *query;
    cstk_environment *ground, *world;
    rigid_box boxes[BOXES];
    uint64_t ids[BOXES];
    cstk_environment_change moves[BOXES];
    touch touches[MAX_TOUCHES];
    size_t touch_count;
    size_t overlaps; /* primitives that were found overlapping, over all steps */
    double nearest;  /* the least clearance so far */
} simulation;

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

static uint64_t add(cstk_environment *environment, const double half[3], const double pose[12]) {
    const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
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
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    check(cstk_environment_change_default(&change, sizeof change));
    change.kind = CSTK_CHANGE_ADD;
    change.body = body;
    for (int k = 0; k < 12; ++k) {
        change.pose[k] = pose[k];
    }
    check(cstk_environment_apply(environment, &change, 1, &id, NULL));
    check(cstk_body_release(body));
    return id;
}

/* A stack with some space between, and bricks above it and beside it, turned. */
static void make_boxes(simulation *s) {
    for (int i = 0; i < BOXES; ++i) {
        const int stands = i < STACK, k = i - STACK;
        const double cube[3] = {0.1, 0.1, 0.1}, brick[3] = {0.16, 0.08, 0.05};
        const double on_stack[3] = {0.01 * (i % 2), 0, 0.11 + 0.21 * i};
        const double above[3] = {0.35 * cos(2.4 * k) - 0.1, 0.35 * sin(2.4 * k), 0.6 + 0.32 * k};
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
    const double below[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -0.1};
    simulation *s = calloc(1, sizeof *s);
    if (s == NULL) {
        abort();
    }
    s->nearest = INFINITY;
    check(cstk_query_create(&s->query));
    check(cstk_environment_create(&s->ground));
    check(cstk_environment_create(&s->world));
    add(s->ground, plate, below);
    make_boxes(s);
    for (int i = 0; i < BOXES; ++i) {
        double pose[12];
        box_pose(&s->boxes[i], pose);
        s->ids[i] = add(s->world, s->boxes[i].half, pose);
        check(cstk_environment_change_default(&s->moves[i], sizeof s->moves[i]));
        s->moves[i].kind = CSTK_CHANGE_MOVE;
        s->moves[i].id = s->ids[i];
    }
    return s;
}

static rigid_box *box_of(simulation *s, uint64_t id) {
    for (int i = 0; i < BOXES; ++i) {
        if (s->ids[i] == id) {
            return &s->boxes[i];
        }
    }
    return NULL;
}

/* Adds the contacts of the boxes with those of another environment, or, for NULL, among themselves. */
static void find_touches(simulation *s, const cstk_environment *other) {
    cstk_witness_list list;
    check(cstk_environment_witnesses(s->query, s->world, other, margin, MAX_TOUCHES, NULL, &list));
    for (size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness *witness = &list.witnesses[i];
        s->overlaps += witness->overlapping;
        for (uint32_t k = 0; k < witness->contact_count && s->touch_count < MAX_TOUCHES; ++k) {
            const cstk_contact *contact = &list.contacts[witness->first_contact + k];
            touch *t = &s->touches[s->touch_count++];
            t->r = box_of(s, witness->r_object);
            t->s = box_of(s, witness->s_object);
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
    s->touch_count = 0;
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

static void draw_shot(FILE *svg, const simulation *s, int shot) {
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
    snprintf(title, sizeof title, "%.2f s, %zu contacts", shot_steps[shot] * step, s->touch_count);
    svg_text(svg, x, y + 75, 16, "middle", title);
}

int main(int argc, char **argv) {
    simulation *s = make_simulation();
    double *energies = malloc(STEPS * sizeof *energies), gained = 0;
    FILE *svg = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (energies == NULL || (argc > 1 && svg == NULL)) {
        fprintf(stderr, "cannot write\n");
        return 1;
    }
    if (svg != NULL) {
        svg_begin(svg, 1200, 760);
    }
    printf("%d boxes fall; steps of 1/240 s\n  time, s  energy, J  contacts  least clearance, mm\n", BOXES);
    for (int i = 0, shot = 0; i < STEPS; ++i) {
        const double before = total_energy(s);
        advance(s);
        energies[i] = total_energy(s);
        gained = fmax(gained, energies[i] - before);
        if (i % 120 == 0 || i == STEPS - 1) {
            printf("%9.2f %10.3f %9zu %12.3f\n", i * step, energies[i], s->touch_count, 1e3 * s->nearest);
        }
        if (svg != NULL && shot < SHOTS && i == shot_steps[shot]) {
            draw_shot(svg, s, shot++);
        }
    }
    if (svg != NULL) {
        draw_curve(svg, energies, STEPS, 40, 580, 1120, 130, "kinetic and potential energy over 5 s");
        svg_end(svg);
        fclose(svg);
    }
    const double stack_height = s->boxes[STACK - 1].position[2];
    printf("energy gained in a step, at most: %.4f J; overlaps: %zu; fastest at the end: %.4f m/s\n", gained,
           s->overlaps, fastest(s));
    printf("the stack's top box is %.3f above the ground\n", stack_height);
    const int well = gained < 0.01 * energies[0] && s->overlaps == 0 && fastest(s) < 0.02 && s->nearest > 0;
    check(cstk_environment_release(s->ground));
    check(cstk_environment_release(s->world));
    check(cstk_query_release(s->query));
    free(energies);
    free(s);
    return well ? 0 : 1;
}
