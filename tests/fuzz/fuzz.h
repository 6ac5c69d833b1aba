/// @file fuzz.h
/// What a fuzz harness defines: libFuzzer calls it with new inputs, replay.c with known ones.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Must survive every input. Returns 0.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
