/// Species, growth and particles in documents.
#include "documents.h"

#include <math.h>

#define PLANT(inside) "<frond version='1'><plant id='p'>" inside "</plant></frond>"
#define SCENE(inside)                                                                              \
    "<frond version='1'><plant id='p'><species/></plant><scene>" inside "</scene></frond>"

static const FrSpeciesDef *species_of(const Parsed *parsed) {
    const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(parsed->document), 0);
    g_assert_cmpint(plant->kind, ==, FR_PLANT_SPECIES);
    return plant->species;
}

static void test_species(void) {
    Parsed parsed = parse(PLANT("<species preset='published' step='0.7' model='leeuwenberg'>"
                                "<order length='2'/><sliders twist='0.5'/></species>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrSpeciesDef *species = species_of(&parsed);
    g_assert_cmpfloat(species->params.step, ==, 0.7);          // given
    g_assert_cmpfloat(species->params.phototropism, ==, 0.01); // of the preset
    g_assert_cmpuint(species->order_count, ==, 1);
    FrOrderParams rows[FR_MAX_ORDERS];
    g_assert_cmpuint(fr_species_model(species->params.model, rows), >, 0);
    g_assert_cmpfloat(species->orders[0].length, ==, 2);            // given
    g_assert_cmpfloat(species->orders[0].angle, ==, rows[0].angle); // of the model
    g_assert_cmpfloat(species->sliders.twist, ==, 0.5);
    forget(&parsed);
}

/// E17: sliders are pure functions, and in the middle nothing changes.
static void test_sliders(void) {
    const FrParamTable *table = fr_species_sliders_table();
    FrSpeciesSliders sliders;
    FrSpecies plain = fr_species_default();
    fr_params_init(table, &sliders);
    FrSpeciesParams params = plain.params;
    fr_species_apply_sliders(&sliders, &params);
    g_assert_cmpint(memcmp(&params, &plain.params, sizeof params), ==, 0);
    for (size_t i = 0; i < table->count; i++) {
        double *value = (double *)(void *)((char *)&sliders + table->rows[i].offset);
        double ends[] = {table->rows[i].min, table->rows[i].max};
        for (int k = 0; k < 2; k++) {
            FrSpeciesParams once = plain.params, twice = plain.params;
            *value = ends[k];
            fr_species_apply_sliders(&sliders, &once);
            fr_species_apply_sliders(&sliders, &twice);
            g_assert_cmpint(memcmp(&once, &twice, sizeof once), ==, 0);
            g_assert_true(ends[k] == 0 || memcmp(&once, &plain.params, sizeof once) != 0);
            *value = 0;
        }
    }
    fr_params_clear(fr_species_table(), &plain.params);
}

static void test_world(void) {
    Parsed parsed = parse(SCENE("<growth steps='7' gravity='1,0,-1' history='3'>"
                                "<particles number='9' size='1,2,3'/>"
                                "<particles shape='brush'>0,0,1 0,0,3,0.5</particles></growth>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrGrowthDef *growth = fr_document_growth(parsed.document);
    g_assert_cmpint(growth->params.steps, ==, 7);
    g_assert_cmpfloat(growth->params.gravity.x, ==, 1);
    g_assert_cmpuint(growth->particles->len, ==, 2);
    const FrParticlesDef *brush = g_ptr_array_index(growth->particles, 1);
    g_assert_cmpfloat_with_epsilon(fr_stroke_length(brush->along), 2, 1e-6);
    FrContext context = fr_context_default();
    g_assert_cmpint(fr_document_set(parsed.document, "growth.steps", "9", &context), ==, FR_OK);
    g_assert_cmpint(fr_document_growth(parsed.document)->params.steps, ==, 9);
    g_assert_cmpint(fr_document_set(parsed.document, "scene.growth.steps", "8", &context), ==,
                    FR_OK);
    g_assert_cmpint(fr_document_growth(parsed.document)->params.steps, ==, 8);
    g_assert_cmpint(fr_document_set(parsed.document, "p.growth.steps", "6", &context), ==,
                    FR_ERR_USAGE);
    g_assert_cmpint(fr_document_set(parsed.document, "p.species.step", "0.5", &context), ==, FR_OK);
    g_assert_cmpfloat(species_of(&parsed)->params.step, ==, 0.5);
    forget(&parsed);
}

static void test_wrong(void) {
    static const struct {
        const char *text, *code;
    } rows[] = {
        {PLANT("<species preset='publshed'/>"), "unknown-species"},
        {PLANT("<species bark='oak'/>"), "unknown-material"},
        {PLANT("<species model='oak'/>"), "unknown-choice"},
        {PLANT("<species step='0'/>"), "out-of-range"},
        {PLANT("<species envelope='1,2 3'/>"), "bad-value"},
        {PLANT("<species envelope-file='none.obj'/>"), "missing-file"},
        {PLANT("<species envelope-file='../out.obj'/>"), "wrong-path"},
        {PLANT("<species/><pgraph><camera id='c'/></pgraph>"), "two-definitions"},
        {PLANT("<species/><species/>"), "repeated-element"},
        {PLANT("<species><sliders/><sliders/></species>"), "repeated-element"},
        {PLANT("<species><sliders light='2'/></species>"), "out-of-range"},
        {PLANT("<species model='open'><order/><order/><order/><order/><order/><order/><order/>"
               "<order/><order/></species>"),
         "too-many-orders"},
        {SCENE("<growth/><growth/>"), "repeated-element"},
        {SCENE("<growth gravity='0'/>"), "no-direction"},
        {SCENE("<growth min='0,0,0' max='1,1,0'/>"), "arena-cells"},
        {SCENE("<growth cell='0.001'/>"), "arena-cells"},
        {PLANT("<species envelope='1,0'/>"), "bad-envelope"},
        {PLANT("<species envelope='1,0 2,0'/>"), "bad-envelope"},
        {PLANT("<species envelope='-1,0 2,3'/>"), "bad-envelope"},
        {PLANT("<species box='2'/>"), "even-box"},
        {SCENE("<growth><particles shape='direction' direction='0'/></growth>"), "no-direction"},
        {SCENE("<growth><particles shape='brush'/></growth>"), "bad-stroke"},
        {SCENE("<growth><particles>0,0,0 1,1,1</particles></growth>"), "unexpected-text"},
        {SCENE("<particles/>"), "misplaced-element"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Parsed parsed = parse(rows[i].text);
        g_test_message("%s", rows[i].text);
        g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
        g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
        g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, rows[i].code);
        g_assert_nonnull(fr_diags_get(parsed.diags, 0)->span.source);
        forget(&parsed);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/growth/a species starts from its preset and its model",
                    test_species);
    g_test_add_func("/document/growth/E17 sliders are pure and neutral in the middle",
                    test_sliders);
    g_test_add_func("/document/growth/a world and its particles are read and set", test_world);
    g_test_add_func("/document/growth/what is wrong has its code and place", test_wrong);
    return g_test_run();
}
