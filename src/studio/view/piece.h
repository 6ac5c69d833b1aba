/// @file piece.h
/// Draws a piece of a store with a program of surfaces or shadows that is in use.
#pragma once

#include "studio/view/store.h"

/// An attribute of so many floats in the buffer that is bound.
void studio_piece_attribute(GLuint index, GLint size, size_t stride, size_t offset, GLuint divisor);
/// Sets the light of a scene but for the direction of its sun.
void studio_piece_light(GLuint program, const FrShading *shading);
/// Without details the maps of normals and roughness are left out.
void studio_piece_draw(GLuint program, const StudioPiece *piece, bool has_details);
