/// @file fold_box.h
/// The picture between a panel and the inspector, with dividers that are dragged. Either can be
/// folded away; where not all have room, the one that was asked for last stays.
#pragma once

#include <adwaita.h>

#define STUDIO_TYPE_FOLD_BOX (studio_fold_box_get_type())
G_DECLARE_FINAL_TYPE(StudioFoldBox, studio_fold_box, STUDIO, FOLD_BOX, GtkWidget)

typedef enum StudioPane { STUDIO_PANE_SIDE, STUDIO_PANE_INSPECTOR, STUDIO_PANE_COUNT } StudioPane;

/// It emits "folded" when what is shown changes.
GtkWidget *studio_fold_box_new(GtkWidget *side, GtkWidget *middle, GtkWidget *inspector);
/// In pixels, as far as there is room; called before it is shown.
void studio_fold_box_set_width(StudioFoldBox *box, StudioPane pane, int width);
/// The width of a pane, or what it had when it was shown last.
int studio_fold_box_width(const StudioFoldBox *box, StudioPane pane);
/// Folds a pane away or asks for it, which may fold the other one away.
void studio_fold_box_want(StudioFoldBox *box, StudioPane pane, bool is_wanted);
/// Whether it would be shown if there were room.
bool studio_fold_box_is_wanted(const StudioFoldBox *box, StudioPane pane);
bool studio_fold_box_is_shown(const StudioFoldBox *box, StudioPane pane);
