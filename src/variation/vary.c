// What a variation is made of.
#include "variation/vary.h"

static void clear_drawn(void *data) {
    FrDrawn *drawn = data;
    fr_stroke_unref(drawn->stroke);
    g_free(drawn->choice);
    if (drawn->span.source != NULL) {
        fr_source_unref(drawn->span.source);
    }
}

static void clear_pushed(void *data) {
    FrPushed *pushed = data;
    g_free(pushed->choice);
    if (pushed->span.source != NULL) {
        fr_source_unref(pushed->span.source);
    }
}

FrVary *fr_vary_new(const FrVaryParams *params) {
    FrVary *vary = g_new0(FrVary, 1);
    fr_params_copy(fr_vary_table(), &vary->params, params);
    vary->strokes = g_array_new(FALSE, FALSE, sizeof(FrDrawn));
    g_array_set_clear_func(vary->strokes, clear_drawn);
    vary->indicators = g_array_new(FALSE, FALSE, sizeof(FrPushed));
    g_array_set_clear_func(vary->indicators, clear_pushed);
    return vary;
}

void fr_vary_free(FrVary *vary) {
    if (vary != NULL) {
        fr_params_clear(fr_vary_table(), &vary->params);
        g_array_unref(vary->strokes);
        g_array_unref(vary->indicators);
        g_free(vary);
    }
}

FrVaryParams *fr_vary_params(FrVary *vary) {
    return &vary->params;
}

static FrSpan kept(FrSpan span) {
    if (span.source != NULL) {
        fr_source_ref(span.source);
    }
    return span;
}

void fr_vary_add_stroke(FrVary *vary, FrStroke *stroke, const char *choice, FrApply apply,
                        FrSpan span) {
    FrDrawn drawn = {fr_stroke_ref(stroke), g_strdup(choice == NULL ? "" : choice), apply,
                     kept(span)};
    g_array_append_val(vary->strokes, drawn);
}

void fr_vary_add_indicator(FrVary *vary, vec3s vector, const char *choice, FrApply apply,
                           FrSpan span) {
    FrPushed pushed = {vector, g_strdup(choice == NULL ? "" : choice), apply, kept(span)};
    g_array_append_val(vary->indicators, pushed);
}
