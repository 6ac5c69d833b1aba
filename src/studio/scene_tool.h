/// @file scene_tool.h
/// Tools that arrange a scene with the pointer: plant, paint, move, take out, obstacles, roads,
/// envelopes. They hang on the viewport of a window; every change is an edit of its document.
#pragma once

#include "studio/window.h"

typedef struct StudioSceneTool StudioSceneTool;

/// Adds the tools, what they draw and their actions to a window whose viewport is in `overlay`.
StudioSceneTool *studio_scene_tool_new(StudioWindow *window, GtkOverlay *overlay);
/// The window goes, or has another document: nothing is held any more.
void studio_scene_tool_reset(StudioSceneTool *tool);
void studio_scene_tool_free(StudioSceneTool *tool);
/// The document or what is selected has changed.
void studio_scene_tool_update(StudioSceneTool *tool);
/// A point of the picture (−1 to 1) was clicked. False: it is none of the tools' business.
bool studio_scene_tool_click(StudioSceneTool *tool, double x, double y);
