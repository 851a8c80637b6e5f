/* A motion filter for two teleoperated arms at 1 kHz: each millisecond the operator wishes for a step, and the filter gives back the
 * part of it that slides along what is in the way, proved free on its whole length.
 *
 *   cc -std=c99 teleoperation.c workcell_scene.c svg.c $(pkg-config --cflags --libs cstk) -lm -o teleoperation
 *   ./teleoperation [SECONDS [PICTURE.svg]]
 *
 * The operator's wishes are sums of sines, which drive the arms of workcell.c into the table, the fixture, each other and
 * themselves. A minute is simulated, unless the seconds are given, and the times of all ticks are printed, on the clock and of the
 * processor (which others do not take from it): median, 99.9 %, longest. The picture shows the longest ticks over time.
 * A work limit ends a tick that would take too long: the arms then stand still for that millisecond.
 */
#define _POSIX_C_SOURCE 199309L
#include "svg.h"
#include "workcell_scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double margin = 0.005;          /* metres that are kept from everything */
static const double shell = 0.02;            /* within this the filter slides */
static const uint64_t work_limit = 200000;   /* pairs of nodes and primitives in a tick */

/* What the arms must stay clear of: each other, themselves, and the cell. */
static cstk_cobject *make_set(const cell *c, cstk_query *query) {
    cstk_induced_options options;
    cstk_link_pair_options choice;
    cstk_link_pair_list list;
    cstk_cobject *sets[2] = {NULL, NULL}, *all = NULL;
    uint32_t links[ARMS * LINKS];
    size_t count = 0;
    check(cstk_induced_options_default(&options, sizeof options));
    options.margin = margin;
    check(cstk_link_pair_options_default(&choice, sizeof choice));
    choice.margin = margin;
    check(cstk_find_link_pairs(query, c->space, &choice, NULL, NULL, &list));
    check(cstk_cobject_induced_links(c->space, list.tested, list.tested_count, &options, &sets[0]));
    for (int arm = 0; arm < ARMS; ++arm) {
        for (uint32_t link = BASE + 1; link < LINKS; ++link) {
            links[count++] = c->first[arm].link + link;
        }
    }
    check(cstk_cobject_induced(c->space, links, count, c->environment, NULL, 0, &options, &sets[1]));
    check(cstk_cobject_union((const cstk_cobject *const *)sets, 2, &all));
    check(cstk_cobject_release(sets[0]));
    check(cstk_cobject_release(sets[1]));
    return all;
}

/* Where the operator would have the arms at a time, if nothing were in the way. */
static void wish(double t, double q[NQ]) {
    static const double home[JOINTS] = {0, .6, .5, 0, .6, 0};
    for (int i = 0; i < NQ; ++i) {
        const int joint = i % JOINTS;
        const double rate = 1.1 + 0.17 * joint + 0.07 * (i / JOINTS);
        q[i] = home[joint] + 0.7 * sin(rate * t + 0.9 * i) - 0.7 * sin(0.9 * i) * exp(-t);
    }
}

static double microseconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_times(const char *what, double *times, size_t ticks) {
    qsort(times, ticks, sizeof *times, by_size);
    printf("microseconds %s, a tick: median %.1f, 99.9 %% below %.1f, longest %.1f\n", what, times[ticks / 2],
           times[ticks - 1 - ticks / 1000], times[ticks - 1]);
}

/* Where a time of a tick is in the picture: from 10 microseconds to 100 milliseconds, by its logarithm. */
static double height(double time) { return 440 - 100 * (log10(fmin(fmax(time, 10), 1e5)) - 1); }

/* The longest of the ticks in each of many parts of the time. */
static void draw_longest(FILE *svg, const double *times, size_t ticks, const char *colour) {
    const size_t parts = ticks < 490 ? ticks : 490;
    fprintf(svg, "<polyline fill='none' stroke='%s' points='", colour);
    for (size_t part = 0; part < parts; ++part) {
        double longest = 0;
        for (size_t i = part * ticks / parts; i < (part + 1) * ticks / parts; ++i) {
            longest = fmax(longest, times[i]);
        }
        fprintf(svg, "%.1f,%.1f ", 80 + 980.0 * (double)part / (double)parts, height(longest));
    }
    fprintf(svg, "'/>\n");
}

static void draw(FILE *svg, const double *times, const double *work, size_t ticks) {
    static const char *const names[] = {"10 us", "100 us", "1 ms", "10 ms", "100 ms"};
    char title[100];
    svg_begin(svg, 1100, 500);
    for (int i = 0; i < 5; ++i) {
        const double y = height(pow(10, i + 1));
        fprintf(svg, "<path d='M80 %.1fh980' stroke='%s'/>\n", y, i == 2 ? "#c33" : "#ddd");
        svg_text(svg, 72, y + 5, 14, "end", names[i]);
    }
    draw_longest(svg, times, ticks, "#bbb");
    draw_longest(svg, work, ticks, "#36c");
    snprintf(title, sizeof title, "longest ticks over %.0f s: of the processor (blue), on the clock (grey)", 1e-3 * (double)ticks);
    svg_text(svg, 80, 480, 16, "start", title);
    svg_end(svg);
}

typedef struct tally {
    size_t ticks, slid, held, over; /* all; in contact; stood still; at the work limit */
    size_t inside, wished_inside;   /* of every tenth */
} tally;

/* One tick: from q towards the wish, at most at 1 rad/s and joint. */
static void tick(cstk_query *query, const cstk_cobject *set, const cstk_slide_options *options, const double wished[NQ],
                 double q[NQ], tally *out) {
    double step[NQ];
    cstk_slide_result slid;
    for (int i = 0; i < NQ; ++i) {
        step[i] = fmin(fmax(0.05 * (wished[i] - q[i]), -1e-3), 1e-3);
    }
    const cstk_status status = cstk_slide(query, set, q, NQ, step, NQ, options, q, &slid);
    ++out->ticks;
    if (status == CSTK_ERROR_LIMIT) {
        ++out->over;
        return;
    }
    check(status);
    out->slid += slid.outcome == CSTK_SLIDE_MOVED && slid.contact_count > 0;
    out->held += slid.outcome != CSTK_SLIDE_MOVED;
}

int main(int argc, char **argv) {
    const double seconds = argc > 1 ? atof(argv[1]) : 60;
    const size_t ticks = seconds > 0 && seconds < 1e5 ? (size_t)(1000 * seconds) : 0;
    double *times = malloc((ticks + 1) * sizeof *times), *work = malloc((ticks + 1) * sizeof *work);
    double q[NQ], wished[NQ];
    cstk_query *query = NULL, *judge = NULL;
    cstk_slide_options options;
    tally count = {0};
    FILE *svg = argc > 2 ? fopen(argv[2], "w") : NULL;
    if (times == NULL || work == NULL || ticks == 0 || (argc > 2 && svg == NULL)) {
        fprintf(stderr, "usage: teleoperation [SECONDS [PICTURE.svg]]\n");
        return 2;
    }
    cell c = make_cell();
    check(cstk_query_create(&query));
    check(cstk_query_create(&judge));
    cstk_cobject *set = make_set(&c, query);
    check(cstk_query_set_limit(query, work_limit));
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = shell;
    wish(0, q);
    for (size_t i = 0; i < ticks; ++i) {
        wish(1e-3 * (double)i, wished);
        const double start = microseconds(CLOCK_MONOTONIC);
        const double worked = microseconds(CLOCK_THREAD_CPUTIME_ID);
        tick(query, set, &options, wished, q, &count);
        times[i] = microseconds(CLOCK_MONOTONIC) - start;
        work[i] = microseconds(CLOCK_THREAD_CPUTIME_ID) - worked;
        if (i % 10 == 0) {
            cstk_class here, there;
            check(cstk_classify(judge, set, q, NQ, &here));
            check(cstk_classify(judge, set, wished, NQ, &there));
            count.inside += here == CSTK_CLASS_INSIDE;
            count.wished_inside += there == CSTK_CLASS_INSIDE;
        }
    }
    printf("%zu ticks of a millisecond: %zu slid along contacts, %zu stood still, %zu reached the work limit\n", ticks, count.slid,
           count.held, count.over);
    printf("of every tenth, %zu wishes were inside; the arms were inside %zu times\n", count.wished_inside, count.inside);
    if (svg != NULL) {
        draw(svg, times, work, ticks);
        fclose(svg);
    }
    print_times("on the clock", times, ticks);
    print_times("of the processor", work, ticks);
    const bool well = count.inside == 0 && count.wished_inside > 0 && count.slid > 0;
    check(cstk_cobject_release(set));
    check(cstk_query_release(judge));
    check(cstk_query_release(query));
    release_cell(&c);
    free(work);
    free(times);
    return well ? 0 : 1;
}
