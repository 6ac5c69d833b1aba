/// @file formats.h
/// One function a file format. `stats` is zeroed by the caller.
#pragma once

#include "frond/io.h"

FrStatus fr_glb_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
FrStatus fr_gltf_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats);
FrStatus fr_free_form_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                            const FrContext *context, FrIoStats *stats);
FrStatus fr_iges_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats);
FrStatus fr_lines_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                        const FrContext *context, FrIoStats *stats);
FrStatus fr_mtg_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
FrStatus fr_obj_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
FrStatus fr_opf_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
FrStatus fr_ply_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
FrStatus fr_stl_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
FrStatus fr_three_mf_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                           const FrContext *context, FrIoStats *stats);
FrStatus fr_step_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats);
FrStatus fr_usd_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats);
