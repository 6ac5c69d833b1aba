#include "plant/place.h"

FrSpan fr_plant_place(const FrPlant *plant) {
    return plant->components->len > 0 ? g_array_index(plant->components, FrComponent, 0).span
                                      : (FrSpan){0};
}
