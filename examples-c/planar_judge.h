/* Whether the arm of planar_slider.c slid as it was meant to. */
#ifndef PLANAR_JUDGE_H
#define PLANAR_JUDGE_H

#include "planar_scene.h"

/* What is meant to happen: round S0, free, along S1, until R2 would meet R0. Prints what did. */
bool judge_slide(const world *w, cstk_query *query, const slide *s);

/* The wrist stayed where its range holds it; let go, it gave way. */
bool judge_wrist(const slide *held, const slide *freed);

#endif
