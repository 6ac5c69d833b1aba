/// @file params_graft.h
/// The parameters of Graft. Included by params.h.
#pragma once

#define FR_GRAFT_PARAMS(X)                                                                         \
    X(TEXT, plant, "", 0, 0, "", "", "id of the plant of this document that stands here")          \
    X(NUMBER, steps, "-1", -1, 1000000, "", "",                                                    \
      "steps of the growth of an L-system; -1: as many as it has itself")

typedef struct FrGraftParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_GRAFT_PARAMS(FR_PARAM_FIELD)
} FrGraftParams;

#define FR_GRAFT_ID(kind, field, ...) FR_GRAFT_##field,
enum { FR_GRAFT_BEFORE = FR_BASIC_COUNT - 1, FR_GRAFT_PARAMS(FR_GRAFT_ID) FR_GRAFT_COUNT };
#undef FR_GRAFT_ID
