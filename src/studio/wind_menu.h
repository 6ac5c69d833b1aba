/// @file wind_menu.h
/// A button that opens strength, direction and speed of the wind that is looked at.
#pragma once

#include "studio/window.h"

GtkWidget *studio_wind_button_new(StudioWindow *window);
/// The actions wind, wind-strength, wind-direction and wind-speed.
void studio_wind_add_actions(StudioWindow *window);
