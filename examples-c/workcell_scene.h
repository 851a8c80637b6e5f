/* The scene of workcell.c: two arms of six joints that face each other over a table. Metres. */
#ifndef WORKCELL_SCENE_H
#define WORKCELL_SCENE_H

#include <cstk.h>

#include <stddef.h>
#include <stdint.h>

enum { LEFT, RIGHT, ARMS };
enum { BASE, SHOULDER, UPPER_ARM, FOREARM, WRIST, KNUCKLE, HAND, LINKS }; /* of an arm */
enum { JOINTS = LINKS - 1, NQ = ARMS * JOINTS };                          /* the base is fixed */
enum { TABLE, FIXTURE, BIN, OBJECTS };

typedef struct cell {
    cstk_robot *arms[ARMS];
    cstk_space *space;             /* of both arms: left, then right */
    cstk_space_offset first[ARMS]; /* where an arm's links and coordinates begin there */
    cstk_environment *environment;
    uint64_t ids[OBJECTS]; /* of the s-objects; the bin's is 0 until it is added */
} cell;

extern const char *const object_names[OBJECTS];

/* The arm that a link of the space belongs to: links are numbered through, arm after arm. */
int arm_of(const cell *c, uint32_t link);

/* Ends the program with the library's message unless the status is CSTK_OK. */
void check(cstk_status status);

/* The arms, their space, table and fixture. */
cell make_cell(void);

void release_cell(cell *c);

/* An open box of five walls, its bottom in the plane z = 0. */
cstk_body *make_bin(void);

#endif
