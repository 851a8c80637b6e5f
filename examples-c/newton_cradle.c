/* Newton's cradle: five balls on strings, of which one is let go. Each step asks for all pairs of balls that touch within it
 * (cstk_environment_witnesses), and hands on their impulses until no two approach each other.
 *
 *   cc -std=c99 newton_cradle.c svg.c $(pkg-config --cflags --libs cstk) -lm -o newton_cradle && ./newton_cradle newton_cradle.svg
 *
 * With the name of a file it draws the balls as the first strikes, as the last swings out, and their angles over time. Metres,
 * seconds; all balls weigh 1 kg.
 */
#include "svg.h"

#include <cstk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BALLS = 5, STEPS = 50000, PASSES = 100, SAMPLES = 500 };
static const double step = 1e-4, string = 1.0, radius = 0.05, gravity = 9.81, start = -0.5;
static const double between = 2e-6; /* of balls at rest */
static const double margin = 1e-3;  /* more than two balls come nearer in a step */

typedef struct cradle {
    cstk_query *query;
    cstk_environment *world;
    cstk_environment_change moves[BALLS];
    double angle[BALLS], speed[BALLS]; /* of the centre, along its circle */
    double deepest;                    /* the least clearance so far */
    size_t overlaps;
} cradle;

static void check(cstk_status status) {
    if (status != CSTK_OK) {
        fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
        exit(1);
    }
}

/* The centre of a ball; strings hang at z = 0. */
static void center(const cradle *c, int ball, double out[3]) {
    out[0] = (2 * radius + between) * ball + string * sin(c->angle[ball]);
    out[1] = 0;
    out[2] = -string * cos(c->angle[ball]);
}

static void place(cradle *c) {
    for (int i = 0; i < BALLS; ++i) {
        double at[3];
        center(c, i, at);
        for (int k = 0; k < 3; ++k) {
            c->moves[i].pose[4 * k + 3] = at[k];
        }
    }
    check(cstk_environment_apply(c->world, c->moves, BALLS, NULL, NULL));
}

static void make_cradle(cradle *c) {
    const double origin[3] = {0, 0, 0};
    cstk_body_builder *builder = NULL;
    cstk_body *ball = NULL;
    check(cstk_query_create(&c->query));
    check(cstk_environment_create(&c->world));
    check(cstk_body_builder_create(3, &builder));
    check(cstk_body_builder_add_sphere(builder, origin, radius, 0));
    check(cstk_body_build(builder, NULL, NULL, NULL, &ball));
    check(cstk_body_builder_release(builder));
    c->deepest = INFINITY;
    c->overlaps = 0;
    for (int i = 0; i < BALLS; ++i) {
        cstk_environment_change *move = &c->moves[i];
        c->angle[i] = i == 0 ? start : 0;
        c->speed[i] = 0;
        check(cstk_environment_change_default(move, sizeof *move));
        move->kind = CSTK_CHANGE_ADD;
        move->body = ball;
        check(cstk_environment_apply(c->world, move, 1, &move->id, NULL));
        move->kind = CSTK_CHANGE_MOVE;
        move->body = NULL;
    }
    check(cstk_body_release(ball));
    place(c);
}

static int ball_of(const cradle *c, uint64_t id) {
    int ball = 0;
    while (ball < BALLS && c->moves[ball].id != id) {
        ++ball;
    }
    return ball;
}

/* Balls that would touch within the step exchange an impulse along the line between them: nothing is lost. Returns whether any did. */
static int exchange(cradle *c, const cstk_witness_list *list) {
    int any = 0;
    for (size_t i = 0; i < list->contact_count; ++i) {
        const cstk_witness *witness = &list->witnesses[i]; /* each has one contact */
        const cstk_contact *contact = &list->contacts[witness->first_contact];
        const int r = ball_of(c, witness->r_object), s = ball_of(c, witness->s_object);
        const double along_r = contact->normal[0] * cos(c->angle[r]) + contact->normal[2] * sin(c->angle[r]);
        const double along_s = contact->normal[0] * cos(c->angle[s]) + contact->normal[2] * sin(c->angle[s]);
        const double parting = along_r * c->speed[r] - along_s * c->speed[s];
        if (parting < 0 && contact->clearance + parting * step <= 0) {
            const double impulse = -2 * parting / (along_r * along_r + along_s * along_s);
            c->speed[r] += impulse * along_r;
            c->speed[s] -= impulse * along_s;
            any = 1;
        }
    }
    return any;
}

static void advance(cradle *c) {
    cstk_witness_list list;
    check(cstk_environment_witnesses(c->query, c->world, NULL, margin, 64, NULL, &list));
    for (size_t i = 0; i < list.witness_count; ++i) {
        c->overlaps += list.witnesses[i].overlapping;
    }
    for (size_t i = 0; i < list.contact_count; ++i) {
        c->deepest = fmin(c->deepest, list.contacts[i].clearance);
    }
    for (int i = 0; i < BALLS; ++i) {
        c->speed[i] -= 0.5 * step * gravity * sin(c->angle[i]);
    }
    for (int pass = 0; pass < PASSES && exchange(c, &list); ++pass) {
    }
    for (int i = 0; i < BALLS; ++i) {
        c->angle[i] += step * c->speed[i] / string;
        c->speed[i] -= 0.5 * step * gravity * sin(c->angle[i]);
    }
    place(c);
}

static double energy(const cradle *c) {
    double sum = 0;
    for (int i = 0; i < BALLS; ++i) {
        sum += 0.5 * c->speed[i] * c->speed[i] + gravity * string * (1 - cos(c->angle[i]));
    }
    return sum;
}

static void draw(FILE *svg, const cradle *c, double x, double y, const char *title) {
    const double scale = 300;
    for (int i = 0; i < BALLS; ++i) {
        double at[3];
        center(c, i, at);
        const double top = x + scale * 2 * radius * i;
        fprintf(svg, "<path d='M%.1f %.1fL%.1f %.1f' stroke='#555' stroke-width='1.5'/>\n", top, y,
                x + scale * at[0], y - scale * at[2]);
        svg_dot(svg, x + scale * at[0], y - scale * at[2], scale * radius, i == 0 ? "#d08030" : "#7090c0");
    }
    svg_text(svg, x + 4 * scale * radius, y + scale * string + 50, 16, "middle", title);
}

static void draw_angles(FILE *svg, double angles[SAMPLES][BALLS], double x, double y, double width, double height) {
    static const char *const colours[BALLS] = {"#d08030", "#b0b0b0", "#909090", "#707070", "#3050a0"};
    svg_frame(svg, x, y, width, height, "stroke='#999'");
    for (int ball = 0; ball < BALLS; ++ball) {
        fprintf(svg, "<polyline fill='none' stroke='%s' stroke-width='2' points='", colours[ball]);
        for (int i = 0; i < SAMPLES; ++i) {
            fprintf(svg, "%.1f,%.1f ", x + width * i / (SAMPLES - 1),
                    y + height * (0.5 - 0.8 * angles[i][ball]));
        }
        fprintf(svg, "'/>\n");
    }
    svg_text(svg, x + 8, y + height + 22, 15, "start",
             "angles of the first ball (orange), the last (blue) and those between, over 5 s");
}

int main(int argc, char **argv) {
    static double angles[SAMPLES][BALLS];
    cradle c;
    FILE *svg = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (argc > 1 && svg == NULL) {
        fprintf(stderr, "cannot write %s\n", argv[1]);
        return 1;
    }
    make_cradle(&c);
    const double first = energy(&c);
    double drift = 0, swung = 0, between_swung = 0;
    if (svg != NULL) {
        svg_begin(svg, 1100, 700);
        draw(svg, &c, 200, 40, "let go");
    }
    printf("  time, s  energy, J  angles, rad\n");
    for (int i = 0, drawn = 0; i < STEPS; ++i) {
        const double before = c.speed[BALLS - 1];
        advance(&c);
        drift = fmax(drift, fabs(energy(&c) / first - 1));
        if (i % (STEPS / SAMPLES) == 0) {
            for (int ball = 0; ball < BALLS; ++ball) {
                angles[i / (STEPS / SAMPLES)][ball] = c.angle[ball];
            }
        }
        /* The first swing of the last ball ends. */
        if (before > 0 && c.speed[BALLS - 1] <= 0 && swung == 0 && c.angle[BALLS - 1] > 0.1) {
            swung = c.angle[BALLS - 1];
            between_swung = fmax(fabs(c.angle[1]), fmax(fabs(c.angle[2]), fabs(c.angle[3])));
        }
        if (svg != NULL && ((drawn == 0 && c.angle[BALLS - 1] > 0.005) || (drawn == 1 && swung > 0))) {
            draw(svg, &c, 480 + 290 * drawn, 40, drawn == 0 ? "struck" : "handed on");
            ++drawn;
        }
        if (i % (STEPS / 10) == 0) {
            printf("%9.2f %10.6f ", i * step, energy(&c));
            for (int ball = 0; ball < BALLS; ++ball) {
                printf(" %7.4f", c.angle[ball]);
            }
            printf("\n");
        }
    }
    if (svg != NULL) {
        draw_angles(svg, angles, 60, 440, 980, 200);
        svg_end(svg);
        fclose(svg);
    }
    printf("the last ball swings out to %.4f rad, those between to %.4f; energy within %.1e of the first\n", swung,
           between_swung, drift);
    printf("least clearance %.2e m, overlaps %zu\n", c.deepest, c.overlaps);
    const int well = swung > 0.98 * -start && between_swung < 0.02 && drift < 1e-3 && c.overlaps == 0;
    check(cstk_environment_release(c.world));
    check(cstk_query_release(c.query));
    return well ? 0 : 1;
}
