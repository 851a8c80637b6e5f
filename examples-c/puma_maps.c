/* Maps of a Puma 560's C-space: its first two joints as a picture (puma_map_2.png), its first three
 * as the boundary of what is not free (puma_map_3.glb). The others stand as at the start of
 * puma_slider.c's slide.
 *
 *     puma_maps MESHES FOLDER
 *
 * MESHES holds the meshes of scripts/fetch_puma560.sh, FOLDER is where the pictures go. */
#include "puma_scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

/* How far the first three joints go, either way, in degrees. */
static const double limit[3] = {160, 110, 135};

/* The classes over the first joints, so many cells each; prints what they cost. */
static cstk_map *build(const scene *s, const cstk_cobject *cobject, size_t joints, size_t cells) {
    cstk_map_axis axes[3] = {{0, 0, 0, 0, 0, 0, 0}};
    cstk_map *map = NULL;
    cstk_map_view view;
    for (size_t i = 0; i < joints; ++i) {
        axes[i].coordinate = (uint32_t)i;
        axes[i].low = -limit[i] * PI / 180;
        axes[i].high = limit[i] * PI / 180;
        axes[i].cells = cells;
    }
    check(cstk_map_build(cobject, s->start, s->nq, axes, joints, NULL, NULL, NULL, &map));
    check(cstk_map_get_view(map, &view));
    size_t inside = 0;
    for (size_t i = 0; i < view.cell_count; ++i) {
        inside += view.values[i] == CSTK_CLASS_INSIDE ? 1 : 0;
    }
    printf("%zu joints, %zu cells: %.1f %% inside; %.0f boxes proved, %.0f configurations asked\n",
           joints, view.cell_count, 100.0 * (double)inside / (double)view.cell_count,
           (double)view.proofs, (double)view.questions);
    return map;
}

/* Whether every 97th cell has the class that its middle has when it is asked alone. */
static bool is_right(const scene *s, const cstk_cobject *cobject, const cstk_map *map) {
    cstk_map_view view;
    cstk_query *query = NULL;
    check(cstk_map_get_view(map, &view));
    check(cstk_query_create(&query));
    bool right = true;
    for (size_t cell = 0; cell < view.cell_count; cell += 97) {
        double q[MAX_JOINTS];
        cstk_class where;
        size_t rest = cell;
        for (size_t i = 0; i < s->nq; ++i) {
            q[i] = s->start[i];
        }
        for (size_t i = view.axis_count; i-- > 0;) {
            const cstk_map_axis *axis = &view.axes[i];
            double place = (double)(rest % axis->cells) + 0.5;
            q[axis->coordinate] =
                axis->low + (axis->high - axis->low) * (place / (double)axis->cells);
            rest /= axis->cells;
        }
        check(cstk_classify(query, cobject, q, s->nq, &where));
        right = right && view.values[cell] == (uint8_t)where;
    }
    check(cstk_query_release(query));
    return right;
}

int main(int count, char **arguments) {
    if (count != 3) {
        fprintf(stderr, "usage: puma_maps MESHES FOLDER\n");
        return 2;
    }
    scene s = puma560_scene(arguments[1]);
    cstk_cobject *cobject = NULL;
    bool right = true;
    /* Of the scene's own sets contact is a class; where a set has none, what is proved free need
     * not be asked. */
    check(cstk_cobject_induced(s.space, NULL, 0, s.environment, NULL, 0, NULL, &cobject));
    const struct {
        size_t joints, cells;
        const char *picture;
    } maps[] = {{2, 512, "puma_map_2.png"}, {3, 96, "puma_map_3.glb"}};
    for (int i = 0; i < 2; ++i) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", arguments[2], maps[i].picture);
        cstk_map *map = build(&s, cobject, maps[i].joints, maps[i].cells);
        right = is_right(&s, cobject, map) && right;
        check(cstk_map_show(map, path));
        check(cstk_map_release(map));
    }
    printf(right ? "every 97th cell is what its middle is alone\n" : "SOME CELLS ARE WRONG\n");
    check(cstk_cobject_release(cobject));
    release_scene(&s);
    return right ? 0 : 1;
}
