/// @file sequence.h
/// Scenes of one document at several times, as for a film. What grows step by step is grown once:
/// a later scene goes on from where the last one has come to.
#pragma once

#include "frond/simulation.h"

typedef struct FrSequence FrSequence;

/// `options` as for each scene; their time does not matter. The document and what options point to
/// must outlive the sequence.
FR_API FrSequence *fr_sequence_new(const FrDocument *document, const FrSceneOptions *options);
FR_API void fr_sequence_free(FrSequence *sequence);
/// The scene at `time`, years: bit for bit that of fr_scene_build_with(). It grows from the seeds
/// where the last scene was of a later step, and where anything that does not grow step by step
/// differs from that scene: a p-graph has another age and so stands otherwise in the way. After a
/// failure the next scene grows from the seeds. The caller frees the scene.
FR_API FR_MUST_USE FrStatus fr_sequence_scene(FrSequence *sequence, double time,
                                              const FrContext *context, FrScene **scene);
