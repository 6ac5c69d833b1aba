/// @file piece.h
/// Draws a piece of a store with a program of surfaces or shadows that is in use.
#pragma once

#include "studio/view/store.h"

enum { STUDIO_MAPS = 3, STUDIO_DRESS = 6 };

/// A program that is in use, the places of its uniforms, and the piece that it has drawn last.
typedef struct StudioPen {
    GLint model, enlarge, tint, is_blade, is_leaf, is_still;
    GLint dress[STUDIO_DRESS];  ///< numbers of a StudioDress
    GLint has_map[STUDIO_MAPS]; ///< of colour, normals and roughness
    bool has_details;           ///< without them there are no maps of normals and roughness
    bool has_last;
    StudioPiece last;
} StudioPen;

/// An attribute of so many floats in the buffer that is bound.
void studio_piece_attribute(GLuint index, GLint size, size_t stride, size_t offset, GLuint divisor);
/// Sets the light of a scene but for the direction of its sun.
void studio_piece_light(GLuint program, const FrShading *shading);

/// Draws one piece after the other, clear ones over what is there. The driver is told only what
/// differs from the last one: a scene has thousands of small pieces, of which many are of equal
/// plants.
StudioPen studio_pen_begin(GLuint program, bool has_details);
void studio_pen_draw(StudioPen *pen, const StudioPiece *piece);
/// What is drawn afterwards hides what is behind it, as before.
void studio_pen_end(StudioPen *pen);
