/// Saved states of a simulation: a head that says what they belong to, what grows bud by bud, the
/// L-systems that grow beside it, and what has been told of the steps.
#include "scene/simulation.h"

#include <string.h>

#define KIND "FrondGrown"
#define MAGIC KIND "3"

/// What stands at the beginning.
typedef struct Head {
    char magic[16], version[16];
    FrDigest belongs; ///< to a document, a seed, and what stands in its scene
    FrDigest content; ///< of all that follows
    uint64_t growth_size, growing_size, step_count;
} Head;

static Head head_of(const FrSimulation *simulation) {
    Head head = {.magic = MAGIC, .belongs = fr_ecosystem_digest(simulation->ecosystem)};
    g_strlcpy(head.version, FR_VERSION, sizeof head.version);
    return head;
}

/// True where anything grows step by step.
static bool has_steps(const FrSimulation *simulation) {
    return fr_simulation_is_growing(simulation) || fr_growing_is_any(simulation->growing);
}

#define NOTHING_GROWS "no plant of this scene grows step by step"

GBytes *fr_simulation_save(const FrSimulation *simulation, const FrContext *context) {
    if (!has_steps(simulation)) {
        fr_diags_add(context->diags, FR_ERROR, "not-savable",
                     fr_document_span(simulation->document), NOTHING_GROWS);
        return NULL;
    }
    Head head = head_of(simulation);
    GByteArray *out = g_byte_array_new();
    g_byte_array_append(out, (const guint8 *)&head, sizeof head);
    if (fr_simulation_is_growing(simulation)) {
        GBytes *growth = fr_growth_save(fr_simulation_growth(simulation));
        gsize size;
        const void *data = g_bytes_get_data(growth, &size);
        g_byte_array_append(out, data, (guint)size);
        g_bytes_unref(growth);
    }
    head.growth_size = out->len - sizeof head;
    fr_growing_save(simulation->growing, out);
    head.growing_size = out->len - sizeof head - head.growth_size;
    const GArray *steps = simulation->scene->steps;
    head.step_count = steps->len;
    g_byte_array_append(out, (const guint8 *)steps->data,
                        (guint)(steps->len * sizeof(FrSceneStep)));
    head.content = fr_digest(0, out->data + sizeof head, out->len - sizeof head);
    memcpy(out->data, &head, sizeof head);
    return g_byte_array_free_to_bytes(out);
}

/// What is wrong with a saved state; NULL if nothing is.
static const char *fault_of(const FrSimulation *simulation, const void *bytes, size_t size,
                            const Head *head, const char **code) {
    Head own = head_of(simulation);
    *code = "not-a-checkpoint";
    if (size < sizeof *head || memcmp(head->magic, KIND, strlen(KIND)) != 0) {
        return "this is no saved growth";
    }
    *code = "other-version";
    if (memcmp(head->magic, own.magic, sizeof own.magic) != 0 ||
        memcmp(head->version, own.version, sizeof own.version) != 0) {
        return "another version of the program has saved this growth; only that version can go on "
               "with it, or grow it from the seeds again";
    }
    *code = "other-document";
    if (head->belongs != own.belongs) {
        return "this growth belongs to another document, or this one or its seed has changed "
               "since; undo the change, or grow it from the seeds again";
    }
    *code = "damaged-checkpoint";
    size_t rest = size - sizeof *head;
    bool has_size = head->growth_size <= rest && head->growing_size <= rest - head->growth_size;
    size_t told = has_size ? rest - head->growth_size - head->growing_size : 1;
    has_size = has_size && told / sizeof(FrSceneStep) == head->step_count &&
               told % sizeof(FrSceneStep) == 0;
    const char *data = (const char *)bytes + sizeof *head;
    if (!has_size || fr_digest(0, data, rest) != head->content) {
        return "this saved growth is damaged; grow it from the seeds again";
    }
    return NULL;
}

/// What grows bud by bud and the L-systems; both or none.
static FrStatus restore_parts(FrSimulation *simulation, const char *growth, size_t growth_size,
                              const char *growing, size_t growing_size, FrSpan span,
                              const FrContext *context) {
    FrGrowth *buds = fr_ecosystem_growth(simulation->ecosystem);
    if (buds == NULL) {
        return fr_growing_restore(simulation->growing, growing, growing_size, span, context);
    }
    GBytes *before = fr_growth_save(buds);
    FrStatus status = fr_growth_restore(buds, growth, growth_size, span, context);
    if (status == FR_OK) {
        status = fr_growing_restore(simulation->growing, growing, growing_size, span, context);
        if (status != FR_OK) {
            gsize size;
            const void *data = g_bytes_get_data(before, &size);
            FrStatus back = fr_growth_restore(buds, data, size, span, context);
            FR_ASSERT(back == FR_OK);
        }
    }
    g_bytes_unref(before);
    return status;
}

FrStatus fr_simulation_restore(FrSimulation *simulation, const void *bytes, size_t size,
                               FrSpan span, const FrContext *context) {
    Head head = {0};
    memcpy(&head, bytes, MIN(size, sizeof head));
    const char *code = "not-savable", *fault = NOTHING_GROWS;
    if (has_steps(simulation)) {
        fault = fault_of(simulation, bytes, size, &head, &code);
    }
    if (fault != NULL) {
        fr_diags_add(context->diags, FR_ERROR, code, span, "%s", fault);
        return FR_ERR_DOCUMENT;
    }
    const char *growth = (const char *)bytes + sizeof head, *growing = growth + head.growth_size;
    FrStatus status = restore_parts(simulation, growth, head.growth_size, growing,
                                    head.growing_size, span, context);
    if (status == FR_OK) {
        GArray *steps = simulation->scene->steps;
        g_array_set_size(steps, 0);
        g_array_append_vals(steps, growing + head.growing_size, (guint)head.step_count);
        g_ptr_array_set_size(simulation->back, 0);
        status = fr_simulation_take_up(simulation, context);
    }
    return status;
}
