/// The smallest box around a scene: nodes with their radii, organs as balls around their bases.
#include "frond/scene.h"

#include "plant/deform.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct Box {
    vec3s min, max;
} Box;

static void add_ball(Box *box, vec3s centre, float radius) {
    box->min = glms_vec3_minv(box->min, glms_vec3_subs(centre, radius));
    box->max = glms_vec3_maxv(box->max, glms_vec3_adds(centre, radius));
}

/// How far a shape of scale 1 reaches from its base.
static float reach_of(const FrShape *shape) {
    if (shape->kind == FR_SHAPE_BLADE) {
        return shape->blade.petiole_length + shape->blade.rachis_length * 2 +
               shape->blade.leaflet_petiole +
               hypotf(shape->blade.length, 0.5F * shape->blade.width);
    }
    vec3s half = {{0.5F * shape->size.x, 0.5F * shape->size.y, shape->size.z}};
    return glms_vec3_norm(half);
}

/// The corners of the box that a primitive fills, where it is placed.
static void add_corners(Box *box, const FrShape *shape, vec3s position, versors rotation,
                        float scale) {
    for (int corner = 0; corner < 8; corner++) {
        vec3s local = {{(corner & 1) != 0 ? 0.5F * shape->size.x : -0.5F * shape->size.x,
                        (corner & 2) != 0 ? 0.5F * shape->size.y : -0.5F * shape->size.y,
                        (corner & 4) != 0 ? shape->size.z : 0}};
        vec3s at = glms_quat_rotatev(rotation, glms_vec3_scale(local, scale));
        add_ball(box, glms_vec3_add(position, at), 0);
    }
}

/// Where deformations of triangles take a point.
static vec3s deformed(const FrScopes *scopes, uint32_t scope, vec3s at) {
    if (scopes != NULL && scope != FR_NONE && scopes->has_triangles[scope]) {
        vec3s side = {{0, 0, 1}};
        fr_scopes_move_vertex(scopes, scope, &at, &side, NULL);
    }
    return at;
}

static Box posed_box(const FrPlant *plant, const FrScopes *scopes) {
    Box box = {{{INFINITY, INFINITY, INFINITY}}, {{-INFINITY, -INFINITY, -INFINITY}}};
    if (scopes == NULL) {
        fr_plant_bounds(plant, &box.min, &box.max);
    }
    const uint16_t unseen = FR_SHED | FR_HIDDEN;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        if ((plant->nodes.flags[i] & unseen) == 0) {
            uint32_t scope = plant->axes.deformer[plant->nodes.axis[i]];
            vec3s tip = deformed(scopes, scope, plant->nodes.position[i]);
            add_ball(&box, tip, plant->nodes.radius[i]);
        }
    }
    for (uint32_t i = 0; i < plant->axes.count && scopes != NULL; i++) {
        if ((plant->axes.flags[i] & unseen) == 0) {
            vec3s origin = fr_plant_axis_origin(plant, i);
            add_ball(&box, deformed(scopes, plant->axes.deformer[i], origin), 0);
        }
    }
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        uint32_t shape = plant->organs.shape[i];
        if ((plant->organs.flags[i] & unseen) != 0 || shape == FR_NONE) {
            continue;
        }
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(plant, i, &position, &rotation);
        const FrShape *form = &g_array_index(plant->shapes, FrShape, shape);
        float scale = plant->organs.scale[i];
        if (scopes == NULL && form->kind >= FR_SHAPE_BOX && form->kind <= FR_SHAPE_TRIANGLE) {
            add_corners(&box, form, position, rotation, scale);
        } else {
            position = deformed(scopes, plant->organs.deformer[i], position);
            add_ball(&box, position, scale * reach_of(form));
        }
    }
    return box;
}

static Box plant_box(const FrPlant *plant) {
    FrScopes *scopes = fr_scopes_new(plant);
    if (scopes == NULL) {
        return posed_box(plant, NULL);
    }
    FrPlant *moved = scopes->has_skeleton ? fr_scopes_move_skeleton(scopes, NULL) : NULL;
    fr_scopes_settle(scopes);
    Box box = posed_box(moved != NULL ? moved : plant, scopes);
    fr_plant_free(moved);
    fr_scopes_free(scopes);
    return box;
}

/// Adds a plant's box where it stands.
static void add_stand(const FrStand *stand, const Box *box, double min[3], double max[3]) {
    double sine = sin(stand->turn), cosine = cos(stand->turn);
    for (int corner = 0; corner < 8; corner++) {
        double x = (double)((corner & 1) != 0 ? box->max.x : box->min.x) * stand->scale;
        double y = (double)((corner & 2) != 0 ? box->max.y : box->min.y) * stand->scale;
        double z = (double)((corner & 4) != 0 ? box->max.z : box->min.z) * stand->scale;
        double point[3] = {stand->at[0] + cosine * x - sine * y,
                           stand->at[1] + sine * x + cosine * y, stand->at[2] + z};
        for (int axis = 0; axis < 3; axis++) {
            min[axis] = fmin(min[axis], point[axis]);
            max[axis] = fmax(max[axis], point[axis]);
        }
    }
}

void fr_scene_bounds(const FrScene *scene, double min[3], double max[3]) {
    for (int axis = 0; axis < 3; axis++) {
        min[axis] = INFINITY;
        max[axis] = -INFINITY;
    }
    Box *boxes = g_new(Box, scene->plants->len + 1);
    for (guint i = 0; i < scene->plants->len; i++) {
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        boxes[i] = plant != NULL ? plant_box(plant) : (Box){.min = {{1, 1, 1}}};
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const Box *box = &boxes[stand->plant];
        if (box->min.x <= box->max.x) {
            add_stand(stand, box, min, max);
        }
    }
    g_free(boxes);
}
