/// @file limits.h
/// How much a document may ask for. Every engine counts what it will make before it makes it.
#pragma once

#include "frond/diag.h"

/// X(field, default, what is counted). `--limit field=value` changes one.
#define FR_LIMITS(X)                                                                               \
    X(document_bytes, 64000000, "bytes of one document or included file")                          \
    X(elements, 200000, "XML elements of a document")                                              \
    X(nesting, 64, "depth of nested XML elements")                                                 \
    X(instances, 20000000, "component instances of one plant")                                     \
    X(nodes, 40000000, "internodes of one plant")                                                  \
    X(organs, 20000000, "leaves, flowers and other organs of one plant")                           \
    X(shapes, 65536, "distinct organ shapes of one plant")                                         \
    X(depth, 4096, "generations of a recursion")                                                   \
    X(scopes, 64, "deformations or fields within one another")                                     \
    X(modules, 400000000, "modules of the string of an L-system")                                  \
    X(steps, 1000000000, "steps of the derivation of an L-system")                                 \
    X(iterations, 100000000, "times around the loops of an L-system in one step")                  \
    X(plants, 100000, "plants of a scene")                                                         \
    X(photons, 20000000, "photons of one light")                                                   \
    X(plant_triangles, 25000000, "triangles of the surface of one plant")                          \
    X(triangles, 400000000, "triangles of one output")                                             \
    X(pixels, 100000000, "pixels of one picture or texture")                                       \
    X(bytes, 16000000000, "bytes of the arrays of one plant or mesh")

typedef struct FrLimits {
#define FR_LIMIT_FIELD(field, value, meaning) uint64_t field; ///< meaning
    FR_LIMITS(FR_LIMIT_FIELD)
#undef FR_LIMIT_FIELD
} FrLimits;

FR_API FrLimits fr_limits_default(void);
/// Sets one limit by name. FR_ERR_USAGE and a diagnostic with the nearest name if there is none.
FR_API FrStatus fr_limits_set(FrLimits *limits, const char *name, const char *value,
                              FrDiags *diags);
/// FR_OK if `wanted <= limit`; otherwise FR_ERR_LIMIT and the error "limit-<name>", which names
/// the limit, its value, what was wanted and who asked (`culprit`, a component or production).
FR_API FR_MUST_USE FrStatus fr_limit_check(uint64_t wanted, uint64_t limit, const char *limit_name,
                                           const char *culprit, FrSpan span, FrDiags *diags);
/// Products and sums of counts that stop at UINT64_MAX instead of wrapping.
FR_API uint64_t fr_count_add(uint64_t a, uint64_t b);
FR_API uint64_t fr_count_multiply(uint64_t a, uint64_t b);
