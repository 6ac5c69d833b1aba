// IGES 5.3: every surface a rational B-spline surface (entity 128) with a colour (entity 314).
// ANSI US PRO/IPO-100-1996. A file is lines of 80 columns in the sections S, G, D, P and T. The
// directory (D) comes before the parameters (P) and tells how many lines each has, so parameters
// are laid out twice: once to count, once to write.
#include "io/formats.h"
#include "io/nurbs_scene.h"

#include <stdio.h>
#include <string.h>

enum { COLUMNS = 80, DATA = 64, GLOBAL_DATA = 72, LINES_MOST = 9999999, POINT_BYTES = 90 };

typedef struct FrIges {
    const FrScene *scene;
    const FrContext *context;
    FrIoNurbs nurbs;
    uint32_t *lines; ///< by surface: of its parameters
    uint64_t bytes;
} FrIges;

/// Parameters on their way into lines.
typedef struct FrParameters {
    FrOutput *output; ///< NULL: only counted
    char data[DATA + 1];
    int used;
    uint32_t lines;     ///< so far, of all entities
    uint32_t directory; ///< line in the directory of the entity
} FrParameters;

static void end_line(FrParameters *p) {
    p->lines++;
    if (p->output != NULL) {
        char line[COLUMNS + 2];
        p->data[p->used] = '\0';
        g_snprintf(line, sizeof line, "%-64s %7uP%7u\n", p->data, p->directory, p->lines);
        fr_output_bytes(p->output, line, COLUMNS + 1);
    }
    p->used = 0;
}

// A parameter and the delimiter behind it stay on one line.
static void add_text(FrParameters *p, const char *text, int length, char delimiter) {
    if (p->used + length + 1 > DATA) {
        end_line(p);
    }
    memcpy(p->data + p->used, text, (size_t)length);
    p->used += length;
    p->data[p->used++] = delimiter;
    if (delimiter == ';') {
        end_line(p);
    }
}

static void add_integer(FrParameters *p, uint32_t value) {
    char text[16];
    add_text(p, text, g_snprintf(text, sizeof text, "%u", value), ',');
}

static void add_real(FrParameters *p, double value, int digits, char delimiter) {
    char text[FR_REAL_ROOM];
    int length = fr_real_text(text, value, digits);
    add_text(p, text, length, delimiter);
}

static bool same_point(const double a[4], const double b[4]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static void closure(const FrNurbsSurface *s, bool *in_u, bool *in_v) {
    *in_u = *in_v = true;
    for (uint32_t j = 0; j < s->count_v; j++) {
        const double(*row)[4] = s->points + (size_t)j * s->count_u;
        *in_u = *in_u && same_point(row[0], row[s->count_u - 1]);
    }
    size_t last = (size_t)(s->count_v - 1) * s->count_u;
    for (uint32_t i = 0; i < s->count_u; i++) {
        *in_v = *in_v && same_point(s->points[i], s->points[last + i]);
    }
}

static void add_surface(FrParameters *p, const FrNurbsSurface *s, const FrPose *pose) {
    bool in_u, in_v, is_rational = false;
    size_t count = (size_t)s->count_u * s->count_v;
    closure(s, &in_u, &in_v);
    for (size_t i = 0; i < count; i++) {
        is_rational = is_rational || s->points[i][3] != s->points[0][3];
    }
    const uint32_t head[] = {128,  s->count_u - 1, s->count_v - 1, s->degree_u, s->degree_v,
                             in_u, in_v,           !is_rational,   0,           0};
    for (size_t i = 0; i < G_N_ELEMENTS(head); i++) {
        add_integer(p, head[i]);
    }
    for (uint32_t i = 0; i < s->count_u + s->degree_u + 1; i++) {
        add_real(p, s->knots_u[i], 17, ',');
    }
    for (uint32_t i = 0; i < s->count_v + s->degree_v + 1; i++) {
        add_real(p, s->knots_v[i], 17, ',');
    }
    for (size_t i = 0; i < count; i++) {
        add_real(p, s->points[i][3], 17, ',');
    }
    for (size_t i = 0; i < count; i++) {
        double at[4];
        fr_io_nurbs_posed(pose, s->points[i], at);
        for (int k = 0; k < 3; k++) {
            add_real(p, at[k], 15, ',');
        }
    }
    double u[2], v[2];
    fr_nurbs_range(s->knots_u, s->degree_u, s->count_u, u);
    fr_nurbs_range(s->knots_v, s->degree_v, s->count_v, v);
    add_real(p, u[0], 17, ',');
    add_real(p, u[1], 17, ',');
    add_real(p, v[0], 17, ',');
    add_real(p, v[1], 17, ';');
}

static void add_colour(FrParameters *p, const double rgb[3]) {
    add_integer(p, 314);
    for (int k = 0; k < 3; k++) {
        add_real(p, 100.0 * rgb[k], 5, k < 2 ? ',' : ';');
    }
}

typedef void (*FrPieceFn)(FrIges *iges, FrParameters *p, uint64_t surface, uint32_t plant,
                          const FrNurbsPiece *piece, const FrPose *pose);

/// Does every colour, then every surface of every stand.
static void each_piece(FrIges *iges, FrParameters *p, FrPieceFn body) {
    uint64_t surface = 0;
    for (guint s = 0; s < iges->scene->stands->len; s++) {
        const FrStand *stand = fr_io_stand(iges->scene, s);
        const FrNurbsSkin *skin = iges->nurbs.skins[stand->plant];
        FrPose pose = fr_io_pose(stand, FR_UP_Z);
        for (uint64_t i = 0; i < skin->count; i++) {
            body(iges, p, surface++, stand->plant, &skin->pieces[i], &pose);
        }
        if (p->output != NULL) {
            fr_progress_report(iges->context->progress, "write",
                               (double)(s + 1) / iges->scene->stands->len);
        }
    }
}

static void add_colours(const FrIges *iges, FrParameters *p) {
    p->directory = 1;
    for (uint32_t plant = 0; plant < iges->nurbs.length; plant++) {
        double rgb[3];
        for (uint32_t n = 0; fr_io_nurbs_rgb(iges->scene, plant, n, rgb); n++) {
            add_colour(p, rgb);
            p->directory += 2;
        }
    }
}

static void count_piece(FrIges *iges, FrParameters *p, uint64_t surface, uint32_t plant,
                        const FrNurbsPiece *piece, const FrPose *pose) {
    (void)plant;
    uint32_t before = p->lines;
    // Past what the format holds all is lost anyway.
    if (before <= LINES_MOST) {
        add_surface(p, &piece->surface, pose);
    }
    iges->lines[surface] = p->lines - before;
}

static void write_piece(FrIges *iges, FrParameters *p, uint64_t surface, uint32_t plant,
                        const FrNurbsPiece *piece, const FrPose *pose) {
    (void)iges, (void)surface, (void)plant;
    add_surface(p, &piece->surface, pose);
    p->directory += 2;
}

static void directory_entry(FrParameters *p, int type, uint32_t lines, int colour) {
    static const char *const labels[] = {"SURFACE", "COLOUR"};
    char text[2 * (COLUMNS + 1) + 1];
    g_snprintf(text, sizeof text,
               "%8d%8u%8d%8d%8d%8d%8d%8d%8sD%7u\n%8d%8d%8d%8u%8d%8s%8s%8s%8dD%7u\n", type,
               p->lines + 1, 0, 0, 0, 0, 0, 0, type == 314 ? "00000200" : "00000000", p->directory,
               type, 0, colour, lines, 0, "", "", labels[type == 314], 0, p->directory + 1);
    fr_output_bytes(p->output, text, 2 * (COLUMNS + 1));
    p->directory += 2;
    p->lines += lines;
}

static void write_entry(FrIges *iges, FrParameters *p, uint64_t surface, uint32_t plant,
                        const FrNurbsPiece *piece, const FrPose *pose) {
    (void)pose;
    uint32_t colour = fr_io_nurbs_colour(&iges->nurbs, plant, piece);
    directory_entry(p, 128, iges->lines[surface], -(int)(2 * colour + 1));
}

/// Start and global section; answers the lines of the latter. The date is no date, so that the same
/// plant makes the same file.
static uint32_t write_head(FrOutput *output) {
    static const char global[] =
        "1H,,1H;,5Hplant,5Hplant,11HFrond " FR_VERSION ",11HFrond " FR_VERSION
        ",32,38,7,308,15,5Hplant,1.,6,1HM,1,0.01,15H20000101.000000,1.E-7,0.,5HFrond,5HFrond,11,0,"
        "15H20000101.000000;";
    char line[COLUMNS + 2];
    g_snprintf(line, sizeof line, "%-72sS%7d\n", "Plant by Frond: metres, z up", 1);
    fr_output_text(output, line);
    uint32_t lines = 0;
    for (size_t at = 0; at < sizeof global - 1; at += GLOBAL_DATA) {
        g_snprintf(line, sizeof line, "%-72.72sG%7u\n", global + at, ++lines);
        fr_output_text(output, line);
    }
    return lines;
}

static bool write_iges(void *user, int descriptor) {
    FrIges *iges = user;
    FrOutput output;
    fr_output_start(&output, descriptor, iges->context->progress);
    uint32_t global = write_head(&output);
    FrParameters entries = {.output = &output, .directory = 1};
    for (uint32_t i = 0; i < iges->nurbs.colours; i++) {
        directory_entry(&entries, 314, 1, 0);
    }
    each_piece(iges, &entries, write_entry);
    FrParameters parameters = {.output = &output};
    add_colours(iges, &parameters);
    each_piece(iges, &parameters, write_piece);
    char line[COLUMNS + 2];
    g_snprintf(line, sizeof line, "S%7dG%7uD%7uP%7u%40sT%7d\n", 1, global, entries.directory - 1,
               parameters.lines, "", 1);
    fr_output_text(&output, line);
    bool is_whole = fr_output_finish(&output);
    iges->bytes = output.done;
    return is_whole;
}

FrStatus fr_iges_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats) {
    FrIges iges = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status =
        fr_io_nurbs_make(&iges.nurbs, scene, &options->nurbs, false, POINT_BYTES, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    if (iges.nurbs.surfaces + iges.nurbs.colours > LINES_MOST / 2) {
        status = FR_ERR_LIMIT;
    } else {
        iges.lines = g_new(uint32_t, iges.nurbs.surfaces + 1);
        FrParameters count = {0};
        add_colours(&iges, &count);
        each_piece(&iges, &count, count_piece);
        status = count.lines > LINES_MOST ? FR_ERR_LIMIT : FR_OK;
    }
    if (status == FR_ERR_LIMIT) {
        fr_diags_add(context->diags, FR_ERROR, "limit-iges", (FrSpan){0},
                     "an IGES file numbers at most %d lines; this plant needs more: write .stp",
                     LINES_MOST);
    } else {
        status = fr_io_replace_file(path, write_iges, &iges, context->diags);
    }
    *stats = fr_io_nurbs_stats(&iges.nurbs, iges.bytes, start, skinned);
    g_free(iges.lines);
    fr_io_nurbs_clear(&iges.nurbs);
    return status;
}
