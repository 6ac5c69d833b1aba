#include "studio/model/lstring.h"

#include "frond/document.h"
#include "scene/find.h"
#include "studio/model/outline.h"
#include "studio/model/values.h"

#include <string.h>

enum { MOST_BYTES = 16 * STUDIO_LSTRING_MOST }; // of modules; their text is three times that

// What a module drew: an internode or an organ of the plant.
typedef struct Part {
    uint32_t module, index;
    bool is_organ;
} Part;

struct StudioLstring {
    FrDocument *document;
    FrLderivation *derivation;
    uint64_t length;
    GString *text;    // NULL: it has too many modules
    GArray *begins;   // uint32_t: where each begins in the text, and its end
    GArray *marks;    // uint16_t: of what made each
    GArray *parts;    // Part, in the order of modules
    GArray *modules;  // uint32_t: by internode of the plant …
    GArray *carriers; // … and by organ
    FrDigest digest;  // of the plant
    GArray *matches;  // bool: by plant of the scene
};

// ---- making it ---------------------------------------------------------------------------------

static int64_t seed_of(const FrDocument *document, const FrPlantDef *plant) {
    const GPtrArray *places = fr_document_places(document);
    for (guint i = 0; i < places->len; i++) {
        const FrPlace *place = g_ptr_array_index(places, i);
        if (strcmp(place->plant, plant->id) == 0 && place->seed >= 0) {
            return (int64_t)place->seed;
        }
    }
    return plant->has_seed ? (int64_t)plant->seed : -1;
}

static void print(StudioLstring *string) {
    string->text = g_string_new(NULL);
    string->begins = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    string->marks = g_array_new(FALSE, FALSE, sizeof(uint16_t));
    FrLmodule module;
    uint32_t begin = 0;
    for (uint64_t at = 0;
         fr_lstring_next(fr_lderivation_string(string->derivation), &at, &module);) {
        g_array_append_val(string->begins, begin);
        g_array_append_val(string->marks, module.mark);
        fr_lmodule_print(&module, string->text);
        begin = (uint32_t)string->text->len;
    }
    g_array_append_val(string->begins, begin);
}

static int compare_parts(const void *a, const void *b) {
    const Part *left = a, *right = b;
    return left->module == right->module ? 0 : left->module < right->module ? -1 : 1;
}

static void add_part(StudioLstring *string, GArray *by_index, uint32_t index, bool is_organ) {
    FrLorigin origin;
    bool is_known = is_organ ? fr_lderivation_organ_origin(string->derivation, index, &origin)
                             : fr_lderivation_origin(string->derivation, index, &origin);
    uint32_t module = is_known ? (uint32_t)origin.module : FR_NONE;
    Part part = {module, index, is_organ};
    g_array_append_val(by_index, module);
    if (is_known) {
        g_array_append_val(string->parts, part);
    }
}

static FrStatus draw(StudioLstring *string, const char *name, const FrContext *context) {
    FrPlant *plant;
    FrStatus status = fr_lderivation_plant(string->derivation, context, &plant, NULL);
    if (status != FR_OK) {
        return status;
    }
    g_free(plant->name);
    plant->name = g_strdup(name);
    string->digest = fr_plant_digest(plant);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        add_part(string, string->modules, i, false);
    }
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        add_part(string, string->carriers, i, true);
    }
    g_array_sort(string->parts, compare_parts);
    fr_plant_free(plant);
    return FR_OK;
}

// How many steps the text asks for, whatever the document says.
static FrStatus ask_length(StudioLstring *string, const FrLmodel *model, FrLsettings settings,
                           const FrContext *context) {
    FrLderivation *derivation;
    settings.steps = -1;
    FrStatus status = fr_lmodel_derive(model, &settings, context, &derivation);
    if (status == FR_OK) {
        string->length = fr_lderivation_length(derivation);
        fr_lderivation_free(derivation);
    }
    return status;
}

static bool can_be_shown(const FrLstring *string) {
    return fr_lstring_count(string) <= STUDIO_LSTRING_MOST &&
           fr_lstring_bytes(string) <= MOST_BYTES;
}

static FrStatus derive(StudioLstring *string, const FrPlantDef *plant, const FrContext *context) {
    FrLsettings settings = fr_lmodel_settings(plant->lsystem);
    settings.seed = seed_of(string->document, plant);
    settings.keeps_origins = true;
    FrStatus status = ask_length(string, plant->lsystem, settings, context);
    if (status == FR_OK) {
        status = fr_lmodel_derive(plant->lsystem, &settings, context, &string->derivation);
    }
    if (status == FR_OK) {
        status = fr_lderivation_run(string->derivation, fr_lderivation_length(string->derivation),
                                    context);
    }
    if (status == FR_OK && can_be_shown(fr_lderivation_string(string->derivation))) {
        status = draw(string, plant->id, context); // it may answer what modules ask
        if (status == FR_OK) {
            print(string);
        }
    }
    return status;
}

FrStatus studio_lstring_new(FrSource *source, const char *folder, const char *plant,
                            const FrContext *context, StudioLstring **string) {
    StudioLstring *made = g_new0(StudioLstring, 1);
    made->parts = g_array_new(FALSE, FALSE, sizeof(Part));
    made->modules = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    made->carriers = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    made->matches = g_array_new(FALSE, TRUE, sizeof(bool));
    FrStatus status = fr_document_parse(source, folder, context, &made->document);
    if (status == FR_OK) {
        const FrPlantDef *definition = fr_scene_find_plant(made->document, plant);
        bool is_one = definition != NULL && definition->kind == FR_PLANT_LSYSTEM;
        status = is_one ? derive(made, definition, context) : FR_ERR_USAGE;
    }
    if (status != FR_OK) {
        studio_lstring_free(made);
        made = NULL;
    }
    *string = made;
    return status;
}

void studio_lstring_free(StudioLstring *string) {
    if (string == NULL) {
        return;
    }
    fr_lderivation_free(string->derivation);
    fr_document_free(string->document);
    if (string->text != NULL) {
        g_string_free(string->text, TRUE);
        g_array_unref(string->begins);
        g_array_unref(string->marks);
    }
    g_array_unref(string->parts);
    g_array_unref(string->modules);
    g_array_unref(string->carriers);
    g_array_unref(string->matches);
    g_free(string);
}

// ---- reading it --------------------------------------------------------------------------------

uint64_t studio_lstring_count(const StudioLstring *string) {
    return fr_lstring_count(fr_lderivation_string(string->derivation));
}

uint64_t studio_lstring_step(const StudioLstring *string) {
    return fr_lderivation_step(string->derivation);
}

uint64_t studio_lstring_length(const StudioLstring *string) {
    return string->length;
}

char *studio_lstring_words(const StudioLstring *string) {
    char *count = studio_count_words(studio_lstring_count(string), "module", "modules");
    uint64_t step = studio_lstring_step(string), length = string->length;
    char *of = step <= length ? g_strdup_printf(" of %" G_GUINT64_FORMAT, length)
               : length > 0
                   ? g_strdup_printf(", %" G_GUINT64_FORMAT " beyond the length", step - length)
                   : g_strdup(""); // the text gives none
    char *words = g_strdup_printf("Step %" G_GUINT64_FORMAT "%s · %s", step, of, count);
    g_free(of);
    g_free(count);
    return words;
}

bool studio_lstring_is_shown(const StudioLstring *string) {
    return string->text != NULL;
}

uint32_t studio_lstring_begin(const StudioLstring *string, uint32_t module) {
    return g_array_index(string->begins, uint32_t, MIN(module, string->begins->len - 1));
}

const char *studio_lstring_text(const StudioLstring *string, uint32_t first, uint32_t end,
                                size_t *size) {
    uint32_t begin = studio_lstring_begin(string, first);
    *size = studio_lstring_begin(string, end) - begin;
    return string->text->str + begin;
}

uint32_t studio_lstring_at(const StudioLstring *string, uint32_t byte) {
    uint32_t low = 0, high = string->begins->len - 1; // begins[low] <= byte < begins[high]
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (studio_lstring_begin(string, middle) <= byte) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static char symbol_of(const StudioLstring *string, uint32_t module) {
    return string->text->str[studio_lstring_begin(string, module)];
}

uint32_t studio_lstring_end_of(const StudioLstring *string, uint32_t module) {
    uint32_t count = string->marks->len, depth = 0;
    char open = symbol_of(string, module);
    char close = open == '[' ? ']' : open == '{' ? '}' : '\0';
    for (uint32_t i = module; close != '\0' && i < count; i++) {
        char symbol = symbol_of(string, i);
        depth += symbol == open;
        depth -= symbol == close;
        if (depth == 0) {
            return i + 1;
        }
    }
    return close == '\0' ? module + 1 : count;
}

const char *studio_lstring_maker(const StudioLstring *string, uint32_t module, FrSpan *span) {
    uint16_t mark = g_array_index(string->marks, uint16_t, module);
    const char *name = fr_lderivation_maker(string->derivation, mark, span);
    *span = fr_span_outermost(*span);
    return name;
}

// ---- in the scene ------------------------------------------------------------------------------

bool studio_lstring_match(StudioLstring *string, const FrScene *scene) {
    bool is_any = false;
    g_array_set_size(string->matches, 0);
    for (guint i = 0; scene != NULL && string->text != NULL && i < scene->plants->len; i++) {
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        bool is_it = plant->nodes.count == string->modules->len &&
                     plant->organs.count == string->carriers->len &&
                     fr_plant_digest(plant) == string->digest;
        g_array_append_val(string->matches, is_it);
        is_any = is_any || is_it;
    }
    return is_any;
}

static bool is_match(const StudioLstring *string, uint32_t plant) {
    return plant < string->matches->len && g_array_index(string->matches, bool, plant);
}

uint32_t studio_lstring_pick(const StudioLstring *string, const FrScene *scene,
                             const double origin[3], const double direction[3], double spread) {
    FrPick pick;
    if (scene == NULL || !fr_scene_pick(scene, origin, direction, spread, &pick) ||
        !is_match(string, pick.plant)) {
        return FR_NONE;
    }
    return pick.organ != FR_NONE ? g_array_index(string->carriers, uint32_t, pick.organ)
                                 : g_array_index(string->modules, uint32_t, pick.node);
}

// The first part of a module or of one behind it.
static uint32_t first_part(const StudioLstring *string, uint32_t module) {
    uint32_t low = 0, high = string->parts->len;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (g_array_index(string->parts, Part, middle).module < module) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

GArray *studio_lstring_lines(const StudioLstring *string, const FrScene *scene, uint32_t first,
                             uint32_t end) {
    GArray *lines = g_array_new(FALSE, FALSE, 3 * sizeof(float));
    uint32_t from = first_part(string, first), to = first_part(string, end);
    for (uint32_t s = 0; scene != NULL && s < scene->stands->len; s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        if (!is_match(string, stand->plant)) {
            continue;
        }
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        for (uint32_t i = from; i < to; i++) {
            const Part *part = &g_array_index(string->parts, Part, i);
            if (part->is_organ) {
                studio_outline_organ(lines, stand, plant, part->index);
            } else {
                studio_outline_node(lines, stand, plant, part->index);
            }
        }
    }
    return lines;
}
