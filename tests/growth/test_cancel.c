/// Steps that are cancelled from another thread, whenever that may be.
#include "growing.h"

enum { PLANTS = 16, STEPS = 9, TRIES = 80 };

/// Waits for a while without a clock, then cancels.
typedef struct Hand {
    FrProgress *progress;
    int rounds;
    int turned; ///< atomic, so that waiting takes its time
} Hand;

static gpointer cancel(gpointer data) {
    Hand *hand = data;
    for (int i = 0; i < hand->rounds; i++) {
        g_atomic_int_inc(&hand->turned);
    }
    fr_progress_cancel(hand->progress);
    return NULL;
}

static void init(World *world, int64_t history) {
    world_init(world);
    world_set(world, "model", "open");
    world_set(world, "particles", "40");
    world->setup.params.history = history;
    FrSeed seeds[PLANTS];
    for (uint32_t i = 0; i < PLANTS; i++) {
        seeds[i] = (FrSeed){.id = i, .at = {0.7 * i, 0, 0}};
    }
    world_sow(world, seeds, PLANTS);
}

/// Tries a step that a hand cancels after so many rounds.
static FrStatus try_step(World *world, int rounds) {
    Hand hand = {.progress = fr_progress_new(NULL, NULL), .rounds = rounds};
    FrContext context = world->context;
    context.progress = hand.progress;
    GThread *thread = g_thread_new("hand", cancel, &hand);
    FrStatus status = fr_growth_step(world->growth, &context);
    g_thread_join(thread);
    fr_progress_free(hand.progress);
    return status;
}

/// Whatever comes of it, a cancelled step has not been, and the next is as it would have been.
static void cancel_often(int64_t history) {
    FrDigest wanted[STEPS];
    World whole, world;
    init(&whole, 0);
    init(&world, history);
    for (int i = 0; i < STEPS; i++) {
        wanted[i] = world_step(&whole, 1).digest;
    }
    world_step(&world, STEPS - 1);
    for (int i = 0; i < TRIES; i++) {
        FrStatus status = try_step(&world, i * i * 25);
        FrGrowthStats stats = fr_growth_stats(world.growth);
        g_assert_true(status == FR_OK || status == FR_CANCELLED);
        g_assert_cmpuint(stats.step, ==, status == FR_OK ? STEPS : STEPS - 1);
        g_assert_cmpuint(stats.digest, ==, wanted[stats.step - 1]);
        if (status == FR_OK && history > 0) {
            g_assert_true(fr_growth_undo(world.growth));
        } else if (status == FR_OK) {
            break;
        }
    }
    if (fr_growth_step_count(world.growth) < STEPS) {
        g_assert_cmpuint(world_step(&world, 1).digest, ==, wanted[STEPS - 1]);
    }
    world_clear(&whole);
    world_clear(&world);
}

static void test_kept(void) {
    cancel_often(3);
}

static void test_not_kept(void) {
    cancel_often(0);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/cancel/a step has been or has not, whenever it is cancelled",
                    test_kept);
    g_test_add_func("/growth/cancel/so has one that cannot be taken back", test_not_kept);
    return g_test_run();
}
