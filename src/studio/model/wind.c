#include "studio/model/wind.h"

#include "studio/model/commands.h"
#include "studio/model/values.h"

#include <math.h>

// The tops give way by so much of the height at most.
static const double farthest = 0.27;
// A pause of the picture is none of the wind, s.
static const double longest_step = 0.1;
// Phases repeat, or they would lose their digits; a multiple of no gust's own length.
static const double round_trip = 3600;
static const double turn_unit = 3.14159265358979323846 / 180; // a degree

StudioWind studio_wind_default(void) {
    return (StudioWind){.strength = 0.3, .direction = 68, .speed = 1};
}

void studio_wind_advance(StudioWind *wind, double seconds) {
    wind->phase =
        fmod(wind->phase + wind->speed * fmin(fmax(seconds, 0), longest_step), round_trip);
}

void studio_wind_gust(const StudioWind *wind, double height, float gust[4]) {
    double turn = wind->direction * turn_unit;
    gust[0] = (float)(farthest * wind->strength * sin(turn));
    gust[1] = (float)(farthest * wind->strength * cos(turn));
    gust[2] = (float)wind->phase;
    gust[3] = (float)height;
}

// ---- of the document ---------------------------------------------------------------------------

// The element, and its vector; FR_NONE: there is none that can be read.
static uint32_t find_wind(const StudioDocument *document, uint32_t plant, double wind[3]) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t element = contents == NULL || plant == FR_NONE
                           ? FR_NONE
                           : fr_contents_child(contents, plant, "nurbs");
    char *text = element == FR_NONE ? NULL : fr_contents_get(contents, element, "wind");
    bool is_plain = studio_numbers_read(text == NULL ? "0, 0, 0" : text, 3, wind);
    g_free(text);
    return is_plain ? element : FR_NONE;
}

bool studio_wind_read(const StudioDocument *document, uint32_t plant, double *strength,
                      double *direction) {
    double wind[3];
    if (find_wind(document, plant, wind) == FR_NONE) {
        return false;
    }
    *strength = hypot(wind[0], wind[1]);
    *direction = fmod(atan2(wind[0], wind[1]) / turn_unit + 360, 360);
    return true;
}

bool studio_wind_write(StudioDocument *document, uint32_t plant, double strength,
                       double direction) {
    double wind[3];
    uint32_t element = find_wind(document, plant, wind);
    if (element == FR_NONE || studio_document_is_broken(document)) {
        return false;
    }
    wind[0] = strength * sin(direction * turn_unit);
    wind[1] = strength * cos(direction * turn_unit);
    char *text = studio_vector_text(wind, 1);
    bool is_changed = studio_set(document, element, "wind", text, true);
    g_free(text);
    return is_changed;
}
