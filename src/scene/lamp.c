/// A lamp of a document in the terms of light.
#include "frond/scene.h"

#include <cglm/struct.h>

FrLamp fr_scene_lamp(const FrLampParams *params) {
    static const FrLampKind kinds[] = {FR_LAMP_POINT, FR_LAMP_SPOT, FR_LAMP_AREA};
    FrLamp lamp = {.kind = kinds[params->kind],
                   .power = params->power,
                   .position = params->at,
                   .direction = glms_vec3_normalize(params->direction),
                   .angle = (float)params->angle};
    if (lamp.kind == FR_LAMP_AREA) {
        versors frame = fr_frame_from_heading(lamp.direction, (vec3s){{0, 1, 0}});
        frame = glms_quat_mul(frame, fr_rotation_about((vec3s){{0, 0, 1}}, (float)params->turn));
        lamp.side[0] = glms_vec3_scale(fr_frame_left(frame), (float)params->width);
        lamp.side[1] = glms_vec3_scale(fr_frame_up(frame), (float)params->height);
        lamp.position = glms_vec3_muladds(lamp.side[0], -0.5F, lamp.position);
        lamp.position = glms_vec3_muladds(lamp.side[1], -0.5F, lamp.position);
    }
    return lamp;
}
