#include "studio/view/piece.h"

#include "studio/view/program.h"

enum { UNIT_PICTURE, UNIT_SHADOW, UNIT_BUMPS, UNIT_GLOSS };

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

static void use_map(GLuint program, const char *name, const char *question, int unit,
                    GLuint texture) {
    studio_program_int(program, name, unit);
    studio_program_int(program, question, texture != 0);
    glActiveTexture((GLenum)(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, texture);
}

void studio_piece_draw(GLuint program, const StudioPiece *piece, bool has_details) {
    glBindBuffer(GL_ARRAY_BUFFER, piece->vertices);
    studio_piece_attribute(0, 3, sizeof(FrVertex), offsetof(FrVertex, position), 0);
    studio_piece_attribute(1, 3, sizeof(FrVertex), offsetof(FrVertex, normal), 0);
    studio_piece_attribute(2, 2, sizeof(FrVertex), offsetof(FrVertex, uv), 0);
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
    studio_program_matrix(program, "model", &piece->model);
    studio_program_float(program, "enlarge", piece->enlarge);
    studio_program_vec3(program, "tint", piece->look.tint);
    studio_program_float(program, "cutoff", piece->look.cutoff);
    studio_program_float(program, "translucency", piece->look.translucency);
    studio_program_float(program, "roughness", piece->look.roughness);
    studio_program_float(program, "relief", piece->look.relief);
    studio_program_float(program, "mirror", piece->look.mirror);
    studio_program_int(program, "is_blade", piece->is_blade);
    studio_program_int(program, "is_leaf", piece->leaves != 0);
    studio_program_int(program, "is_still", piece->is_still);
    use_map(program, "picture", "has_picture", UNIT_PICTURE, piece->picture);
    use_map(program, "bumps", "has_bumps", UNIT_BUMPS, has_details ? piece->bumps : 0);
    use_map(program, "gloss", "has_gloss", UNIT_GLOSS, has_details ? piece->gloss : 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, piece->indices);
    const void *first = (const void *)(uintptr_t)(piece->first_index * sizeof(uint32_t));
    if (piece->leaves != 0) {
        glDrawElementsInstanced(GL_TRIANGLES, (GLsizei)piece->index_count, GL_UNSIGNED_INT, first,
                                (GLsizei)piece->leaf_count);
    } else {
        glDrawElements(GL_TRIANGLES, (GLsizei)piece->index_count, GL_UNSIGNED_INT, first);
    }
}
