#include "studio/view/overlays.h"

#include "studio/view/program.h"

#include <stddef.h>

// What of a mark is hidden, from its distance and the depth of the picture there.
#define STUDIO_HIDE                                                                                \
    "#version 330 core\n"                                                                          \
    "uniform sampler2D depths; uniform vec2 planes, size; uniform float through;\n"                \
    "float seen(float away) {\n"                                                                   \
    "    float d = texture(depths, gl_FragCoord.xy / size).r * 2.0 - 1.0;\n"                       \
    "    float wall = 2.0 * planes.x * planes.y /\n"                                               \
    "                 (planes.x + planes.y - d * (planes.y - planes.x));\n"                        \
    "    bool is_hidden = d < 1.0 && away > wall * 1.002;\n"                                       \
    "    return is_hidden ? through : 1.0;\n"                                                      \
    "}\n"

/// A line is a strip of two triangles, a pixel wider than it to fade out. What is behind the camera
/// is cut off, as no position on the screen belongs to it.
static const char line_vertex[] =
    "#version 330 core\n"
    "layout(location=0) in vec4 from; layout(location=1) in vec4 from_colour;\n"
    "layout(location=2) in vec4 to; layout(location=3) in vec4 to_colour;\n"
    "uniform mat4 clip; uniform vec2 size; uniform float scale, nearest;\n"
    "out vec4 paint; out float away, aside; flat out float half_width;\n"
    "void main() {\n"
    "    vec4 a = clip * vec4(from.xyz, 1.0), b = clip * vec4(to.xyz, 1.0);\n"
    "    vec4 first = a, second = b; float cut_a = 0.0, cut_b = 1.0;\n"
    "    if (a.w < nearest && b.w >= nearest) {\n"
    "        cut_a = (nearest - a.w) / (b.w - a.w); first = mix(a, b, cut_a);\n"
    "    }\n"
    "    if (b.w < nearest && a.w >= nearest) {\n"
    "        cut_b = (nearest - a.w) / (b.w - a.w); second = mix(a, b, cut_b);\n"
    "    }\n"
    "    bool is_end = (gl_VertexID & 1) != 0; float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;\n"
    "    vec4 here = is_end ? second : first;\n"
    "    if (here.w < nearest) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }\n"
    "    vec2 along = (second.xy / second.w - first.xy / first.w) * size;\n"
    "    along = length(along) > 1e-4 ? normalize(along) : vec2(1.0, 0.0);\n"
    "    half_width = 0.5 * scale * from.w; aside = side * (half_width + 1.0);\n"
    "    here.xy += vec2(-along.y, along.x) * aside * 2.0 / size * here.w;\n"
    "    paint = mix(from_colour, to_colour, is_end ? cut_b : cut_a);\n"
    "    away = here.w; gl_Position = here;\n"
    "}\n";
static const char line_fragment[] = STUDIO_HIDE
    "in vec4 paint; in float away, aside; flat in float half_width;\n"
    "layout(location=0) out vec4 colour;\n"
    "void main() {\n"
    "    float cover = clamp(half_width + 0.5 - abs(aside), 0.0, 1.0) * min(2.0 * half_width, "
    "1.0);\n"
    "    colour = vec4(paint.rgb, paint.a * cover * seen(away));\n"
    "}\n";

static const char point_vertex[] =
    "#version 330 core\n"
    "layout(location=0) in vec4 from; layout(location=1) in vec4 from_colour;\n"
    "uniform mat4 clip; uniform float scale; out vec4 paint; out float away; flat out float wide;\n"
    "void main() {\n"
    "    gl_Position = clip * vec4(from.xyz, 1.0); away = gl_Position.w; paint = from_colour;\n"
    "    wide = from.w * scale + 1.0; gl_PointSize = wide;\n"
    "}\n";
static const char point_fragment[] = STUDIO_HIDE
    "in vec4 paint; in float away; flat in float wide; layout(location=0) out vec4 colour;\n"
    "void main() {\n"
    "    float r = length(gl_PointCoord - 0.5) * wide;\n"
    "    float cover = clamp(0.5 * wide - r, 0.0, 1.0);\n"
    "    colour = vec4(paint.rgb, paint.a * cover * seen(away));\n"
    "}\n";

static const char triangle_vertex[] =
    "#version 330 core\n"
    "layout(location=0) in vec4 from; layout(location=1) in vec4 from_colour;\n"
    "uniform mat4 clip; out vec4 paint; out float away;\n"
    "void main() {\n"
    "    gl_Position = clip * vec4(from.xyz, 1.0); away = gl_Position.w; paint = from_colour;\n"
    "}\n";
static const char triangle_fragment[] =
    STUDIO_HIDE "in vec4 paint; in float away; layout(location=0) out vec4 colour;\n"
                "void main() { colour = vec4(paint.rgb, paint.a * seen(away)); }\n";

// A layer: triangles, lines and points one after the other in a buffer.
typedef struct Layer {
    GLuint marks;
    uint32_t triangle_count, line_count, point_count; // of marks
    float through;
} Layer;

struct StudioOverlays {
    GLuint line, point, triangle;
    GTree *layers; // name → Layer
};

static void layer_free(gpointer data) {
    Layer *layer = data;
    glDeleteBuffers(1, &layer->marks);
    g_free(layer);
}

static int compare_names(gconstpointer a, gconstpointer b, gpointer data) {
    (void)data;
    return g_strcmp0(a, b);
}

StudioOverlays *studio_overlays_new(GError **error) {
    StudioOverlays *overlays = g_new0(StudioOverlays, 1);
    overlays->layers = g_tree_new_full(compare_names, NULL, g_free, layer_free);
    overlays->line = studio_program_new(line_vertex, line_fragment, error);
    overlays->point =
        overlays->line == 0 ? 0 : studio_program_new(point_vertex, point_fragment, error);
    overlays->triangle =
        overlays->point == 0 ? 0 : studio_program_new(triangle_vertex, triangle_fragment, error);
    if (overlays->triangle == 0) {
        studio_overlays_free(overlays);
        return NULL;
    }
    return overlays;
}

void studio_overlays_free(StudioOverlays *overlays) {
    if (overlays != NULL) {
        g_tree_unref(overlays->layers);
        glDeleteProgram(overlays->line);
        glDeleteProgram(overlays->point);
        glDeleteProgram(overlays->triangle);
        g_free(overlays);
    }
}

static void send(size_t *offset, const GArray *marks) {
    size_t size = marks->len * sizeof(StudioMark);
    glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)*offset, (GLsizeiptr)size, marks->data);
    *offset += size;
}

void studio_overlays_set(StudioOverlays *overlays, const char *name, const StudioOverlay *overlay) {
    if (overlay == NULL) {
        g_tree_remove(overlays->layers, name);
        return;
    }
    Layer *layer = g_new0(Layer, 1);
    layer->triangle_count = overlay->triangles->len;
    layer->line_count = overlay->lines->len;
    layer->point_count = overlay->points->len;
    layer->through = overlay->through;
    size_t count = (size_t)layer->triangle_count + layer->line_count + layer->point_count;
    size_t offset = 0;
    glGenBuffers(1, &layer->marks);
    glBindBuffer(GL_ARRAY_BUFFER, layer->marks);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof(StudioMark)), NULL, GL_STATIC_DRAW);
    send(&offset, overlay->triangles);
    send(&offset, overlay->lines);
    send(&offset, overlay->points);
    g_tree_replace(overlays->layers, g_strdup(name), layer);
}

// ---- drawing -----------------------------------------------------------------------------------

// Marks from `first` on become attributes 2 k and 2 k + 1, for k below `ends`.
static void use_marks(const Layer *layer, size_t first, GLuint ends) {
    glBindBuffer(GL_ARRAY_BUFFER, layer->marks);
    for (GLuint i = 0; i < 4; i++) {
        if (i >= 2 * ends) {
            glDisableVertexAttribArray(i);
            continue;
        }
        size_t at = (first + i / 2) * sizeof(StudioMark);
        at += i % 2 == 1 ? offsetof(StudioMark, colour) : 0;
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, (GLsizei)(ends * sizeof(StudioMark)),
                              (const void *)(uintptr_t)at);
        glVertexAttribDivisor(i, ends == 2 ? 1 : 0);
    }
}

static void use_program(GLuint program, const Layer *layer, const StudioUnder *under) {
    glUseProgram(program);
    studio_program_matrix(program, "clip", &under->clip);
    studio_program_int(program, "depths", 0);
    studio_program_vec2(program, "planes", under->near, under->far);
    studio_program_vec2(program, "size", (float)under->width, (float)under->height);
    studio_program_float(program, "scale", under->scale);
    studio_program_float(program, "nearest", 0.01f * under->near);
    studio_program_float(program, "through", layer->through);
}

static gboolean draw_layer(gpointer name, gpointer value, gpointer data) {
    (void)name;
    const Layer *layer = value;
    const StudioUnder *under = ((gpointer *)data)[1];
    const StudioOverlays *overlays = ((gpointer *)data)[0];
    if (layer->triangle_count > 0) {
        use_program(overlays->triangle, layer, under);
        use_marks(layer, 0, 1);
        glDrawArrays(GL_TRIANGLES, 0, (GLsizei)layer->triangle_count);
    }
    if (layer->line_count > 0) {
        use_program(overlays->line, layer, under);
        use_marks(layer, layer->triangle_count, 2);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)(layer->line_count / 2));
    }
    if (layer->point_count > 0) {
        use_program(overlays->point, layer, under);
        use_marks(layer, (size_t)layer->triangle_count + layer->line_count, 1);
        glDrawArrays(GL_POINTS, 0, (GLsizei)layer->point_count);
    }
    return FALSE;
}

void studio_overlays_draw(const StudioOverlays *overlays, const StudioUnder *under) {
    gpointer user[] = {(gpointer)overlays, (gpointer)under};
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, under->depths);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP); // the planes are those of the plants
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    g_tree_foreach(overlays->layers, draw_layer, user);
    glDisable(GL_BLEND);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_DEPTH_CLAMP);
    for (GLuint i = 0; i < 4; i++) {
        glVertexAttribDivisor(i, 0);
    }
}
