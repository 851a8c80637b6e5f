/* The few primitives of SVG that the pictures need. Lengths are in pixels, y points down. */
#ifndef SVG_H
#define SVG_H

#include <stdio.h>

void svg_begin(FILE *svg, int width, int height);
void svg_end(FILE *svg);

/* With a white rim, which keeps it legible on whatever is below. Anchor: start, middle or end. */
void svg_text(FILE *svg, double x, double y, int size, const char *anchor, const char *text);

void svg_dot(FILE *svg, double x, double y, double radius, const char *fill);

/* From (x, y) to (x + dx, y + dy). */
void svg_arrow(FILE *svg, double x, double y, double dx, double dy, const char *colour);

/* An outline; `stroke` is its attributes. */
void svg_frame(FILE *svg, double x, double y, double width, double height, const char *stroke);

#endif
