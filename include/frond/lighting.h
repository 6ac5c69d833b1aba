/// @file lighting.h
/// The light of a scene: its plants and obstacles as what stands in the way, its sun, sky and
/// lamps as what shines, and the backend that its document asks for.
#pragma once

#include "frond/light_field.h"
#include "frond/scene.h"

typedef struct FrLighting FrLighting;

/// The scene's `<light>`, or the defaults. The document must outlive it.
FR_API FR_MUST_USE FrStatus fr_lighting_new(const FrScene *scene, const FrContext *context,
                                            FrLighting **lighting);
FR_API void fr_lighting_free(FrLighting *lighting);
/// Tells that light will be asked for in a box of the world: suns and skies shine there too from
/// the next fr_lighting_update() on, which itself does so for all that stands in the scene.
FR_API void fr_lighting_widen(FrLighting *lighting, const FrScene *scene, const double min[3],
                              const double max[3]);

/// Lights the scene as it is now. Plants that are the same objects as before are not meshed anew;
/// a changed plant must be a new one. Plants of the scene that are NULL are not there.
FR_API FR_MUST_USE FrStatus fr_lighting_update(FrLighting *lighting, const FrScene *scene,
                                               const FrContext *context);
/// The box that suns and skies shine on so far, lowest and highest corner.
FR_API void fr_lighting_room(const FrLighting *lighting, vec3s room[2]);
FR_API void fr_lighting_set_room(FrLighting *lighting, const vec3s room[2]);
/// Tells that these plants (FrPlant *; NULL: all) are freed before the next update: what stands in
/// their place is meshed anew, even where it has the address of one of them.
FR_API void fr_lighting_detach(FrLighting *lighting, const GPtrArray *plants);
/// Answers for points of the world. fr_lighting_update() came first.
FR_API FR_MUST_USE FrStatus fr_lighting_query(FrLighting *lighting, const vec3s *points,
                                              size_t count, const FrContext *context,
                                              FrLightAnswer *answers);
/// Directions to the light in a box; see fr_light_field_new().
FR_API FR_MUST_USE FrStatus fr_lighting_field(FrLighting *lighting, const FrLightPlace *place,
                                              vec3s min, vec3s max, uint32_t cells,
                                              const FrContext *context, FrLightField **field);
/// What its backend keeps: fr_light_rays(), fr_light_cells().
FR_API GArray *fr_lighting_rays(const FrLighting *lighting, uint32_t most);
FR_API GArray *fr_lighting_cells(const FrLighting *lighting, uint32_t most);
/// The points asked for are done with.
FR_API void fr_lighting_forget(FrLighting *lighting);
FR_API FrLightStats fr_lighting_stats(const FrLighting *lighting);
