/// @file program.h
/// Shader programs.
#pragma once

#include "frond/api.h"

#include <cglm/struct.h>
#include <epoxy/gl.h>
#include <glib.h>

/// Compiles and links; 0 and an error with the driver's words if it does not.
GLuint studio_program_new(const char *vertex, const char *fragment, GError **error);
// Uniforms by name; the program is in use.
void studio_program_int(GLuint program, const char *name, int value);
void studio_program_float(GLuint program, const char *name, float value);
void studio_program_vec2(GLuint program, const char *name, float x, float y);
void studio_program_vec3(GLuint program, const char *name, const float value[3]);
void studio_program_vec4(GLuint program, const char *name, const float value[4]);
void studio_program_matrix(GLuint program, const char *name, const mat4s *value);
