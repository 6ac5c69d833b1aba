/// `<species>` of a plant, and `<growth>` of a scene with its `<particles>`.
#include "document/reader.h"

#include "frond/voxels.h"

#include <math.h>
#include <string.h>

#define FR_PARAM_STRUCT FrParticlesDef
static const FrParam particles_rows[] = {FR_PARTICLES_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

const FrParamTable *fr_particles_table(void) {
    static const FrParamTable table = {.element = "particles",
                                       .meaning = "particles that draw buds, strewn by hand",
                                       .rows = particles_rows,
                                       .count = G_N_ELEMENTS(particles_rows),
                                       .struct_size = sizeof(FrParticlesDef)};
    return &table;
}

// ---- species ----------------------------------------------------------------------------------

/// A shipped species is where the attributes start from.
static void read_preset(FrReader *reader, uint32_t node, FrSpeciesDef *species) {
    const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, node, "preset");
    if (attribute == NULL) {
        return;
    }
    char *name = fr_xml_decode(reader->tree, attribute->value, true);
    if (*name != '\0' && !fr_species_preset(name, &species->params)) {
        const char *const *names = fr_species_presets();
        char *hint = fr_read_hint(reader, name, names, g_strv_length((char **)names));
        char *all = *hint == '\0' ? g_strjoinv(", ", (char **)names) : NULL;
        fr_read_error(reader, "unknown-species", attribute->value,
                      "no species '%.64s' ships with the program%s%s%s", name, hint,
                      all != NULL ? "; there are: " : "", all != NULL ? all : "");
        g_free(all);
        g_free(hint);
    }
    g_free(name);
}

/// Rows that replace those of the model, which they start from.
static void read_orders(FrReader *reader, uint32_t node, FrSpeciesDef *species) {
    FrOrderParams model[FR_MAX_ORDERS];
    bool is_open = species->params.model == FR_MODEL_OPEN;
    uint32_t rows = is_open ? 0 : fr_species_model(species->params.model, model);
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_ORDER); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_ORDER)) {
        fr_read_check_children(reader, child, FR_ELEMENT_ORDER);
        if (species->order_count == FR_MAX_ORDERS) {
            fr_read_error(reader, "too-many-orders", reader->tree->nodes[child].name,
                          "a species has %d orders at most; the last is that of all further ones",
                          FR_MAX_ORDERS);
            return;
        }
        FrOrderParams *order = &species->orders[species->order_count];
        if (rows > 0) {
            *order = model[MIN(species->order_count, rows - 1)];
        } else {
            fr_params_init(fr_order_table(), order);
        }
        fr_read_attributes(reader, child, FR_ELEMENT_ORDER, order);
        species->order_count++;
    }
}

static void read_envelope(FrReader *reader, uint32_t node, FrSpeciesDef *species) {
    const char *file = species->params.envelope_file;
    if (file == NULL || *file == '\0' || reader->context == NULL) {
        return;
    }
    FrXmlRange place = fr_read_value_place(reader, node, "envelope-file");
    FrStatus status = FR_OK;
    species->envelope = fr_mesh_file_load(
        reader->document->folder, file, fr_xml_span(reader->tree, place), reader->context, &status);
    fr_read_note(reader, status);
    if (species->envelope != NULL && !species->envelope->is_closed) {
        fr_read_error(reader, "open-envelope", place, "'%s' has no inside: it is not closed", file);
    }
}

/// An outline has a height, and no radius below 0.
static void check_envelope(FrReader *reader, uint32_t node, const FrPoints *outline) {
    double low = INFINITY, high = -INFINITY, least = INFINITY;
    for (size_t i = 0; i < outline->count; i++) {
        least = fmin(least, outline->at[i][0]);
        low = fmin(low, outline->at[i][1]);
        high = fmax(high, outline->at[i][1]);
    }
    if (outline->count > 0 && !(least >= 0 && high > low)) {
        fr_read_error(reader, "bad-envelope", fr_read_value_place(reader, node, "envelope"),
                      "an envelope is two or more points radius,height: no radius below 0, and not "
                      "all at one height");
    }
}

/// The free space has a middle cell.
static void check_box(FrReader *reader, uint32_t node, const FrSpeciesParams *params) {
    if (params->box % 2 == 0) {
        fr_read_error(reader, "even-box", fr_read_value_place(reader, node, "box"),
                      "the free space around a tip is an odd number of cells wide, not %d",
                      (int)params->box);
    }
}

FrSpeciesDef *fr_read_species(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_SPECIES);
    FrSpeciesDef *species = g_new0(FrSpeciesDef, 1);
    species->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_params_init(fr_species_table(), &species->params);
    fr_params_init(fr_species_sliders_table(), &species->sliders);
    read_preset(reader, node, species);
    fr_read_attributes(reader, node, FR_ELEMENT_SPECIES, &species->params);
    check_envelope(reader, node, &species->params.envelope);
    check_box(reader, node, &species->params);
    species->bark = fr_read_material(reader, node, "bark", species->params.bark);
    species->leaf = fr_read_material(reader, node, "leaf", species->params.leaf);
    read_orders(reader, node, species);
    read_envelope(reader, node, species);
    uint32_t sliders = fr_read_first(reader, node, FR_ELEMENT_SLIDERS);
    if (sliders != FR_NONE) {
        fr_read_check_children(reader, sliders, FR_ELEMENT_SLIDERS);
        fr_read_attributes(reader, sliders, FR_ELEMENT_SLIDERS, &species->sliders);
    }
    return species;
}

void fr_species_def_free(FrSpeciesDef *species) {
    if (species != NULL) {
        fr_params_clear(fr_species_table(), &species->params);
        fr_mesh_file_unref(species->envelope);
        g_free(species);
    }
}

// ---- growth -----------------------------------------------------------------------------------

static void read_particles(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_PARTICLES);
    FrParticlesDef *particles = g_new0(FrParticlesDef, 1);
    fr_params_init(fr_particles_table(), particles);
    particles->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_PARTICLES, particles);
    g_ptr_array_add(reader->document->growth.particles, particles);
    if (particles->shape == FR_PARTICLES_BRUSH) {
        particles->along = fr_read_line(reader, node);
    } else {
        fr_read_check_no_line(reader, node, "only <particles> with shape='brush' have a text");
    }
    vec3s d = particles->direction;
    if (particles->shape == FR_PARTICLES_DIRECTION && d.x == 0 && d.y == 0 && d.z == 0) {
        fr_read_error(reader, "no-direction", fr_read_value_place(reader, node, "direction"),
                      "these particles lie in no direction");
    }
}

/// An arena has an inside, a world has an up.
static void check_growth(FrReader *reader, uint32_t node, const FrGrowthParams *params) {
    vec3s g = params->gravity;
    if (g.x == 0 && g.y == 0 && g.z == 0) {
        fr_read_error(reader, "no-direction", fr_read_value_place(reader, node, "gravity"),
                      "things fall in no direction");
    }
    for (int axis = 0; axis < 3; axis++) {
        double size = (double)params->max.raw[axis] - (double)params->min.raw[axis];
        bool is_wide = params->cell > 0 && size / params->cell >= FR_VOXELS_WIDTH;
        if (!(size > 0)) {
            fr_read_error(reader, "arena-cells", fr_read_value_place(reader, node, "max"),
                          "along %c the arena's max %g is not above its min %g", "xyz"[axis],
                          (double)params -> max.raw[axis], (double)params->min.raw[axis]);
            return;
        }
        if (is_wide) {
            fr_read_error(reader, "arena-cells", fr_read_value_place(reader, node, "max"),
                          "the arena is %g m wide, but must be below %d cells of %g m", size,
                          FR_VOXELS_WIDTH, params->cell);
            return;
        }
    }
}

void fr_read_growth(FrReader *reader, uint32_t scene) {
    uint32_t node = fr_read_first(reader, scene, FR_ELEMENT_GROWTH);
    if (node == FR_NONE) {
        return;
    }
    FrGrowthDef *growth = &reader->document->growth;
    fr_read_check_children(reader, node, FR_ELEMENT_GROWTH);
    growth->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_GROWTH, &growth->params);
    check_growth(reader, node, &growth->params);
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_PARTICLES); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_PARTICLES)) {
        read_particles(reader, child);
    }
}

static void free_particles(void *data) {
    FrParticlesDef *particles = data;
    fr_stroke_unref(particles->along);
    fr_params_clear(fr_particles_table(), particles);
    g_free(particles);
}

void fr_growth_def_init(FrGrowthDef *growth) {
    growth->params = fr_growth_default();
    growth->particles = g_ptr_array_new_with_free_func(free_particles);
}

void fr_growth_def_clear(FrGrowthDef *growth) {
    fr_params_clear(fr_growth_table(), &growth->params);
    g_ptr_array_unref(growth->particles);
}
