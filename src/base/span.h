/// @file span.h
/// Spans compared. Private to the library.
#pragma once

#include "frond/diag.h"

/// True for two that begin at the same place of the same text.
static inline bool fr_span_is_same(FrSpan a, FrSpan b) {
    return a.source == b.source && a.begin == b.begin;
}
