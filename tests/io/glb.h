/// @file glb.h
/// A .glb read back: its JSON and its buffer, checked as far as every file must hold.
#pragma once

#include "scenes.h"

#include <jansson.h>

typedef struct Glb {
    char *bytes;
    json_t *json;
    const uint8_t *buffer;
    size_t buffer_size;
} Glb;

static inline uint32_t get32(const char *at) {
    uint32_t value;
    memcpy(&value, at, 4);
    return value;
}

static inline Glb glb_read(const char *folder, const char *name) {
    Glb glb = {0};
    size_t size;
    glb.bytes = file_bytes(folder, name, &size);
    g_assert_cmpuint(size, >=, 20);
    g_assert_true(memcmp(glb.bytes, "glTF", 4) == 0);
    g_assert_cmpuint(get32(glb.bytes + 4), ==, 2);
    g_assert_cmpuint(get32(glb.bytes + 8), ==, size);
    uint32_t json_size = get32(glb.bytes + 12);
    g_assert_true(memcmp(glb.bytes + 16, "JSON", 4) == 0);
    g_assert_cmpuint(json_size % 4, ==, 0);
    json_error_t error;
    glb.json = json_loadb(glb.bytes + 20, json_size, JSON_REJECT_DUPLICATES, &error);
    if (glb.json == NULL) {
        g_error("%s at %d", error.text, error.position);
    }
    size_t at = 20 + json_size;
    if (at < size) {
        glb.buffer_size = get32(glb.bytes + at);
        g_assert_true(memcmp(glb.bytes + at + 4, "BIN\0", 4) == 0);
        g_assert_cmpuint(at + 8 + glb.buffer_size, ==, size);
        glb.buffer = (const uint8_t *)glb.bytes + at + 8;
    }
    return glb;
}

static inline void glb_clear(Glb *glb) {
    json_decref(glb->json);
    g_free(glb->bytes);
}

static inline json_t *member(const json_t *json, const char *key) {
    return json_object_get(json, key);
}

/// Element `index` of the top-level array `key`.
static inline json_t *element(const Glb *glb, const char *key, json_int_t index) {
    json_t *found = json_array_get(member(glb->json, key), (size_t)index);
    g_assert_nonnull(found);
    return found;
}

static inline json_int_t integer(const json_t *json, const char *key) {
    return json_integer_value(member(json, key));
}

/// One number of an accessor of floats or indices, wherever it lies.
static inline double accessor_value(const Glb *glb, json_int_t accessor, size_t row, int column) {
    json_t *about = element(glb, "accessors", accessor);
    json_t *view = element(glb, "bufferViews", integer(about, "bufferView"));
    const char *type = json_string_value(member(about, "type"));
    size_t columns = strcmp(type, "SCALAR") == 0 ? 1 : (size_t)(type[3] - '0');
    size_t stride = member(view, "byteStride") ? (size_t)integer(view, "byteStride") : 4 * columns;
    size_t at = (size_t)integer(about, "byteOffset") + row * stride + 4 * (size_t)column;
    g_assert_cmpuint(row, <, (size_t)integer(about, "count"));
    g_assert_cmpuint(at + 4, <=, (size_t)integer(view, "byteLength"));
    at += (size_t)integer(view, "byteOffset");
    g_assert_cmpuint(at + 4, <=, glb->buffer_size);
    if (integer(about, "componentType") == 5125) {
        return get32((const char *)glb->buffer + at);
    }
    float value;
    memcpy(&value, glb->buffer + at, sizeof value);
    return (double)value;
}

/// A vector of a node or an accessor of min and max; `missing` where it is left out.
static inline double part_of(const json_t *json, const char *key, size_t index, double missing) {
    json_t *value = json_array_get(member(json, key), index);
    return value == NULL ? missing : json_number_value(value);
}
