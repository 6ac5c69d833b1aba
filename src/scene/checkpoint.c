/// Saved states of a simulation: a head that says what they belong to, the growth, and what has
/// been told of its steps.
#include "scene/simulation.h"

#include <string.h>

#define MAGIC "FrondGrown"

/// What stands at the beginning.
typedef struct Head {
    char magic[16], version[16];
    FrDigest belongs; ///< to a document, a seed, and what stands in its scene
    FrDigest content; ///< of all that follows
    uint64_t growth_size, step_count;
} Head;

static Head head_of(const FrSimulation *simulation) {
    Head head = {.magic = MAGIC, .belongs = fr_ecosystem_digest(simulation->ecosystem)};
    g_strlcpy(head.version, FR_VERSION, sizeof head.version);
    return head;
}

GBytes *fr_simulation_save(const FrSimulation *simulation, const FrContext *context) {
    if (!fr_simulation_is_growing(simulation) || fr_growing_is_any(simulation->growing)) {
        fr_diags_add(context->diags, FR_ERROR, "not-savable",
                     fr_document_span(simulation->document), "%s",
                     fr_simulation_is_growing(simulation)
                         ? "L-systems that answer the light cannot be saved half grown"
                         : "no plant of this scene grows bud by bud");
        return NULL;
    }
    GBytes *growth = fr_growth_save(fr_simulation_growth(simulation));
    const GArray *steps = simulation->scene->steps;
    gsize size;
    const void *data = g_bytes_get_data(growth, &size);
    Head head = head_of(simulation);
    head.growth_size = size;
    head.step_count = steps->len;
    size_t told = steps->len * sizeof(FrSceneStep);
    head.content = fr_digest(fr_digest(0, data, size), steps->data, told);
    GByteArray *out = g_byte_array_sized_new((guint)(sizeof head + size + told));
    g_byte_array_append(out, (const guint8 *)&head, sizeof head);
    g_byte_array_append(out, data, (guint)size);
    g_byte_array_append(out, (const guint8 *)steps->data, (guint)told);
    g_bytes_unref(growth);
    return g_byte_array_free_to_bytes(out);
}

/// What is wrong with a saved state; NULL if nothing is.
static const char *fault_of(const FrSimulation *simulation, const void *bytes, size_t size,
                            const Head *head, const char **code) {
    Head own = head_of(simulation);
    *code = "not-a-checkpoint";
    if (size < sizeof *head || memcmp(head->magic, own.magic, sizeof own.magic) != 0) {
        return "this is no saved growth";
    }
    *code = "other-version";
    if (memcmp(head->version, own.version, sizeof own.version) != 0) {
        return "another version of the program has saved this growth";
    }
    *code = "other-document";
    if (head->belongs != own.belongs) {
        return "this growth belongs to another document, to another state of it, or to another "
               "seed";
    }
    *code = "damaged-checkpoint";
    size_t rest = size - sizeof *head;
    bool has_size = head->growth_size <= rest &&
                    (rest - head->growth_size) / sizeof(FrSceneStep) == head->step_count &&
                    (rest - head->growth_size) % sizeof(FrSceneStep) == 0;
    const char *data = (const char *)bytes + sizeof *head;
    if (!has_size || fr_digest(fr_digest(0, data, head->growth_size), data + head->growth_size,
                               rest - head->growth_size) != head->content) {
        return "this saved growth is damaged";
    }
    return NULL;
}

FrStatus fr_simulation_restore(FrSimulation *simulation, const void *bytes, size_t size,
                               FrSpan span, const FrContext *context) {
    Head head = {0};
    memcpy(&head, bytes, MIN(size, sizeof head));
    const char *code, *fault = "no plant of this scene grows bud by bud";
    if (fr_simulation_is_growing(simulation)) {
        fault = fault_of(simulation, bytes, size, &head, &code);
    } else {
        code = "not-savable";
    }
    if (fault != NULL) {
        fr_diags_add(context->diags, FR_ERROR, code, span, "%s", fault);
        return FR_ERR_DOCUMENT;
    }
    const char *data = (const char *)bytes + sizeof head;
    FrStatus status = fr_growth_restore(fr_ecosystem_growth(simulation->ecosystem), data,
                                        head.growth_size, span, context);
    if (status == FR_OK) {
        GArray *steps = simulation->scene->steps;
        g_array_set_size(steps, 0);
        g_array_append_vals(steps, data + head.growth_size, (guint)head.step_count);
        simulation->is_drawn = false;
    }
    return status;
}
