// One step of all plants: light, particles, vigour, then the internodes of each shoot one after the
// other (propose, claim, commit, sprout), then waking and shedding (Beneš, Andrysco, Šťava 2009,
// section 3.2, with its random order of buds replaced by claims that know no order).
#include "growth/climbing.h"
#include "growth/propose.h"

/// What has been settled becomes wood.
static void commit(FrGrowth *growth, const FrProposal *proposal) {
    FrGrownPlant *plant = &growth->plants[proposal->plant];
    FrLiveBud *bud = &plant->buds[proposal->bud];
    if (proposal->state != FR_PROPOSAL_WON) {
        plant->collisions++;
        plant->contested += proposal->state == FR_PROPOSAL_LOST;
        plant->axes[bud->axis].is_growing = false;
        bud->state = FR_LIVE_DONE;
        return;
    }
    const FrReadySpecies *species = fr_species_of(growth, plant);
    uint32_t node = fr_grown_add_node(plant, bud->node, bud->axis, proposal->at);
    plant->nodes.birth[node] = (uint16_t)MIN(growth->step, UINT16_MAX);
    plant->nodes.light[node] = (uint8_t)(bud->light * 255);
    plant->max_order = MAX(plant->max_order, plant->axes[bud->axis].order);
    plant->born++;
    bud->node = node;
    if (species->params.fate == FR_FATE_COLONIZE) {
        bud->state = FR_LIVE_DONE; // the next step tells where it goes on
        return;
    }
    fr_growth_turn(bud, proposal->direction, (float)species->params.twist);
    if (fr_species_climbs(&species->params) && !fr_climb_note(growth, plant, bud)) {
        plant->axes[bud->axis].is_growing = false;
        bud->state = FR_LIVE_DONE;
        return;
    }
    fr_growth_sprout(growth, plant, proposal->bud, node);
}

/// Proposals stand plant by plant.
static void commit_plants(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrGrowth *growth = data;
    for (size_t p = begin; p < end; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t i = 0; i < plant->proposal_count; i++) {
            commit(growth, &growth->proposals[plant->first_proposal + i]);
        }
    }
}

static void begin_plants(void *data, size_t begin, size_t end, int worker) {
    FrGrowth *growth = data;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        plant->born = plant->shed = plant->collisions = plant->contested = 0;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            FrLiveBud *bud = &plant->buds[b];
            if (bud->is_reached) { // the published rule: dies with the particle
                bud->state = FR_LIVE_DONE;
                plant->axes[bud->axis].is_growing = false;
            }
            bud->is_reached = 0;
        }
        if (!fr_growth_starve(growth, plant, worker)) {
            fr_growth_fates(growth, plant, worker);
        }
    }
}

static void end_plants(void *data, size_t begin, size_t end, int worker) {
    FrGrowth *growth = data;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        fr_growth_wake(growth, plant, &growth->scratch[worker]);
        uint32_t left = 0;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            if (plant->buds[b].state != FR_LIVE_DONE) {
                plant->buds[left++] = plant->buds[b];
            }
        }
        plant->bud_count = left;
        fr_growth_shed(growth, plant, worker);
    }
}

static void room_for_workers(FrGrowth *growth, const FrContext *context) {
    int threads = fr_pool_threads(context->pool);
    if (threads > growth->scratch_count) {
        growth->scratch = g_renew(FrScratch, growth->scratch, threads);
        growth->drop_scratch = g_renew(FrScratch, growth->drop_scratch, threads);
        growth->fallen = g_renew(GArray *, growth->fallen, threads);
        for (; growth->scratch_count < threads; growth->scratch_count++) {
            growth->scratch[growth->scratch_count] = (FrScratch){0};
            growth->drop_scratch[growth->scratch_count] = (FrScratch){0};
            growth->fallen[growth->scratch_count] = g_array_new(FALSE, FALSE, sizeof(vec3s));
        }
    }
}

static void make_shoots(FrGrowth *growth, const FrContext *context) {
    bool goes_on = true;
    for (uint32_t internode = 0; goes_on; internode++) {
        uint32_t count = fr_growth_gather_proposals(growth, internode, &goes_on, context);
        fr_growth_settle(growth, growth->open, count, context);
        fr_parallel_for(context->pool, growth->plant_count, 1, commit_plants, growth, NULL);
    }
}

/// Keeps the state of before the step; NULL: none.
static void remember(FrGrowth *growth, GBytes *before) {
    if (before != NULL) {
        g_ptr_array_add(growth->history, before);
    }
    if (growth->history->len > growth->params.history) {
        g_ptr_array_remove_index(growth->history, 0);
        growth->older_states -= growth->older_states > 0;
    }
}

/// Takes up a state of its own, and releases it.
static void return_to(FrGrowth *growth, GBytes *state) {
    gsize size;
    const void *data = g_bytes_get_data(state, &size);
    FrContext context = fr_context_default();
    FrStatus status = fr_growth_restore(growth, data, size, (FrSpan){0}, &context);
    FR_ASSERT(status == FR_OK);
    g_bytes_unref(state);
}

bool fr_growth_undo(FrGrowth *growth) {
    if (growth->history->len == 0) {
        return false;
    }
    return_to(growth, g_ptr_array_steal_index(growth->history, growth->history->len - 1));
    if (growth->history->len < growth->older_states) {
        growth->older_states = growth->history->len;
        growth->is_world_new = true;
    }
    return true;
}

/// More than this a step cannot make, and what there is fits.
static FrStatus check_limits(const FrGrowth *growth, const FrContext *context) {
    uint64_t bytes =
        fr_count_add(growth->voxels->bytes, fr_stems_bytes(fr_stems_count(growth->bark)));
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        const FrReadySpecies *species = fr_species_of(growth, plant);
        bool by_vigour =
            species->params.fate == FR_FATE_FLUX || species->params.fate == FR_FATE_PRIORITY;
        uint64_t most = by_vigour ? (uint64_t)species->params.shoot : 1;
        uint64_t wanted =
            fr_count_add(plant->nodes.count, fr_count_multiply(plant->bud_count, most));
        FrStatus status = fr_limit_check(wanted, context->limits.nodes, "nodes", species->name,
                                         (FrSpan){0}, context->diags);
        if (status != FR_OK) {
            return status;
        }
        bytes = fr_count_add(bytes, fr_grown_bytes(plant));
    }
    FrStatus status = fr_limit_check(bytes, context->limits.bytes, "bytes", "the growth",
                                     (FrSpan){0}, context->diags);
    if (status != FR_OK) {
        return status;
    }
    return fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
}

FrStatus fr_growth_step(FrGrowth *growth, const FrContext *context) {
    FrStatus status = check_limits(growth, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 begin = g_get_monotonic_time();
    room_for_workers(growth, context);
    bool sows = fr_growth_has_waiting(growth);
    GBytes *before = sows || growth->params.history > 0 ? fr_growth_save(growth) : NULL;
    growth->step++;
    if (sows) {
        status = fr_growth_sow_waiting(growth, context);
    }
    if (status == FR_OK) {
        status = fr_growth_sense(growth, context);
    }
    if (status != FR_OK) {
        growth->step--;
        if (sows) {
            return_to(growth, g_steal_pointer(&before));
        }
        g_clear_pointer(&before, g_bytes_unref);
        return status;
    }
    remember(growth, before);
    fr_parallel_for(context->pool, growth->plant_count, 1, begin_plants, growth, NULL);
    make_shoots(growth, context);
    fr_growth_reach_particles(growth, context);
    fr_parallel_for(context->pool, growth->plant_count, 1, end_plants, growth, NULL);
    fr_growth_find_bark(growth, context);
    fr_growth_carry(growth, context);
    fr_growth_recast(growth, context);
    growth->seconds = (double)(g_get_monotonic_time() - begin) * 1e-6;
    return FR_OK;
}
