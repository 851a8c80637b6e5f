/* Building on several threads, what the progress function hears, and stopping at each of its calls.
 */
#include <pthread.h>

#include "bodies.h"
#include "check.h"

enum { COUNTS = 5 };

/* A tree large enough to be shared out is the same from any number of threads. */
static void threads(void) {
    const uint32_t counts[COUNTS] = {1, 0, 2, 7, 1024};
    cstk_body_builder *builder = torus_builder(40, 20);
    for (int32_t grouping = 0; grouping < GROUPINGS; ++grouping) {
        tree trees[COUNTS];
        for (int i = 0; i < COUNTS; ++i) {
            cstk_hierarchy_options options = options_of(grouping, CSTK_WRAPPER_HULL);
            options.threads = counts[i];
            cstk_body *body = build_body(builder, &options);
            trees[i] = read_tree(body);
            CHECK_OK(cstk_body_release(body));
            CHECK(trees[i].count == 2 * 800 - 1 && same_trees(&trees[0], &trees[i]));
        }
        for (int i = 0; i < COUNTS; ++i) {
            free_tree(&trees[i]);
        }
    }
    CHECK_OK(cstk_body_builder_release(builder));
}

typedef struct listener {
    pthread_t caller;
    int calls;
    int stop_at;
    double last;
} listener;

static int32_t listen(double fraction, void *user) {
    listener *heard = user;
    CHECK(pthread_equal(pthread_self(), heard->caller));
    CHECK(fraction >= heard->last && fraction <= 1.0);
    heard->last = fraction;
    return heard->calls++ == heard->stop_at ? 17 : 0;
}

static void progress(void) {
    cstk_body_builder *builder = torus_builder(40, 20);
    for (int32_t k = 0; k < 2 * GROUPINGS; ++k) {
        cstk_hierarchy_options options = options_of(k % GROUPINGS, CSTK_WRAPPER_ALIGNED_BOX);
        options.threads = k < GROUPINGS ? 1 : 3;
        listener all = {pthread_self(), 0, -1, 0.0};
        cstk_body *body = NULL;
        CHECK_OK(cstk_body_build(builder, &options, listen, &all, &body));
        CHECK(all.calls >= 3 && all.last == 1.0);
        tree whole = read_tree(body);
        CHECK_OK(cstk_body_release(body));
        /* Stopped at each call; with several threads there may be fewer calls another time. */
        for (int stop = 0; stop < all.calls; ++stop) {
            listener some = {pthread_self(), 0, stop, 0.0};
            if (options.threads == 1) {
                CHECK_REFUSED(body, cstk_body_build(builder, &options, listen, &some, &body),
                              CSTK_ERROR_CANCELLED, "progress");
                CHECK(some.calls == stop + 1);
                continue;
            }
            const cstk_status status = cstk_body_build(builder, &options, listen, &some, &body);
            CHECK(status == (some.calls > stop ? CSTK_ERROR_CANCELLED : CSTK_OK));
            if (status == CSTK_OK) {
                CHECK_OK(cstk_body_release(body));
            }
        }
        body = build_body(builder, &options);
        tree again = read_tree(body);
        CHECK(same_trees(&whole, &again));
        free_tree(&whole);
        free_tree(&again);
        CHECK_OK(cstk_body_release(body));
    }
    CHECK_OK(cstk_body_builder_release(builder));
}

/* On a thread of its own, because the one that begins several threads is remembered until it ends.
 */
static void *everything(void *unused) {
    (void)unused;
    threads();
    progress();
    return NULL;
}

int main(void) {
    pthread_t thread;
    CHECK(pthread_create(&thread, NULL, everything, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
    return check_result();
}
