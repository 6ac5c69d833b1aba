#include "studio/view/piece.h"

#include "studio/view/program.h"

#include <string.h>

void studio_piece_attribute(GLuint index, GLint size, size_t stride, size_t offset,
                            GLuint divisor) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, (GLsizei)stride,
                          (const void *)(uintptr_t)offset);
    glVertexAttribDivisor(index, divisor);
}

// An area shines by its cosine: the cosine of a cone that none has tells it.
static void use_lamps(GLuint program, const FrShading *shading) {
    float at[FR_SHADING_LAMPS][4], axis[FR_SHADING_LAMPS][4], colour[FR_SHADING_LAMPS][3];
    for (uint32_t i = 0; i < shading->lamp_count; i++) {
        const FrShadingLamp *lamp = &shading->lamps[i];
        for (int k = 0; k < 3; k++) {
            at[i][k] = lamp->at.raw[k];
            axis[i][k] = lamp->axis.raw[k];
            colour[i][k] = lamp->intensity.raw[k];
        }
        at[i][3] = lamp->near;
        axis[i][3] = lamp->is_area ? 2 : lamp->cosine;
    }
    GLsizei count = (GLsizei)shading->lamp_count;
    studio_program_int(program, "lamp_count", count);
    glUniform4fv(glGetUniformLocation(program, "lamp_at"), count, at[0]);
    glUniform4fv(glGetUniformLocation(program, "lamp_axis"), count, axis[0]);
    glUniform3fv(glGetUniformLocation(program, "lamp_colour"), count, colour[0]);
}

void studio_piece_light(GLuint program, const FrShading *shading) {
    studio_program_vec3(program, "sun_colour", shading->sun.raw);
    glUniform3fv(glGetUniformLocation(program, "sky"), FR_SHADING_TERMS, shading->sky[0].raw);
    use_lamps(program, shading);
}

static const struct {
    const char *map, *question;
} maps[STUDIO_MAPS] = {{"picture", "has_picture"}, {"bumps", "has_bumps"}, {"gloss", "has_gloss"}};

static const GLint map_units[STUDIO_MAPS] = {0, 2, 3}; // 1 is the shadow

static const char *const dress_names[STUDIO_DRESS] = {"cutoff", "translucency", "roughness",
                                                      "relief", "mirror",       "clear"};

StudioPen studio_pen_begin(GLuint program, bool has_details) {
    StudioPen pen = {.has_details = has_details,
                     .model = glGetUniformLocation(program, "model"),
                     .enlarge = glGetUniformLocation(program, "enlarge"),
                     .tint = glGetUniformLocation(program, "tint"),
                     .is_blade = glGetUniformLocation(program, "is_blade"),
                     .is_leaf = glGetUniformLocation(program, "is_leaf"),
                     .is_still = glGetUniformLocation(program, "is_still")};
    for (int i = 0; i < STUDIO_DRESS; i++) {
        pen.dress[i] = glGetUniformLocation(program, dress_names[i]);
    }
    for (int i = 0; i < STUDIO_MAPS; i++) {
        studio_program_int(program, maps[i].map, map_units[i]);
        pen.has_map[i] = glGetUniformLocation(program, maps[i].question);
    }
    return pen;
}

static void use_vertices(const StudioPiece *piece) {
    glBindBuffer(GL_ARRAY_BUFFER, piece->vertices);
    studio_piece_attribute(0, 3, sizeof(FrVertex), offsetof(FrVertex, position), 0);
    studio_piece_attribute(1, 3, sizeof(FrVertex), offsetof(FrVertex, normal), 0);
    studio_piece_attribute(2, 2, sizeof(FrVertex), offsetof(FrVertex, uv), 0);
}

static void use_leaves(const StudioPiece *piece) {
    if (piece->leaves != 0) {
        size_t first = piece->first_leaf * sizeof(StudioLeaf);
        glBindBuffer(GL_ARRAY_BUFFER, piece->leaves);
        studio_piece_attribute(3, 4, sizeof(StudioLeaf), first, 1);
        studio_piece_attribute(4, 4, sizeof(StudioLeaf), first + offsetof(StudioLeaf, turn), 1);
    } else {
        glDisableVertexAttribArray(3);
        glDisableVertexAttribArray(4);
        glVertexAttrib4f(3, 0, 0, 0, 1);
        glVertexAttrib4f(4, 0, 0, 0, 1);
    }
}

// What surfaces do to light.
static void use_dress(const StudioPen *pen, const StudioDress *dress) {
    const float values[STUDIO_DRESS] = {dress->cutoff, dress->translucency, dress->roughness,
                                        dress->relief, dress->mirror,       dress->clear};
    glUniform3fv(pen->tint, 1, dress->tint);
    for (int i = 0; i < STUDIO_DRESS; i++) {
        glUniform1f(pen->dress[i], values[i]);
    }
}

static void use_maps(const StudioPen *pen, const StudioPiece *piece) {
    const GLuint textures[STUDIO_MAPS] = {piece->picture, pen->has_details ? piece->bumps : 0,
                                          pen->has_details ? piece->gloss : 0};
    for (int i = 0; i < STUDIO_MAPS; i++) {
        glUniform1i(pen->has_map[i], textures[i] != 0);
        glActiveTexture((GLenum)(GL_TEXTURE0 + map_units[i]));
        glBindTexture(GL_TEXTURE_2D, textures[i]);
    }
}

// What is behind glass comes through as the program says; there is nothing to say for shadows.
static void use_clear(const StudioPen *pen, bool is_clear) {
    if (is_clear && pen->dress[STUDIO_DRESS - 1] >= 0) {
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
        glDepthMask(GL_FALSE);
    } else {
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
    }
}

// What is as in the last piece stays: parts of a plant share a place, and equal plants nearly all
// else.
static void use_piece(StudioPen *pen, const StudioPiece *piece) {
    const StudioPiece *last = &pen->last;
    bool is_first = !pen->has_last;
    if (is_first || piece->vertices != last->vertices) {
        use_vertices(piece);
    }
    if (is_first || piece->leaves != last->leaves || piece->first_leaf != last->first_leaf) {
        use_leaves(piece);
    }
    if (is_first || piece->indices != last->indices) {
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, piece->indices);
    }
    if (is_first || memcmp(&piece->model, &last->model, sizeof piece->model) != 0) {
        glUniformMatrix4fv(pen->model, 1, GL_FALSE, piece->model.raw[0]);
    }
    if (is_first || (piece->look.clear > 0) != (last->look.clear > 0)) {
        use_clear(pen, piece->look.clear > 0);
    }
    if (is_first || memcmp(&piece->look, &last->look, sizeof piece->look) != 0) {
        use_dress(pen, &piece->look);
    }
    if (is_first || piece->picture != last->picture || piece->bumps != last->bumps ||
        piece->gloss != last->gloss) {
        use_maps(pen, piece);
    }
    if (is_first || memcmp(&piece->enlarge, &last->enlarge, sizeof piece->enlarge) != 0) {
        glUniform1f(pen->enlarge, piece->enlarge);
    }
    if (is_first || piece->is_blade != last->is_blade) {
        glUniform1i(pen->is_blade, piece->is_blade);
    }
    if (is_first || (piece->leaves != 0) != (last->leaves != 0)) {
        glUniform1i(pen->is_leaf, piece->leaves != 0);
    }
    if (is_first || piece->is_still != last->is_still) {
        glUniform1i(pen->is_still, piece->is_still);
    }
    pen->last = *piece;
    pen->has_last = true;
}

void studio_pen_draw(StudioPen *pen, const StudioPiece *piece) {
    use_piece(pen, piece);
    const void *first = (const void *)(uintptr_t)(piece->first_index * sizeof(uint32_t));
    if (piece->leaves != 0) {
        glDrawElementsInstanced(GL_TRIANGLES, (GLsizei)piece->index_count, GL_UNSIGNED_INT, first,
                                (GLsizei)piece->leaf_count);
    } else {
        glDrawElements(GL_TRIANGLES, (GLsizei)piece->index_count, GL_UNSIGNED_INT, first);
    }
}

void studio_pen_end(StudioPen *pen) {
    use_clear(pen, false);
}
