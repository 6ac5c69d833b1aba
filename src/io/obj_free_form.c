// Wavefront OBJ with free-form geometry: rational B-spline surfaces instead of triangles.
// Wavefront, Advanced Visualizer Manual, appendix B1 (.obj): `cstype rat bspline`, `deg`, `surf`,
// `parm`, `end`. y up, as in the other kind of .obj.
#include "io/formats.h"
#include "io/nurbs_scene.h"

#include <string.h>

enum { POINT_BYTES = 80 };

typedef struct FrFreeForm {
    const FrScene *scene;
    const FrContext *context;
    FrIoNurbs nurbs;
    uint64_t bytes;
} FrFreeForm;

static void add_real(FrOutput *output, double value, int digits) {
    char text[FR_REAL_ROOM];
    int length = fr_real_text(text, value, digits);
    fr_output_bytes(output, " ", 1);
    fr_output_bytes(output, text, (size_t)length);
}

static void add_knots(FrOutput *output, const char *name, const double *knots, uint32_t count) {
    fr_output_text(output, name);
    for (uint32_t i = 0; i < count; i++) {
        add_real(output, knots[i], 17);
    }
    fr_output_text(output, "\n");
}

static void add_surface(FrOutput *output, const FrNurbsSurface *s, const FrPose *pose) {
    size_t count = (size_t)s->count_u * s->count_v;
    for (size_t i = 0; i < count; i++) {
        double at[4];
        fr_io_nurbs_posed(pose, s->points[i], at);
        fr_output_text(output, "v");
        add_real(output, at[0], 15);
        add_real(output, at[2], 15);
        add_real(output, -at[1], 15);
        add_real(output, at[3], 17);
        fr_output_text(output, "\n");
    }
    fr_output_text(output, "cstype rat bspline\ndeg ");
    fr_output_integer(output, s->degree_u);
    fr_output_text(output, " ");
    fr_output_integer(output, s->degree_v);
    double range[4];
    fr_nurbs_range(s->knots_u, s->degree_u, s->count_u, range);
    fr_nurbs_range(s->knots_v, s->degree_v, s->count_v, range + 2);
    fr_output_text(output, "\nsurf");
    for (int k = 0; k < 4; k++) {
        add_real(output, range[k], 17);
    }
    for (size_t i = count; i > 0; i--) {
        fr_output_text(output, " -");
        fr_output_integer(output, i);
    }
    fr_output_text(output, "\n");
    add_knots(output, "parm u", s->knots_u, s->count_u + s->degree_u + 1);
    add_knots(output, "parm v", s->knots_v, s->count_v + s->degree_v + 1);
    fr_output_text(output, "end\n");
}

static bool write_free_form(void *user, int descriptor) {
    FrFreeForm *form = user;
    FrOutput output;
    fr_output_start(&output, descriptor, form->context->progress);
    fr_output_text(&output, "# Frond " FR_VERSION ", metres, y up, rational B-splines\n");
    for (guint s = 0; s < form->scene->stands->len && output.error == 0; s++) {
        const FrStand *stand = fr_io_stand(form->scene, s);
        const FrNurbsSkin *skin = form->nurbs.skins[stand->plant];
        FrPose pose = fr_io_pose(stand, FR_UP_Z);
        fr_output_text(&output, "o plant-");
        fr_output_integer(&output, s + 1);
        fr_output_text(&output, "\n");
        bool was_organ = true;
        for (uint64_t i = 0; i < skin->count; i++) {
            bool is_organ = skin->pieces[i].organ != FR_NONE;
            if (i == 0 || is_organ != was_organ) {
                fr_output_text(&output, is_organ ? "g organs\n" : "g wood\n");
                was_organ = is_organ;
            }
            add_surface(&output, &skin->pieces[i].surface, &pose);
        }
        fr_progress_report(form->context->progress, "write",
                           (double)(s + 1) / form->scene->stands->len);
    }
    bool is_whole = fr_output_finish(&output);
    form->bytes = output.done;
    return is_whole;
}

FrStatus fr_free_form_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                            const FrContext *context, FrIoStats *stats) {
    FrFreeForm form = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status =
        fr_io_nurbs_make(&form.nurbs, scene, &options->nurbs, false, POINT_BYTES, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    status = fr_io_replace_file(path, write_free_form, &form, context->diags);
    *stats = fr_io_nurbs_stats(&form.nurbs, form.bytes, start, skinned);
    fr_io_nurbs_clear(&form.nurbs);
    return status;
}
