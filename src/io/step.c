// STEP (ISO 10303-21) by AP214: a plant is a product whose shape is a surface model of shells: a
// closed one for each tube with its caps, an open one for each blade.
#include "io/formats.h"
#include "io/step_faces.h"

#include <string.h>

enum { POINT_BYTES = 180 };

typedef struct FrStepFile {
    const FrScene *scene;
    const FrContext *context;
    FrIoNurbs nurbs;
    uint64_t bytes;
} FrStepFile;

static const char head[] =
    "ISO-10303-21;\nHEADER;\n"
    "FILE_DESCRIPTION(('plants as rational B-spline surfaces'),'2;1');\n"
    "FILE_NAME('','2000-01-01T00:00:00',(''),(''),'Frond " FR_VERSION "','Frond " FR_VERSION
    "','');\n"
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
    "#1=APPLICATION_CONTEXT('automotive design');\n"
    "#2=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1);\n"
    "#3=PRODUCT_CONTEXT('',#1,'mechanical');\n"
    "#4=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');\n"
    "#5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
    "#6=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
    "#7=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
    "#8=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#5,'distance_accuracy_value','');\n"
    "#9=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#8))"
    "GLOBAL_UNIT_ASSIGNED_CONTEXT((#5,#6,#7))REPRESENTATION_CONTEXT('',''));\n";
enum { LAST_OF_HEAD = 9 };

/// Quotes a name as ISO 10303-21 wants it: printable ASCII, quotes doubled.
static char *quoted(const char *name) {
    GString *text = g_string_new("'");
    for (const char *c = name; *c != '\0'; c++) {
        g_string_append_c(text, g_ascii_isprint(*c) && *c != '\\' ? *c : '_');
        if (*c == '\'') {
            g_string_append_c(text, '\'');
        }
    }
    g_string_append_c(text, '\'');
    return g_string_free(text, FALSE);
}

/// An entity with a name and references: `#n=KIND('name',#a,#b);`
static uint64_t put_entity(FrStep *step, const char *kind, const char *before,
                           const uint64_t *references, size_t count, const char *after) {
    uint64_t entity = fr_step_begin(step);
    fr_step_text(step, kind);
    fr_step_text(step, before);
    for (size_t i = 0; i < count; i++) {
        fr_step_text(step, i > 0 ? "," : "");
        fr_step_reference(step, references[i]);
    }
    fr_step_text(step, after);
    return entity;
}

static void put_shells(FrStep *step, const FrNurbsSkin *skin, GArray *shells) {
    for (uint64_t i = 0; i < skin->count;) {
        uint64_t faces[3];
        bool is_closed;
        uint32_t used = fr_step_shell(step, &skin->pieces[i], skin->count - i, faces, &is_closed);
        uint64_t shell = put_entity(step, is_closed ? "CLOSED_SHELL" : "OPEN_SHELL", "('',(", faces,
                                    used, "));\n");
        g_array_append_val(shells, shell);
        i += used;
    }
}

static void put_product(FrStep *step, const char *name, const GArray *shells) {
    char *text = quoted(name);
    uint64_t product = fr_step_begin(step);
    fr_step_text(step, "PRODUCT(");
    fr_step_text(step, text);
    fr_step_text(step, ",");
    fr_step_text(step, text);
    fr_step_text(step, ",'',(#3));\n");
    g_free(text);
    put_entity(step, "PRODUCT_RELATED_PRODUCT_CATEGORY", "('part',$,(", &product, 1, "));\n");
    uint64_t formation =
        put_entity(step, "PRODUCT_DEFINITION_FORMATION", "('','',", &product, 1, ");\n");
    uint64_t definition =
        put_entity(step, "PRODUCT_DEFINITION", "('design','',", &formation, 1, ",#4);\n");
    uint64_t shape =
        put_entity(step, "PRODUCT_DEFINITION_SHAPE", "('','',", &definition, 1, ");\n");
    uint64_t model = put_entity(step, "SHELL_BASED_SURFACE_MODEL", "('',(",
                                (const uint64_t *)(void *)shells->data, shells->len, "));\n");
    uint64_t both[2] = {shape, 0};
    both[1] =
        put_entity(step, "MANIFOLD_SURFACE_SHAPE_REPRESENTATION", "('',(", &model, 1, "),#9);\n");
    put_entity(step, "SHAPE_DEFINITION_REPRESENTATION", "(", both, 2, ");\n");
}

static bool write_step(void *user, int descriptor) {
    FrStepFile *file = user;
    FrStep step = {.last = LAST_OF_HEAD, .scratch = g_array_new(FALSE, FALSE, sizeof(uint64_t))};
    GArray *shells = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    fr_output_start(&step.output, descriptor, file->context->progress);
    fr_step_text(&step, head);
    for (guint s = 0; s < file->scene->stands->len && step.output.error == 0; s++) {
        const FrStand *stand = fr_io_stand(file->scene, s);
        FrPose pose = fr_io_pose(stand, FR_UP_Z);
        step.pose = &pose;
        g_array_set_size(shells, 0);
        put_shells(&step, file->nurbs.skins[stand->plant], shells);
        if (shells->len > 0) {
            put_product(&step, fr_io_plant(file->scene, stand->plant)->name, shells);
        }
        fr_progress_report(file->context->progress, "write",
                           (double)(s + 1) / file->scene->stands->len);
    }
    fr_step_text(&step, "ENDSEC;\nEND-ISO-10303-21;\n");
    bool is_whole = fr_output_finish(&step.output);
    file->bytes = step.output.done;
    g_array_unref(shells);
    g_array_unref(step.scratch);
    return is_whole;
}

FrStatus fr_step_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats) {
    FrStepFile file = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status =
        fr_io_nurbs_make(&file.nurbs, scene, &options->nurbs, false, POINT_BYTES, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    status = fr_io_replace_file(path, write_step, &file, context->diags);
    *stats = fr_io_nurbs_stats(&file.nurbs, file.bytes, start, skinned);
    fr_io_nurbs_clear(&file.nurbs);
    return status;
}
