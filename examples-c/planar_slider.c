/* A motion filter in the plane: the robot of the report's Figure 16 (section 4.4), three revolute
 * links in a row.
 *
 * The arm is asked to turn; obstacles S0 and S1 and its own first link make a slide of that. It is
 * done twice: with the wrist held, which leaves a slice of C-space that can be drawn, and with all
 * three joints. Usage:
 *
 *   planar_slider FOLDER
 *
 * The picture (planar_slider.svg) and both paths (planar_slider.csv) go to the folder. Here is the
 * use of the library; planar_scene.c has the arm's measures and polygons, planar_judge.c tells
 * whether it slid as it was meant to, and planar_picture.c draws. Build:
 *
 *   cc -std=c99 planar_slider.c planar_scene.c planar_judge.c planar_picture.c svg.c \
 *      $(pkg-config --cflags --libs cstk) -lm -o planar_slider
 */
#include "planar_scene.h"
#include "planar_judge.h"
#include "planar_picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static cstk_body *make_body(const shape *s) {
    cstk_body_builder *builder = NULL;
    cstk_body *body = NULL;
    check(cstk_body_builder_create(2, &builder));
    for (size_t i = 0; i < s->count; ++i) {
        const polygon *p = &s->polygons[i];
        double xyz[3 * MAX_CORNERS] = {0};
        for (size_t k = 0; k < p->count; ++k) {
            xyz[3 * k] = p->xy[k][0];
            xyz[3 * k + 1] = p->xy[k][1];
        }
        check(cstk_body_builder_add_polygon(builder, xyz, p->count, i));
    }
    check(cstk_body_build(builder, NULL, NULL, NULL, &body));
    check(cstk_body_builder_release(builder));
    return body;
}

static void make_robot(scene *s) {
    cstk_robot_builder *builder = NULL;
    check(cstk_robot_builder_create(2, &builder));
    /* The last link is the end effector's frame: it has no body. */
    for (int i = 0; i <= LINKS; ++i) {
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        cstk_body *body = i < LINKS ? make_body(&s->links[i]) : NULL;
        def.body = body;
        def.parent = i - 1;
        def.joint = i < LINKS ? CSTK_JOINT_REVOLUTE : CSTK_JOINT_FIXED;
        def.at[3] = i > 0 ? lengths[i - 1] : 0;
        check(cstk_robot_builder_add_link(builder, &def, NULL));
        check(cstk_body_release(body));
    }
    check(cstk_robot_build(builder, &s->robot));
    check(cstk_robot_builder_release(builder));
}

static void make_environment(scene *s) {
    const double at[OBSTACLES][6] = {{1.45, 1.3, 0, 0, -0.5, 0}, {-0.2, 1.05, 0, 0, 0, 0}};
    check(cstk_environment_create(&s->environment));
    for (int i = 0; i < OBSTACLES; ++i) {
        cstk_environment_change change;
        check(cstk_environment_change_default(&change, sizeof change));
        cstk_body *body = make_body(&s->obstacles[i]);
        change.body = body;
        check(cstk_pose_from_euler(at[i], change.pose));
        check(cstk_environment_apply(s->environment, &change, 1, &s->ids[i], NULL));
        check(cstk_body_release(body));
    }
}

/* With `held` the third joint keeps its value: its range is that alone. */
static world make_world(const scene *s, bool held) {
    world w;
    cstk_range ranges[LINKS];
    memset(ranges, 0, sizeof ranges);
    for (int i = 0; i < LINKS; ++i) {
        ranges[i].kind = CSTK_RANGE_CIRCLE;
    }
    if (held) {
        ranges[R2].kind = CSTK_RANGE_INTERVAL;
        ranges[R2].lower = ranges[R2].upper = start[R2];
    }
    const double reach = lengths[R0] + lengths[R1] + lengths[R2];
    const double box[6] = {0, 0, 0, reach, reach, 0};
    const cstk_robot *robots[] = {s->robot};
    check(cstk_space_create(robots, 1, ranges, LINKS, box, &w.space));

    cstk_induced_options options;
    check(cstk_induced_options_default(&options, sizeof options));
    options.contact_epsilon = max_shell;
    cstk_cobject *parts[LINKS + 1];
    for (uint32_t i = 0; i < LINKS; ++i) {
        check(cstk_cobject_induced(w.space, &i, 1, s->environment, s->ids, OBSTACLES, &options,
                                   &parts[i]));
    }
    const uint32_t pair[2] = {R0, R2};
    check(cstk_cobject_induced_links(w.space, pair, 1, &options, &parts[LINKS]));
    check(cstk_cobject_union((const cstk_cobject *const *)parts, LINKS + 1, &w.cobject));
    for (int i = 0; i < OBSTACLES; ++i) {
        check(cstk_cobject_induced(w.space, NULL, 0, s->environment, &s->ids[i], 1, &options,
                                   &w.sets[i]));
    }
    w.sets[SELF] = parts[LINKS];
    for (int i = 0; i < LINKS; ++i) {
        check(cstk_cobject_release(parts[i]));
    }
    return w;
}

static void release_world(world *w) {
    for (int i = 0; i < SETS; ++i) {
        check(cstk_cobject_release(w->sets[i]));
    }
    check(cstk_cobject_release(w->cobject));
    check(cstk_space_release(w->space));
}

static void run_slide(const world *w, cstk_query *query, slide *s) {
    cstk_slide_options options;
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = max_shell;
    options.desired_distance = desired_distance;
    options.normalize = 1;
    memcpy(s->frames[0].q, start, sizeof start);
    for (s->last = 0;; ++s->last) {
        frame *now = &s->frames[s->last];
        for (int i = 0; i < SETS; ++i) {
            check(cstk_within(query, w->sets[i], now->q, LINKS, max_shell, &now->near[i]));
        }
        cstk_slide_result result;
        double next[LINKS];
        check(cstk_slide(query, w->cobject, now->q, LINKS, asked, LINKS, &options, next, &result));
        now->distance = result.distance_before;
        now->contacts = result.contact_count;
        now->outcome = result.outcome;
        if (result.outcome != CSTK_SLIDE_MOVED || s->last == MAX_STEPS) {
            return;
        }
        check(cstk_space_wrap(w->space, next, LINKS, s->frames[s->last + 1].q));
    }
}

static void names_of_near(const frame *f, char *text, size_t size) {
    static const char *const names[SETS] = {" S0", " S1", " R0/R2"};
    size_t used = 0;
    text[0] = 0;
    for (int i = 0; i < SETS; ++i) {
        if (f->near[i]) {
            used += (size_t)snprintf(text + used, size - used, "%s", names[i]);
        }
    }
}

/* The frames at which something comes near or goes away, and every 25th. */
static void print_slide(const slide *s) {
    printf("  step   theta0   theta1   theta2  distance  contacts  outcome\n");
    for (int k = 0; k <= s->last; ++k) {
        const frame *f = &s->frames[k];
        if (k > 0 && k < s->last && k % 25 != 0 &&
            memcmp(f->near, s->frames[k - 1].near, sizeof f->near) == 0) {
            continue;
        }
        char near[32];
        names_of_near(f, near, sizeof near);
        printf("  %4d  %7.4f  %7.4f  %7.4f  %8.4f  %8u  %s%s\n", k, f->q[0], f->q[1], f->q[2],
               f->distance, f->contacts,
               f->outcome == CSTK_SLIDE_INSIDE    ? "inside"
               : f->outcome == CSTK_SLIDE_BLOCKED ? "blocked by"
               : near[0]                          ? "slides on"
                                                  : "free",
               near[0] || f->outcome != CSTK_SLIDE_BLOCKED ? near : " the world box");
    }
}

static void write_paths(FILE *csv, const slide slides[2]) {
    fprintf(csv, "slide,step,theta0,theta1,theta2,distance,contacts\n");
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k <= slides[i].last; ++k) {
            const frame *f = &slides[i].frames[k];
            fprintf(csv, "%s,%d,%.17g,%.17g,%.17g,%.17g,%u\n", slides[i].name, k, f->q[0], f->q[1],
                    f->q[2], f->distance, (unsigned)f->contacts);
        }
    }
}

static FILE *create(const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    return file;
}

static void finish(FILE *file, const char *name) {
    bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        fprintf(stderr, "%s could not be written\n", name);
        exit(1);
    }
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: planar_slider FOLDER\n");
        return 2;
    }
    static scene s;
    static slide slides[2] = {{.name = "wrist held"}, {.name = "all joints"}};
    world worlds[2];
    make_shapes(&s);
    make_robot(&s);
    make_environment(&s);
    cstk_query *query = NULL;
    check(cstk_query_create(&query));
    bool good = true;
    for (int i = 0; i < 2; ++i) {
        worlds[i] = make_world(&s, i == 0);
        run_slide(&worlds[i], query, &slides[i]);
        printf("%s: by (%g, %g, %g) a step, stand-off %g\n", slides[i].name, asked[0], asked[1],
               asked[2], max_shell);
        print_slide(&slides[i]);
        good = judge_slide(&worlds[i], query, &slides[i]) && good;
    }
    good = judge_wrist(&slides[0], &slides[1]) && good;

    FILE *svg = create(argv[1], "planar_slider.svg");
    draw_picture(svg, &s, worlds, query, slides);
    finish(svg, "planar_slider.svg");
    FILE *csv = create(argv[1], "planar_slider.csv");
    write_paths(csv, slides);
    finish(csv, "planar_slider.csv");
    for (int i = 0; i < 2; ++i) {
        release_world(&worlds[i]);
    }
    check(cstk_query_release(query));
    check(cstk_environment_release(s.environment));
    check(cstk_robot_release(s.robot));
    return good ? 0 : 1;
}
