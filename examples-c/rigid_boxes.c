#include "rigid_boxes.h"

#include <math.h>
#include <stdlib.h>

static const double gravity = 9.81;
enum { ROUNDS = 200 }; /* fewer do not carry a blow through a stack */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void rotation(const rigid_box *box, double m[9]) {
    const double x = box->turn[0], y = box->turn[1], z = box->turn[2], w = box->turn[3];
    const double rows[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                            2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                            2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 9; ++i) {
        m[i] = rows[i];
    }
}

rigid_box make_rigid_box(const double half[3], const double position[3], double density) {
    rigid_box box = {{0}, 0, {0}, {0}, {0, 0, 0, 1}, {0}, {0}};
    box.mass = 8 * half[0] * half[1] * half[2] * density;
    for (int k = 0; k < 3; ++k) {
        const double a = half[(k + 1) % 3], b = half[(k + 2) % 3];
        box.half[k] = half[k];
        box.position[k] = position[k];
        box.inertia[k] = box.mass * (a * a + b * b) / 3;
    }
    return box;
}

void box_pose(const rigid_box *box, double pose[12]) {
    double m[9];
    rotation(box, m);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            pose[4 * i + k] = m[3 * i + k];
        }
        pose[4 * i + 3] = box->position[i];
    }
}

/* A vector of the world along the box's axes, divided by the inertia, and back. */
static void spin_from(const rigid_box *box, const double torque[3], double out[3]) {
    double m[9], own[3];
    rotation(box, m);
    for (int k = 0; k < 3; ++k) {
        own[k] = (m[k] * torque[0] + m[3 + k] * torque[1] + m[6 + k] * torque[2]) / box->inertia[k];
    }
    for (int i = 0; i < 3; ++i) {
        out[i] = dot(&m[3 * i], own);
    }
}

double box_energy(const rigid_box *box) {
    double m[9], energy = 0.5 * box->mass * dot(box->velocity, box->velocity);
    rotation(box, m);
    for (int k = 0; k < 3; ++k) {
        const double own = m[k] * box->spin[0] + m[3 + k] * box->spin[1] + m[6 + k] * box->spin[2];
        energy += 0.5 * box->inertia[k] * own * own;
    }
    return energy + box->mass * gravity * box->position[2];
}

void accelerate(rigid_box *boxes, size_t count, double time) {
    for (size_t i = 0; i < count; ++i) {
        boxes[i].velocity[2] -= gravity * time;
    }
}

static void velocity_at(const rigid_box *box, const double arm[3], double out[3]) {
    out[0] = out[1] = out[2] = 0;
    if (box != NULL) {
        cross(box->spin, arm, out);
        for (int k = 0; k < 3; ++k) {
            out[k] += box->velocity[k];
        }
    }
}

static void push(rigid_box *box, const double along[3], const double spin[3], double impulse) {
    if (box == NULL) {
        return;
    }
    for (int k = 0; k < 3; ++k) {
        box->velocity[k] += impulse * along[k] / box->mass;
        box->spin[k] += impulse * spin[k];
    }
}

/* How much a unit impulse changes the velocity of a box at a point, along the impulse; and its spin. */
static double mobility(const rigid_box *box, const double arm[3], const double along[3], double spin[3]) {
    double torque[3], turned[3];
    spin[0] = spin[1] = spin[2] = 0;
    if (box == NULL) {
        return 0;
    }
    cross(arm, along, torque);
    spin_from(box, torque, spin);
    cross(spin, arm, turned);
    return 1 / box->mass + dot(turned, along);
}

/* A contact as it is solved: along its normal, and along two directions across it. */
typedef struct solved {
    const touch *at;
    double arm_r[3], arm_s[3];
    double along[3][3];
    double spin_r[3][3], spin_s[3][3]; /* by a unit impulse along each */
    double mobility[3];
    double impulse[3];
    double target; /* the velocity at which it parts, at least; below 0 it may still approach */
} solved;

static void prepare(solved *c, const touch *at, double gap, double time) {
    /* Where boxes are nearer than the gap they part slowly, so that this adds little energy. */
    const double share = 0.1, fastest = 0.2;
    const double short_of = gap - at->clearance;
    const int smallest = fabs(at->normal[0]) < 0.6 ? 0 : 1;
    double axis[3] = {0, 0, 0};
    axis[smallest] = 1;
    c->at = at;
    c->target = short_of > 0 ? fmin(share * short_of / time, fastest) : short_of / time;
    for (int k = 0; k < 3; ++k) {
        c->arm_r[k] = at->r != NULL ? at->point[k] - at->r->position[k] : 0;
        c->arm_s[k] = at->s != NULL ? at->point[k] - at->s->position[k] : 0;
        c->along[0][k] = at->normal[k];
        c->impulse[k] = 0;
    }
    cross(at->normal, axis, c->along[1]);
    const double length = sqrt(dot(c->along[1], c->along[1]));
    for (int k = 0; k < 3; ++k) {
        c->along[1][k] /= length;
    }
    cross(at->normal, c->along[1], c->along[2]);
    for (int d = 0; d < 3; ++d) {
        c->mobility[d] = mobility(at->r, c->arm_r, c->along[d], c->spin_r[d]) +
                         mobility(at->s, c->arm_s, c->along[d], c->spin_s[d]);
    }
}

/* One impulse, along one of the contact's directions: normals only push, friction at most by its share of that. */
static void solve(solved *c, int d, double friction) {
    double on_r[3], on_s[3], low = 0, high = INFINITY;
    velocity_at(c->at->r, c->arm_r, on_r);
    velocity_at(c->at->s, c->arm_s, on_s);
    for (int k = 0; k < 3; ++k) {
        on_r[k] -= on_s[k];
    }
    if (d > 0) {
        high = friction * c->impulse[0];
        low = -high;
    }
    const double missing = (d == 0 ? c->target : 0) - dot(on_r, c->along[d]);
    const double sum = fmin(fmax(c->impulse[d] + missing / c->mobility[d], low), high);
    const double change = sum - c->impulse[d];
    c->impulse[d] = sum;
    push(c->at->r, c->along[d], c->spin_r[d], change);
    push(c->at->s, c->along[d], c->spin_s[d], -change);
}

void push_apart(const touch *touches, size_t count, double gap, double friction, double time) {
    solved *all = malloc((count + 1) * sizeof *all);
    if (all == NULL) {
        abort();
    }
    for (size_t i = 0; i < count; ++i) {
        prepare(&all[i], &touches[i], gap, time);
    }
    for (int round = 0; round < ROUNDS; ++round) {
        for (size_t i = 0; i < count; ++i) {
            for (int d = 0; d < 3; ++d) {
                solve(&all[i], d, friction);
            }
        }
    }
    free(all);
}

void move_boxes(rigid_box *boxes, size_t count, double time) {
    for (size_t i = 0; i < count; ++i) {
        rigid_box *box = &boxes[i];
        const double rate = sqrt(dot(box->spin, box->spin));
        for (int k = 0; k < 3; ++k) {
            box->position[k] += time * box->velocity[k];
        }
        if (rate == 0) {
            continue;
        }
        const double s = sin(0.5 * rate * time) / rate, w = cos(0.5 * rate * time);
        const double v[3] = {s * box->spin[0], s * box->spin[1], s * box->spin[2]};
        const double *q = box->turn;
        double t[3], next[4], norm = 0;
        cross(v, q, t);
        for (int k = 0; k < 3; ++k) {
            next[k] = w * q[k] + q[3] * v[k] + t[k];
        }
        next[3] = w * q[3] - dot(v, q);
        for (int k = 0; k < 4; ++k) {
            norm += next[k] * next[k];
        }
        for (int k = 0; k < 4; ++k) {
            box->turn[k] = next[k] / sqrt(norm);
        }
    }
}
