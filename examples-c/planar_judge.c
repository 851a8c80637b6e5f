#include "planar_judge.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Whether the way from frame to frame is free and in the space; asked anew, at many points. */
static bool is_clear(const world *w, cstk_query *query, const slide *s) {
    enum { POINTS = 20 };
    for (int k = 0; k < s->last; ++k) {
        for (int i = 0; i <= POINTS; ++i) {
            double q[LINKS];
            cstk_class where;
            bool contained;
            check(cstk_space_interpolate(w->space, s->frames[k].q, s->frames[k + 1].q, LINKS,
                                         (double)i / POINTS, q));
            check(cstk_classify(query, w->cobject, q, LINKS, &where));
            check(cstk_space_contains(w->space, q, LINKS, &contained));
            if (where == CSTK_CLASS_INSIDE || !contained) {
                return false;
            }
        }
    }
    return true;
}

/* Walks straight on, without looking. Returns the first step that leads into S0; 0 if none does. */
static int first_collision(const world *w, cstk_query *query) {
    double q[LINKS];
    memcpy(q, start, sizeof q);
    for (int step = 1; step <= MAX_STEPS; ++step) {
        check(cstk_space_step(w->space, q, LINKS, asked, LINKS, q));
        cstk_class where;
        check(cstk_classify(query, w->sets[S0], q, LINKS, &where));
        if (where == CSTK_CLASS_INSIDE) {
            return step;
        }
    }
    return 0;
}

bool judge_slide(const world *w, cstk_query *query, const slide *s) {
    int met = 0, left, next, last = s->last;
    while (met < last && !s->frames[met].near[S0]) {
        ++met;
    }
    for (left = met; left < last && (s->frames[left].near[S0] || s->frames[left].near[S1]);) {
        ++left;
    }
    for (next = left; next < last && !s->frames[next].near[S1];) {
        ++next;
    }
    double least = INFINITY;
    for (int k = 0; k <= last; ++k) {
        least = fmin(least, s->frames[k].distance);
    }
    int collision = first_collision(w, query);
    bool clear = is_clear(w, query, s);
    const frame *end = &s->frames[last];
    printf(
        "  straight on, it would run into S0 at step %d; never nearer than %.4g, the way is %s;\n"
        "  along S0 from step %d to %d, free to %d, then along S1; the wrist moved %.3f rad\n",
        collision, least, clear ? "clear" : "NOT CLEAR", met, left - 1, next - 1,
        fabs(end->q[R2] - start[R2]));
    bool good = collision > 0 && clear && least > 0 && left - met >= 20 && next > left &&
                end->near[S1] && end->near[SELF] && end->outcome == CSTK_SLIDE_BLOCKED;
    printf("  %s\n",
           good ? "the arm slid round S0, went on along S1, and stopped short of its own first link"
                : "THE SLIDE WENT OTHERWISE");
    return good;
}

bool judge_wrist(const slide *held, const slide *freed) {
    return held->frames[held->last].q[R2] == start[R2] &&
           fabs(freed->frames[freed->last].q[R2] - start[R2]) > 0.2;
}
