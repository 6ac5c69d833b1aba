/// What others read of the scene that is shown: places, the ground, what a ray meets.
#include "studio/model/builder_private.h"

const FrScene *studio_builder_shown(const StudioBuilder *builder) {
    return builder->is_changing ? NULL : builder->scene;
}

void studio_builder_use(StudioBuilder *builder, StudioUse use, void *user) {
    g_mutex_lock(&builder->lock); // nothing begins while it is held
    use(user, studio_builder_shown(builder));
    g_mutex_unlock(&builder->lock);
}

StudioHit studio_builder_hit(StudioBuilder *builder, const double origin[3],
                             const double direction[3], double spread) {
    g_mutex_lock(&builder->lock);
    const FrScene *scene = studio_builder_shown(builder);
    StudioHit hit = studio_ground_hit(builder->ground, scene, origin, direction, spread);
    g_mutex_unlock(&builder->lock);
    return hit;
}

StudioGround *studio_builder_ground(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    StudioGround *ground = studio_ground_ref(builder->ground);
    g_mutex_unlock(&builder->lock);
    return ground;
}

GArray *studio_builder_stands(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    GArray *stands = builder->stands != NULL ? g_array_ref(builder->stands)
                                             : g_array_new(FALSE, FALSE, sizeof(StudioStand));
    g_mutex_unlock(&builder->lock);
    return stands;
}

bool studio_builder_footing(StudioBuilder *builder, const char *plant, const char *component,
                            StudioFooting *footing) {
    g_mutex_lock(&builder->lock);
    const StudioFooting *found = studio_footing_find(builder->footings, plant, component);
    *footing = found == NULL ? (StudioFooting){0} : *found;
    footing->plant = footing->component = NULL; // they are the builder's
    g_mutex_unlock(&builder->lock);
    return found != NULL;
}

bool studio_builder_bounds(StudioBuilder *builder, uint32_t origin, double min[3], double max[3]) {
    g_mutex_lock(&builder->lock);
    bool is_there = studio_ground_bounds(studio_builder_shown(builder), origin, min, max);
    g_mutex_unlock(&builder->lock);
    return is_there;
}
