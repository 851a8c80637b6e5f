/* Eight threads on one scene: their answers are those of one thread, to the last bit; a shared
 * query context is busy or answers; an environment is seen before or after a change, never in
 * between. */
#include <math.h>
#include <pthread.h>
#include <sched.h>

#include "check.h"
#include "fixture.h"

enum { THREADS = 8, QUERIES = 400 };

/* The answer for which all threads must agree; structures may have padding, so it is copied out of
 * the result. */
typedef struct answer {
    double numbers[3 + 6];
    uint64_t counts[6];
} answer;

typedef struct scene {
    fixture f;
    cstk_cobject *all;
    double q[QUERIES][FIXTURE_NQ];
    double poses[QUERIES][12];
    answer expected[QUERIES];
} scene;

static uint64_t random_state = 0x9E3779B97F4A7C15u;

static double random_between(double low, double high) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return low + (high - low) * (double)(random_state >> 11) / 9007199254740992.0;
}

/* The distance of the arm, of two bodies, and the number of witnesses at the i-th configuration. */
static answer ask(const scene *s, cstk_query *query, int i) {
    cstk_distance_result d;
    cstk_distance_result pair;
    cstk_witness_list list;
    const double *q = s->q[i];
    answer a;
    memset(&a, 0, sizeof a);
    CHECK_OK(cstk_distance(query, s->all, q, FIXTURE_NQ, INFINITY, &d));
    CHECK_OK(cstk_pair_distance(query, s->f.body, s->poses[i], s->f.body, identity_pose, INFINITY,
                                &pair));
    CHECK_OK(cstk_gradients(query, s->all, q, FIXTURE_NQ, 1.5, 5, &list));
    CHECK(d.kind == CSTK_DISTANCE_EXACT && d.has_witness);
    const double numbers[9] = {d.distance,   d.lower,      d.upper,      d.r_point[0], d.r_point[1],
                               d.r_point[2], d.s_point[0], d.s_point[1], d.s_point[2]};
    memcpy(a.numbers, numbers, sizeof numbers);
    a.counts[0] = d.witness.s_object;
    a.counts[1] = d.witness.r_link;
    a.counts[2] = list.witness_count;
    a.counts[3] = list.contact_count;
    memcpy(&a.counts[4], &pair.distance, sizeof pair.distance);
    if (list.contact_count > 0) {
        memcpy(&a.counts[5], list.gradients, sizeof(double));
    }
    return a;
}

static void scene_create(scene *s) {
    fixture_create(&s->f);
    for (int i = 0; i < 12; ++i) {
        const double angle = 0.5 * i;
        add_object(s->f.environment, s->f.body, 3.2 * cos(angle), 3.2 * sin(angle), 0.1 * (i % 3));
    }
    CHECK_OK(cstk_cobject_induced(s->f.space, NULL, 0, s->f.environment, NULL, 0, NULL, &s->all));
    for (int i = 0; i < QUERIES; ++i) {
        double placement[6];
        for (int k = 0; k < 6; ++k) {
            placement[k] = random_between(-2.0, 2.0);
        }
        CHECK_OK(cstk_pose_from_euler(placement, s->poses[i]));
        for (int k = 0; k < FIXTURE_NQ; ++k) {
            s->q[i][k] = random_between(-3.1, 3.1);
        }
    }
    for (int i = 0; i < QUERIES; ++i) {
        s->expected[i] = ask(s, s->f.query, i);
    }
}

typedef struct worker {
    pthread_t thread;
    scene *s;
    int number;
    cstk_query *query;
    int failures;
    int answered;
    int busy;
} worker;

static void run(worker *workers, int count, void *(*work)(void *)) {
    for (int i = 0; i < count; ++i) {
        CHECK(pthread_create(&workers[i].thread, NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < count; ++i) {
        CHECK(pthread_join(workers[i].thread, NULL) == 0);
    }
}

/* Each thread begins elsewhere, so that their caches differ. */
static void *compare(void *user) {
    worker *w = user;
    cstk_query *query = NULL;
    CHECK_OK(cstk_query_create(&query));
    for (int n = 0; n < QUERIES; ++n) {
        const int i = (n + w->number * QUERIES / THREADS) % QUERIES;
        const answer a = ask(w->s, query, i);
        w->failures += memcmp(&a, &w->s->expected[i], sizeof a) != 0;
    }
    CHECK_OK(cstk_query_release(query));
    return NULL;
}

static void same_answers(scene *s) {
    worker workers[THREADS];
    memset(workers, 0, sizeof workers);
    for (int i = 0; i < THREADS; ++i) {
        workers[i].s = s;
        workers[i].number = i;
    }
    run(workers, THREADS, compare);
    for (int i = 0; i < THREADS; ++i) {
        CHECK(workers[i].failures == 0);
    }
}

/* Goes on until it was answered often enough. */
static void *contend(void *user) {
    worker *w = user;
    while (w->answered < QUERIES) {
        cstk_distance_result d;
        const int i = w->answered;
        const cstk_status status =
            cstk_distance(w->query, w->s->all, w->s->q[i], FIXTURE_NQ, INFINITY, &d);
        if (status == CSTK_OK) {
            ++w->answered;
            w->failures += memcmp(&d.distance, w->s->expected[i].numbers, sizeof d.distance) != 0;
        } else {
            ++w->busy;
            w->failures += status != CSTK_ERROR_BUSY || !strstr(cstk_last_error_message(), "query");
            sched_yield();
        }
    }
    return NULL;
}

/* Whether the two collide depends on the machine's mood; that they are answered rightly does not.
 */
static void one_query_for_two(scene *s) {
    worker workers[2];
    memset(workers, 0, sizeof workers);
    for (int i = 0; i < 2; ++i) {
        workers[i].s = s;
        workers[i].query = s->f.query;
    }
    run(workers, 2, contend);
    CHECK(workers[0].failures == 0 && workers[1].failures == 0);
    printf("one query for two threads: %d times busy\n", workers[0].busy + workers[1].busy);
}

/* Messages belong to the thread whose call failed, while others fail for other reasons. */
static void *fail_on(void *user) {
    worker *w = user;
    double pose[12];
    const double here[6] = {0};
    CHECK(cstk_last_error_message()[0] == '\0');
    for (int n = 0; n < QUERIES; ++n) {
        if (w->number % 2 == 0) {
            w->failures += cstk_pose_from_euler(NULL, pose) != CSTK_ERROR_NULL_ARGUMENT;
        } else {
            w->failures += cstk_pose_from_euler(here, NULL) != CSTK_ERROR_NULL_ARGUMENT;
        }
        sched_yield();
        const char *expected = w->number % 2 == 0 ? "xyz_ypr is NULL" : "pose is NULL";
        w->failures += strcmp(cstk_last_error_message(), expected) != 0;
    }
    return NULL;
}

static void own_messages(void) {
    worker workers[4];
    memset(workers, 0, sizeof workers);
    for (int i = 0; i < 4; ++i) {
        workers[i].number = i;
    }
    run(workers, 4, fail_on);
    for (int i = 0; i < 4; ++i) {
        CHECK(workers[i].failures == 0);
    }
}

/* Two boxes go back and forth together: near and far never mix. */
typedef struct moving {
    scene *s;
    cstk_environment *environment;
    cstk_cobject *cobject;
    uint64_t ids[2];
    double expected[2];
    int stop;
    pthread_mutex_t lock;
} moving;

static void place_boxes(moving *m, int state) {
    cstk_environment_change changes[2];
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(cstk_environment_change_default(&changes[i], sizeof changes[i]));
        changes[i].kind = CSTK_CHANGE_MOVE;
        changes[i].id = m->ids[i];
        /* One is near in either state; in a mixture both would be near, or none. */
        translation(state == i ? 3.5 + i : 20.0, 0, 0, changes[i].pose);
    }
    CHECK_OK(cstk_environment_apply(m->environment, changes, 2, NULL, NULL));
}

static int is_over(moving *m) {
    CHECK(pthread_mutex_lock(&m->lock) == 0);
    const int over = m->stop;
    CHECK(pthread_mutex_unlock(&m->lock) == 0);
    return over;
}

static void *change_places(void *user) {
    moving *m = user;
    for (int n = 0; !is_over(m); ++n) {
        place_boxes(m, n % 2);
        sched_yield();
    }
    return NULL;
}

typedef struct watcher {
    pthread_t thread;
    moving *m;
    int seen[2];
    int neither;
} watcher;

static void *watch(void *user) {
    watcher *w = user;
    cstk_query *query = NULL;
    const double q[FIXTURE_NQ] = {0};
    uint64_t version = 0;
    CHECK_OK(cstk_query_create(&query));
    /* Ends when both states were seen often, or else after very long. */
    for (int n = 0; n < 1000000 && (w->seen[0] < 200 || w->seen[1] < 200); ++n) {
        cstk_distance_result d;
        CHECK_OK(cstk_distance(query, w->m->cobject, q, FIXTURE_NQ, INFINITY, &d));
        const int first = memcmp(&d.distance, &w->m->expected[0], sizeof(double)) == 0;
        const int second = memcmp(&d.distance, &w->m->expected[1], sizeof(double)) == 0;
        w->seen[0] += first;
        w->seen[1] += second;
        /* Even versions are the one state, odd ones the other; time does not run backwards. */
        w->neither += first == second || d.environment_version < version;
        w->neither += first != (int)(d.environment_version % 2);
        version = d.environment_version;
        sched_yield();
    }
    CHECK_OK(cstk_query_release(query));
    return NULL;
}

static double distance_now(const moving *m) {
    const double q[FIXTURE_NQ] = {0};
    cstk_distance_result d;
    CHECK_OK(cstk_distance(m->s->f.query, m->cobject, q, FIXTURE_NQ, INFINITY, &d));
    return d.distance;
}

static void changing_environment(scene *s) {
    moving m = {s, NULL, NULL, {0, 0}, {0, 0}, 0, PTHREAD_MUTEX_INITIALIZER};
    watcher watchers[4];
    pthread_t changer;
    memset(watchers, 0, sizeof watchers);
    CHECK_OK(cstk_environment_create(&m.environment));
    m.ids[0] = add_object(m.environment, s->f.body, 20, 0, 0);
    m.ids[1] = add_object(m.environment, s->f.body, 20, 0, 0);
    CHECK_OK(cstk_cobject_induced(s->f.space, NULL, 0, m.environment, NULL, 0, NULL, &m.cobject));
    for (int state = 0; state < 2; ++state) {
        place_boxes(&m, state);
        m.expected[state] = distance_now(&m);
    }
    CHECK(m.expected[0] > 0.0 && m.expected[0] < m.expected[1] && m.expected[1] < 10.0);
    for (int i = 0; i < 4; ++i) {
        watchers[i].m = &m;
        CHECK(pthread_create(&watchers[i].thread, NULL, watch, &watchers[i]) == 0);
    }
    CHECK(pthread_create(&changer, NULL, change_places, &m) == 0);
    for (int i = 0; i < 4; ++i) {
        CHECK(pthread_join(watchers[i].thread, NULL) == 0);
        CHECK(watchers[i].neither == 0);
        CHECK(watchers[i].seen[0] >= 200 && watchers[i].seen[1] >= 200);
    }
    CHECK(pthread_mutex_lock(&m.lock) == 0);
    m.stop = 1;
    CHECK(pthread_mutex_unlock(&m.lock) == 0);
    CHECK(pthread_join(changer, NULL) == 0);
    CHECK_OK(cstk_cobject_release(m.cobject));
    CHECK_OK(cstk_environment_release(m.environment));
}

int main(void) {
    static scene s;
    scene_create(&s);
    same_answers(&s);
    one_query_for_two(&s);
    own_messages();
    changing_environment(&s);
    CHECK_OK(cstk_cobject_release(s.all));
    fixture_release(&s.f);
    return check_result();
}
