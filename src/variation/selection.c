// Selecting a path of branches with one stroke of a pen over a view of the skeleton.
//
// After: Sketch-based plant variation, section 4.1. A branch is selected for certain only once one
// that it bears is touched: what lies beside the way is then let go again.
#include "frond/variation.h"

#include <math.h>

// A longer move of the pen within one event touches only where it ends.
#define LONGEST_MOVE 100000.0

typedef struct Touched {
    uint32_t branch;
    uint64_t pixels;
} Touched;

struct FrSelection {
    const FrPlant *plant;
    uint8_t *state;       ///< FrSelectionState of every axis
    GArray *path;         ///< uint32_t, from the base on
    GArray *undetermined; ///< Touched
    bool is_down;
    double x, y; ///< where the pen was
};

FrSelection *fr_selection_new(const FrPlant *plant) {
    FrSelection *selection = g_new0(FrSelection, 1);
    *selection = (FrSelection){.plant = plant,
                               .state = g_new0(uint8_t, plant->axes.count + 1),
                               .path = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
                               .undetermined = g_array_new(FALSE, FALSE, sizeof(Touched))};
    return selection;
}

void fr_selection_free(FrSelection *selection) {
    if (selection != NULL) {
        g_free(selection->state);
        g_array_unref(selection->path);
        g_array_unref(selection->undetermined);
        g_free(selection);
    }
}

static void let_go(FrSelection *selection) {
    for (guint i = 0; i < selection->undetermined->len; i++) {
        Touched touched = g_array_index(selection->undetermined, Touched, i);
        selection->state[touched.branch] = FR_UNSELECTED;
    }
    g_array_set_size(selection->undetermined, 0);
}

void fr_selection_clear(FrSelection *selection) {
    let_go(selection);
    for (guint i = 0; i < selection->path->len; i++) {
        selection->state[g_array_index(selection->path, uint32_t, i)] = FR_UNSELECTED;
    }
    g_array_set_size(selection->path, 0);
    selection->is_down = false;
}

/// The branch that bears a branch, FR_NONE.
static uint32_t bearer_of(const FrPlant *plant, uint32_t branch) {
    uint32_t node = plant->axes.bearer[branch];
    return node == FR_NONE ? FR_NONE : plant->nodes.axis[node];
}

static void select_branch(FrSelection *selection, uint32_t branch) {
    selection->state[branch] = FR_SELECTED;
    g_array_append_val(selection->path, branch);
}

static void hold(FrSelection *selection, uint32_t branch) {
    Touched touched = {branch, 1};
    selection->state[branch] = FR_UNDETERMINED;
    g_array_append_val(selection->undetermined, touched);
}

static void count_again(FrSelection *selection, uint32_t branch) {
    for (guint i = 0; i < selection->undetermined->len; i++) {
        Touched *touched = &g_array_index(selection->undetermined, Touched, i);
        touched->pixels += touched->branch == branch;
    }
}

void fr_selection_touch(FrSelection *selection, uint32_t branch) {
    if (branch == FR_NONE || branch >= selection->plant->axes.count ||
        selection->state[branch] == FR_SELECTED) {
        return;
    }
    if (selection->path->len == 0) {
        select_branch(selection, branch);
        return;
    }
    if (selection->state[branch] == FR_UNDETERMINED) {
        count_again(selection, branch);
        return;
    }
    uint32_t bearer = bearer_of(selection->plant, branch);
    uint32_t last = g_array_index(selection->path, uint32_t, selection->path->len - 1);
    if (bearer == last) {
        hold(selection, branch);
    } else if (bearer != FR_NONE && selection->state[bearer] == FR_UNDETERMINED) {
        let_go(selection);
        select_branch(selection, bearer);
        hold(selection, branch);
    }
}

static void touch_pixel(FrSelection *selection, const FrIdBuffer *view, double x, double y) {
    if (x >= 0 && y >= 0 && x < view->width && y < view->height) {
        size_t pixel = (size_t)y * view->width + (size_t)x;
        fr_selection_touch(selection, view->branch[pixel]);
    }
}

void fr_selection_move(FrSelection *selection, const FrIdBuffer *view, double x, double y) {
    if (!isfinite(x) || !isfinite(y)) {
        return;
    }
    double length = fmax(fabs(x - selection->x), fabs(y - selection->y));
    if (selection->is_down && length <= LONGEST_MOVE) {
        int steps = (int)ceil(length);
        for (int s = 1; s < steps; s++) {
            double part = (double)s / steps;
            touch_pixel(selection, view, selection->x + part * (x - selection->x),
                        selection->y + part * (y - selection->y));
        }
    }
    touch_pixel(selection, view, x, y);
    selection->is_down = true;
    selection->x = x;
    selection->y = y;
}

void fr_selection_end(FrSelection *selection, FrSelectionEnd end) {
    selection->is_down = false;
    guint count = selection->undetermined->len;
    if (count == 0) {
        return;
    }
    guint most = 0;
    for (guint i = 1; i < count; i++) {
        if (g_array_index(selection->undetermined, Touched, i).pixels >
            g_array_index(selection->undetermined, Touched, most).pixels) {
            most = i;
        }
    }
    GArray *held = g_array_copy(selection->undetermined);
    let_go(selection);
    for (guint i = 0; i < count; i++) {
        if (end == FR_END_PUBLISHED || i == most) {
            select_branch(selection, g_array_index(held, Touched, i).branch);
        }
    }
    g_array_unref(held);
}

/// Appends the path from `low` up to `high` in reverse; false if `low` does not bear `high`.
static bool collect(const FrPlant *plant, uint32_t low, uint32_t high, GArray *reversed) {
    for (uint32_t branch = high; branch != FR_NONE; branch = bearer_of(plant, branch)) {
        g_array_append_val(reversed, branch);
        if (branch == low) {
            return true;
        }
    }
    g_array_set_size(reversed, 0);
    return false;
}

bool fr_selection_between(FrSelection *selection, uint32_t one, uint32_t other) {
    uint32_t count = selection->plant->axes.count;
    if (one >= count || other >= count) {
        return false;
    }
    GArray *reversed = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    bool is_path = collect(selection->plant, one, other, reversed) ||
                   collect(selection->plant, other, one, reversed);
    if (is_path) {
        fr_selection_clear(selection);
        for (guint i = reversed->len; i-- > 0;) {
            select_branch(selection, g_array_index(reversed, uint32_t, i));
        }
    }
    g_array_unref(reversed);
    return is_path;
}

FrSelectionState fr_selection_state(const FrSelection *selection, uint32_t branch) {
    return (FrSelectionState)selection->state[branch];
}

char *fr_selection_choice(const FrSelection *selection) {
    GString *choice = g_string_new(NULL);
    for (guint i = 0; i < selection->path->len; i++) {
        uint32_t branch = g_array_index(selection->path, uint32_t, i);
        g_string_append_printf(choice, "%s#%016" G_GINT64_MODIFIER "x", i > 0 ? " " : "",
                               selection->plant->axes.path[branch]);
    }
    return g_string_free(choice, FALSE);
}
