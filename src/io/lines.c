// A table of lines (.txt): `x y z x y z r` a row, the two ends of each piece of an axis and its
// radius, z up, metres. What `<skeleton>` reads.
#include "io/formats.h"
#include "io/meshes.h"
#include "io/output.h"

#include "frond/skeleton.h"

typedef struct FrLines {
    const FrScene *scene;
    const FrContext *context;
    uint64_t bytes, lines;
} FrLines;

static void add_point(FrOutput *output, const FrPose *pose, vec3s at) {
    FrVertex vertex = {.position = {at.x, at.y, at.z}};
    vertex = fr_io_posed(pose, &vertex);
    for (int k = 0; k < 3; k++) {
        fr_output_fixed(output, (double)vertex.position[k], 6);
        fr_output_text(output, " ");
    }
}

static void add_stand(FrLines *lines, FrOutput *output, const FrStand *stand) {
    const FrPlant *plant = fr_io_plant(lines->scene, stand->plant);
    FrPose pose = fr_io_pose(stand, FR_UP_Z);
    size_t count;
    FrSegment *segments = fr_skeleton_segments(plant, &count);
    fr_output_text(output, "# ");
    fr_output_text(output, plant->name);
    fr_output_text(output, "\n");
    for (size_t i = 0; i < count && output->error == 0; i++) {
        add_point(output, &pose, segments[i].from);
        add_point(output, &pose, segments[i].to);
        fr_output_fixed(output, (double)segments[i].radius * stand->scale, 6);
        fr_output_text(output, "\n");
    }
    lines->lines += count;
    g_free(segments);
}

static bool write_lines(void *user, int descriptor) {
    FrLines *lines = user;
    guint stands = fr_scene_stand_count(lines->scene);
    FrOutput output;
    fr_output_start(&output, descriptor, lines->context->progress);
    fr_output_text(&output, "# Frond " FR_VERSION ": x y z x y z r, metres, z up\n");
    for (guint s = 0; s < stands && output.error == 0; s++) {
        add_stand(lines, &output, fr_io_stand(lines->scene, s));
        fr_progress_report(lines->context->progress, "write", (s + 1.0) / stands);
    }
    bool is_whole = fr_output_finish(&output);
    lines->bytes = output.done;
    return is_whole;
}

FrStatus fr_lines_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                        const FrContext *context, FrIoStats *stats) {
    (void)options;
    FrLines lines = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_io_replace_file(path, write_lines, &lines, context->diags);
    stats->entities = lines.lines;
    stats->bytes = lines.bytes;
    stats->write_seconds = (double)(g_get_monotonic_time() - start) * 1e-6;
    return status;
}
