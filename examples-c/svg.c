#include "svg.h"

#include <math.h>

void svg_begin(FILE *svg, int width, int height) {
    fprintf(svg,
            "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' "
            "viewBox='0 0 %d %d' font-family='DejaVu Sans, sans-serif' fill='#111'>\n"
            "<rect width='%d' height='%d' fill='#fff'/>\n",
            width, height, width, height, width, height);
}

void svg_end(FILE *svg) { fprintf(svg, "</svg>\n"); }

void svg_text(FILE *svg, double x, double y, int size, const char *anchor, const char *text) {
    fprintf(
        svg,
        "<text x='%.1f' y='%.1f' font-size='%d' text-anchor='%s' stroke='#fff' stroke-width='5' "
        "stroke-linejoin='round' paint-order='stroke'>%s</text>\n",
        x, y, size, anchor, text);
}

void svg_dot(FILE *svg, double x, double y, double radius, const char *fill) {
    fprintf(svg, "<circle cx='%.1f' cy='%.1f' r='%.1f' fill='%s' stroke='#000'/>\n", x, y, radius,
            fill);
}

void svg_arrow(FILE *svg, double x, double y, double dx, double dy, const char *colour) {
    double norm = hypot(dx, dy), ux = 12 * dx / norm, uy = 12 * dy / norm;
    fprintf(svg,
            "<path d='M%.1f %.1fl%.1f %.1f' stroke='%s' stroke-width='3.5'/>"
            "<path d='M%.1f %.1fl%.1f %.1fl%.1f %.1fz' fill='%s'/>\n",
            x, y, dx - ux, dy - uy, colour, x + dx, y + dy, -1.3 * ux - 0.6 * uy,
            -1.3 * uy + 0.6 * ux, 1.2 * uy, -1.2 * ux, colour);
}

void svg_frame(FILE *svg, double x, double y, double width, double height, const char *stroke) {
    fprintf(svg, "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='none' %s/>\n", x, y,
            width, height, stroke);
}
