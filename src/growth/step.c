// One step of all plants: light, particles, vigour, then the internodes of each shoot one after the
// other (propose, claim, commit, sprout), then waking and shedding (Beneš, Andrysco, Šťava 2009,
// section 3.2, with its random order of buds replaced by claims that know no order).
#include "growth/propose.h"

#include <math.h>

static void note_owner(FrGrowth *growth, uint32_t plant, uint32_t axis) {
    FrGrownAxis *of = &growth->plants[plant].axes[axis];
    if (of->owner != FR_NONE) {
        return;
    }
    fr_growth_reserve_owners(growth, growth->owner_count + 1);
    of->owner = growth->owner_count;
    growth->owners[growth->owner_count++] = (FrOwner){plant, axis, of->bearer};
}

static void room_for_proposals(FrGrowth *growth, uint32_t count) {
    if (count > growth->proposal_capacity) {
        growth->proposal_capacity = count + count / 2;
        growth->proposals = g_renew(FrProposal, growth->proposals, growth->proposal_capacity);
        growth->by_rank = g_renew(uint32_t, growth->by_rank, growth->proposal_capacity);
        growth->other_rank = g_renew(uint32_t, growth->other_rank, growth->proposal_capacity);
        growth->open = g_renew(uint32_t, growth->open, growth->proposal_capacity);
        growth->sort_keys = g_renew(uint64_t, growth->sort_keys, growth->proposal_capacity);
        growth->cells =
            g_renew(FrCell, growth->cells, (size_t)growth->proposal_capacity * growth->cell_stride);
    }
}

static FrProposal proposal_of(const FrGrownPlant *plant, uint32_t index, uint32_t b) {
    const FrLiveBud *bud = &plant->buds[b];
    const FrGrownAxis *axis = &plant->axes[bud->axis];
    bool is_first = axis->internodes == 0 && bud->node != FR_NONE;
    return (FrProposal){.plant = index,
                        .bud = b,
                        .node = bud->node,
                        .own = axis->owner,
                        .branched_off =
                            is_first ? plant->axes[plant->nodes.axis[bud->node]].owner : FR_NONE};
}

/// Gathers a proposal for every shoot that has this internode still to make.
static uint32_t gather(FrGrowth *growth, uint32_t internode) {
    uint32_t count = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            count += plant->buds[b].state == FR_LIVE_GROWING && plant->buds[b].shoot > internode;
        }
    }
    room_for_proposals(growth, count);
    count = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        plant->first_proposal = count;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            const FrLiveBud *bud = &plant->buds[b];
            if (bud->state == FR_LIVE_GROWING && bud->shoot > internode) {
                growth->sort_keys[count] = fr_random_bits(bud->key, FR_CHANCE_CLAIM,
                                                          (uint32_t)growth->step * 64u + internode);
                growth->open[count] = count;
                note_owner(growth, p, bud->axis);
                growth->proposals[count] = proposal_of(plant, p, b);
                count++;
            }
        }
        plant->proposal_count = count - plant->first_proposal;
    }
    return count;
}

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

/// Gathers all live buds, the growing ones first. Returns how many grow.
static uint32_t gather_live(FrGrowth *growth, uint32_t *count) {
    *count = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        *count += growth->plants[p].bud_count;
    }
    if (*count > growth->live_capacity) {
        growth->live_capacity = *count + *count / 2;
        growth->live = g_renew(FrLiveBudAt, growth->live, growth->live_capacity);
    }
    uint32_t growing = 0, asleep = *count;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            FrLiveBud *bud = &plant->buds[b];
            uint32_t slot = bud->state == FR_LIVE_GROWING ? growing++ : --asleep;
            growth->live[slot] = (FrLiveBudAt){.bud = bud,
                                               .params = params,
                                               .world = fr_bud_world(plant, bud),
                                               .influence = (float)params->influence,
                                               .own_shade = sqrtf((float)params->foliage)};
        }
    }
    return growing;
}

static FrStatus sense(FrGrowth *growth, const FrContext *context) {
    fr_growth_colonize(growth, context);
    uint32_t count, growing = gather_live(growth, &count);
    gint64 begin = g_get_monotonic_time();
    FrStatus status = fr_growth_light(growth, growth->live, count, context);
    growth->light_seconds = (double)(g_get_monotonic_time() - begin) * 1e-6;
    fr_growth_attract(growth, growth->live, growing, context);
    fr_growth_compete(growth, growth->live, growing);
    return status;
}

static void make_shoots(FrGrowth *growth, const FrContext *context) {
    for (uint32_t internode = 0;; internode++) {
        uint32_t count = gather(growth, internode);
        if (count == 0) {
            return;
        }
        fr_growth_rank(growth, count);
        fr_growth_settle(growth, growth->open, count, context);
        fr_parallel_for(context->pool, growth->plant_count, 1, commit_plants, growth, NULL);
    }
}

/// Keeps the state of before the step.
static void remember(FrGrowth *growth) {
    if (growth->params.history == 0) {
        return;
    }
    g_ptr_array_add(growth->history, fr_growth_save(growth));
    if (growth->history->len > growth->params.history) {
        g_ptr_array_remove_index(growth->history, 0);
    }
}

bool fr_growth_undo(FrGrowth *growth) {
    if (growth->history->len == 0) {
        return false;
    }
    GBytes *bytes = g_ptr_array_steal_index(growth->history, growth->history->len - 1);
    gsize size;
    const void *data = g_bytes_get_data(bytes, &size);
    FrContext context = fr_context_default();
    FrStatus status = fr_growth_restore(growth, data, size, (FrSpan){0}, &context);
    FR_ASSERT(status == FR_OK);
    g_bytes_unref(bytes);
    return true;
}

/// More than this a step cannot make, and what there is fits.
static FrStatus check_limits(const FrGrowth *growth, const FrContext *context) {
    uint64_t bytes = growth->voxels->bytes;
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
    remember(growth);
    room_for_workers(growth, context);
    growth->step++;
    status = sense(growth, context);
    if (status != FR_OK) {
        growth->step--;
        return status;
    }
    fr_parallel_for(context->pool, growth->plant_count, 1, begin_plants, growth, NULL);
    make_shoots(growth, context);
    fr_growth_reach_particles(growth);
    fr_parallel_for(context->pool, growth->plant_count, 1, end_plants, growth, NULL);
    fr_growth_recast(growth, context);
    growth->seconds = (double)(g_get_monotonic_time() - begin) * 1e-6;
    return FR_OK;
}
