/* The picture of planar_slider.c: the arm along both slides, and the first in its slice of C-space.
 */
#ifndef PLANAR_PICTURE_H
#define PLANAR_PICTURE_H

#include "planar_scene.h"

#include <stdio.h>

/* Draws it as SVG. Of slides[0] and worlds[0] the wrist is held. */
void draw_picture(FILE *svg, const scene *s, const world worlds[2], cstk_query *query,
                  const slide slides[2]);

#endif
