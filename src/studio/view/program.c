#include "studio/view/program.h"

static GLuint compile(GLenum kind, const char *text, GError **error) {
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    GLint is_right;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_right);
    if (!is_right) {
        char log[2048];
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_FAILED, "The graphics driver says: %s", log);
        glDeleteShader(shader);
        return 0;
    }
    return shader;
}

GLuint studio_program_new(const char *vertex, const char *fragment, GError **error) {
    GLuint first = compile(GL_VERTEX_SHADER, vertex, error);
    GLuint second = first == 0 ? 0 : compile(GL_FRAGMENT_SHADER, fragment, error);
    GLuint program = 0;
    if (second != 0) {
        program = glCreateProgram();
        glAttachShader(program, first);
        glAttachShader(program, second);
        glLinkProgram(program);
        GLint is_right;
        glGetProgramiv(program, GL_LINK_STATUS, &is_right);
        if (!is_right) {
            g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_FAILED,
                        "The graphics driver cannot link a program");
            glDeleteProgram(program);
            program = 0;
        }
    }
    glDeleteShader(first);
    glDeleteShader(second);
    return program;
}

void studio_program_int(GLuint program, const char *name, int value) {
    glUniform1i(glGetUniformLocation(program, name), value);
}

void studio_program_float(GLuint program, const char *name, float value) {
    glUniform1f(glGetUniformLocation(program, name), value);
}

void studio_program_vec2(GLuint program, const char *name, float x, float y) {
    glUniform2f(glGetUniformLocation(program, name), x, y);
}

void studio_program_vec3(GLuint program, const char *name, const float value[3]) {
    glUniform3fv(glGetUniformLocation(program, name), 1, value);
}

void studio_program_vec4(GLuint program, const char *name, const float value[4]) {
    glUniform4fv(glGetUniformLocation(program, name), 1, value);
}

void studio_program_matrix(GLuint program, const char *name, const mat4s *value) {
    glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, value->raw[0]);
}
