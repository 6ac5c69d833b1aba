// Rational skin → triangles: choose grids, count, allocate once, write in parallel.
//
// A shell is a tube with its caps, the two halves of a blade, or one surface alone. Its surfaces
// are cut at the same parameters along the rims they share, so no cracks open between them.
#include "skin/nurbs_mesh.h"

#include "skin/solid.h"

#include "plant/place.h"

#include <string.h>

enum { SHELL_GRAIN = 64 };
/// Part of a plant's size that coordinates, floats, keep everywhere in it.
#define FINEST 1e-6

// ---- shells ------------------------------------------------------------------------------------

static bool goes_on_shell(const FrNurbsPiece *first, const FrNurbsPiece *piece) {
    bool is_cap = first->kind == FR_NURBS_TUBE &&
                  (piece->kind == FR_NURBS_FOOT || piece->kind == FR_NURBS_CAP);
    bool is_half = first->kind == FR_NURBS_RIGHT && piece->kind == FR_NURBS_LEFT;
    return (is_cap || is_half) && first->axis == piece->axis && first->organ == piece->organ &&
           first->surface.count_u == piece->surface.count_u;
}

static uint32_t slot_of(const FrNurbsMeshing *meshing, const FrNurbsPiece *piece) {
    uint32_t slot = piece->material == FR_NONE ? 0 : piece->material + 1;
    return piece->organ != FR_NONE ? meshing->slots + slot : slot;
}

static void find_shells(FrNurbsMeshing *meshing) {
    uint64_t count = meshing->skin->count, first = 0, steps = 0;
    for (uint64_t i = 0; i < count; i++) {
        const FrNurbsPiece *piece = &meshing->skin->pieces[i];
        if (i == 0 || !goes_on_shell(&meshing->skin->pieces[first], piece)) {
            first = i;
            meshing->shells[meshing->shell_count++] = i;
        }
        meshing->tiles[i] = (FrNurbsTile){
            .piece = piece, .steps = steps, .slot = slot_of(meshing, piece), .box = fr_box_empty()};
        steps += piece->surface.count_u + piece->surface.count_v;
    }
    meshing->shells[meshing->shell_count] = count;
}

// ---- grids -------------------------------------------------------------------------------------

static bool is_shrunk(const FrNurbsSurface *s, size_t first, size_t stride, uint32_t count) {
    double most = 0.0;
    for (uint32_t i = 1; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            most = fmax(most, fabs(s->points[first + i * stride][k] - s->points[first][k]));
        }
    }
    return most < 1e-10;
}

static uint8_t shrunk_sides(const FrNurbsSurface *s) {
    uint32_t across = s->count_u, along = s->count_v;
    unsigned shrunk = is_shrunk(s, 0, 1, across) ? FR_SHRUNK_V0 : 0;
    shrunk |= is_shrunk(s, (size_t)(along - 1) * across, 1, across) ? FR_SHRUNK_V1 : 0;
    shrunk |= is_shrunk(s, 0, across, along) ? FR_SHRUNK_U0 : 0;
    shrunk |= is_shrunk(s, across - 1, across, along) ? FR_SHRUNK_U1 : 0;
    return (uint8_t)shrunk;
}

static uint32_t sum_steps(const uint8_t *steps, uint32_t pieces) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < pieces; i++) {
        sum += steps[i];
    }
    return sum;
}

/// A side that is shrunk opposite another one leaves nothing of a single step between them.
static void keep_width(const FrNurbsSurface *s, uint8_t *steps_u, uint32_t pieces_u,
                       uint8_t *steps_v, uint32_t pieces_v) {
    uint8_t shrunk = shrunk_sides(s);
    const unsigned both_u = FR_SHRUNK_U0 | FR_SHRUNK_U1, both_v = FR_SHRUNK_V0 | FR_SHRUNK_V1;
    if ((shrunk & both_u) == both_u && sum_steps(steps_u, pieces_u) == 1) {
        steps_u[0] = 2;
    }
    if ((shrunk & both_v) == both_v && sum_steps(steps_v, pieces_v) == 1) {
        steps_v[0] = 2;
    }
}

static void count_tile(const FrNurbsMeshing *meshing, FrNurbsTile *tile) {
    const FrNurbsSurface *s = &tile->piece->surface;
    uint32_t pieces_u = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
    uint32_t pieces_v = fr_nurbs_pieces(s->knots_v, s->degree_v, s->count_v);
    const uint8_t *steps = meshing->steps + tile->steps;
    uint32_t u = sum_steps(steps, pieces_u), v = sum_steps(steps + pieces_u, pieces_v);
    tile->points_u = u + 1;
    tile->points_v = v + 1;
    tile->shrunk = shrunk_sides(s);
    tile->vertices = (u + 1) * (v + 1);
    const uint32_t lost[] = {u, u, v, v};
    tile->triangles = 2 * u * v;
    for (int side = 0; side < 4; side++) {
        tile->triangles -= (tile->shrunk & 1U << side) != 0 ? lost[side] : 0;
    }
}

/// The same steps along u for all surfaces of a shell: the finest of each.
static void share_steps(const FrNurbsMeshing *meshing, FrNurbsTile *tiles, uint64_t count) {
    const FrNurbsSurface *first = &tiles[0].piece->surface;
    uint32_t pieces = fr_nurbs_pieces(first->knots_u, first->degree_u, first->count_u);
    uint8_t *shared = meshing->steps + tiles[0].steps;
    bool is_blade = tiles[0].piece->kind == FR_NURBS_RIGHT;
    for (uint64_t i = 1; i < count && is_blade; i++) { // caps go by their tube
        const uint8_t *own = meshing->steps + tiles[i].steps;
        for (uint32_t k = 0; k < pieces; k++) {
            shared[k] = MAX(shared[k], own[k]);
        }
    }
    for (uint64_t i = 1; i < count; i++) {
        memcpy(meshing->steps + tiles[i].steps, shared, pieces);
    }
}

static void measure_shell(const FrNurbsMeshing *meshing, FrNurbsTile *tiles, uint64_t count) {
    for (uint64_t i = 0; i < count; i++) {
        const FrNurbsSurface *s = &tiles[i].piece->surface;
        uint8_t *steps = meshing->steps + tiles[i].steps;
        uint32_t pieces = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
        bool is_cap = i > 0 && tiles[0].piece->kind == FR_NURBS_TUBE;
        if (is_cap) { // ruled: one step from the rim to the middle
            steps[pieces] = 1;
        } else {
            fr_nurbs_steps(s, &meshing->fineness, steps, steps + pieces);
            keep_width(s, steps, pieces, steps + pieces,
                       fr_nurbs_pieces(s->knots_v, s->degree_v, s->count_v));
        }
    }
    share_steps(meshing, tiles, count);
    for (uint64_t i = 0; i < count; i++) {
        count_tile(meshing, &tiles[i]);
    }
    if (meshing->params->thickness > 0.0 && tiles[0].piece->kind == FR_NURBS_RIGHT && count == 2) {
        fr_nurbs_count_thick(tiles);
    }
}

static void measure_shells(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const FrNurbsMeshing *meshing = data;
    for (size_t i = begin; i < end; i++) {
        measure_shell(meshing, &meshing->tiles[meshing->shells[i]],
                      meshing->shells[i + 1] - meshing->shells[i]);
    }
}

// ---- counting ----------------------------------------------------------------------------------

static FrStatus check_limits(const FrNurbsMeshing *meshing, const FrMeshPart *parts,
                             const FrContext *context) {
    uint64_t vertices = 0, indices = 0, largest = 0;
    for (uint32_t slot = 0; slot < 2 * meshing->slots; slot++) {
        vertices = fr_count_add(vertices, parts[slot].vertex_count);
        indices = fr_count_add(indices, parts[slot].index_count);
        largest = MAX(largest, parts[slot].vertex_count);
    }
    FrSpan place = fr_plant_place(meshing->plant);
    const char *who = meshing->plant->name != NULL ? meshing->plant->name : "plant";
    uint64_t bytes = fr_count_add(fr_count_multiply(vertices, sizeof(FrVertex)),
                                  fr_count_multiply(indices, sizeof(uint32_t)));
    const struct {
        uint64_t count, limit;
        const char *what;
    } checks[] = {{indices / 3, context->limits.triangles, "triangles"},
                  {bytes, context->limits.bytes, "bytes"},
                  {largest, UINT32_MAX, "vertices of one material"}};
    FrStatus status = FR_OK;
    for (size_t i = 0; i < G_N_ELEMENTS(checks) && status == FR_OK; i++) {
        status = fr_limit_check(checks[i].count, checks[i].limit, checks[i].what, who, place,
                                context->diags);
    }
    return status;
}

/// Gives every tile its place and makes the mesh, without contents.
static FrStatus allocate(FrNurbsMeshing *meshing, const FrContext *context) {
    uint32_t slots = 2 * meshing->slots, part_count = 0;
    FrMeshPart *parts = g_new0(FrMeshPart, slots);
    for (uint64_t i = 0; i < meshing->skin->count; i++) {
        FrNurbsTile *tile = &meshing->tiles[i];
        FrMeshPart *part = &parts[tile->slot];
        tile->first_vertex = part->vertex_count;
        tile->first_index = part->index_count;
        part->vertex_count += tile->vertices;
        part->index_count += 3 * (uint64_t)tile->triangles;
        bool is_sheet = tile->piece->kind == FR_NURBS_RIGHT || tile->piece->kind == FR_NURBS_LEFT;
        part->is_foliage |= is_sheet;
    }
    FrStatus status = check_limits(meshing, parts, context);
    uint64_t vertices = 0, indices = 0;
    for (uint32_t slot = 0; slot < slots; slot++) {
        bool is_used = parts[slot].index_count > 0;
        parts[slot].material = slot % meshing->slots == 0 ? FR_NONE : slot % meshing->slots - 1;
        parts[slot].first_vertex = vertices;
        parts[slot].first_index = indices;
        vertices += is_used ? parts[slot].vertex_count : 0;
        indices += parts[slot].index_count;
        meshing->part_of[slot] = is_used ? part_count : FR_NONE;
        parts[part_count] = parts[slot];
        part_count += is_used;
    }
    if (status == FR_OK) {
        meshing->mesh = fr_mesh_new(vertices, indices, part_count);
        status = meshing->mesh != NULL ? FR_OK : FR_ERR_MACHINE;
    }
    if (status == FR_OK) {
        memcpy(meshing->mesh->parts, parts, part_count * sizeof *parts);
    } else if (status == FR_ERR_MACHINE) {
        fr_diags_add(context->diags, FR_ERROR, "out-of-memory", (FrSpan){0},
                     "there is no memory for a mesh of %" G_GUINT64_FORMAT " triangles",
                     indices / 3);
    }
    g_free(parts);
    return status;
}

// ---- writing -----------------------------------------------------------------------------------

/// Puts the rim of one surface exactly where that of another is.
static void unite_rims(FrNurbsMeshing *meshing, const FrNurbsTile *from, uint32_t from_row,
                       const FrNurbsTile *to, uint32_t to_row) {
    const FrMeshPart *a = &meshing->mesh->parts[meshing->part_of[from->slot]];
    const FrMeshPart *b = &meshing->mesh->parts[meshing->part_of[to->slot]];
    const FrVertex *source = meshing->mesh->vertices + a->first_vertex + from->first_vertex +
                             (size_t)from_row * from->points_u;
    FrVertex *target = meshing->mesh->vertices + b->first_vertex + to->first_vertex +
                       (size_t)to_row * to->points_u;
    for (uint32_t i = 0; i < to->points_u; i++) {
        memcpy(target[i].position, source[i].position, sizeof target[i].position);
    }
}

static void write_shells(void *data, size_t begin, size_t end, int worker) {
    FrNurbsMeshing *meshing = data;
    FrNurbsGrid *grid = &meshing->grids[worker];
    for (size_t n = begin; n < end; n++) {
        uint64_t first = meshing->shells[n], next = meshing->shells[n + 1];
        FrNurbsTile *shell = &meshing->tiles[first];
        if (shell->is_thick) {
            fr_nurbs_write_thick(meshing, shell, grid);
            continue;
        }
        for (uint64_t i = first; i < next; i++) {
            FrNurbsTile *tile = &meshing->tiles[i];
            if (meshing->part_of[tile->slot] == FR_NONE || tile->triangles == 0) {
                continue;
            }
            fr_nurbs_write_tile(meshing, tile, grid);
            if (i > first && tile->piece->kind == FR_NURBS_FOOT) {
                unite_rims(meshing, shell, 0, tile, tile->points_v - 1);
            } else if (i > first) { // the cap at the tip, the left half at the midrib
                unite_rims(meshing, shell, shell->points_v - 1, tile, 0);
            }
        }
    }
}

static void set_boxes(FrNurbsMeshing *meshing) {
    FrMesh *mesh = meshing->mesh;
    FrBox *boxes = g_new(FrBox, mesh->part_count + 1);
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        boxes[p] = fr_box_empty();
    }
    for (uint64_t i = 0; i < meshing->skin->count; i++) {
        const FrNurbsTile *tile = &meshing->tiles[i];
        if (meshing->part_of[tile->slot] != FR_NONE) {
            fr_box_join(&boxes[meshing->part_of[tile->slot]], &tile->box);
        }
    }
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        fr_part_set_box(&mesh->parts[p], boxes[p].min, boxes[p].max);
    }
    g_free(boxes);
}

static void read_tiles(FrNurbsMeshing *meshing) {
    meshing->bark_tiles = g_malloc_n(meshing->slots, sizeof *meshing->bark_tiles);
    meshing->bark_tiles[0][0] = meshing->bark_tiles[0][1] = 0.5F;
    for (uint32_t i = 1; i < meshing->slots; i++) {
        const FrMaterialParams *params =
            fr_material_params(g_ptr_array_index(meshing->plant->materials, i - 1));
        meshing->bark_tiles[i][0] = (float)CLAMP(params->tile_width, 0.001, 100.0);
        meshing->bark_tiles[i][1] = (float)CLAMP(params->tile_height, 0.001, 100.0);
    }
}

/// The longest side of the box around all control points.
static double size_of(const FrNurbsSkin *skin) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint64_t i = 0; i < skin->point_count; i++) {
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], skin->points[i][k]);
            high[k] = fmax(high[k], skin->points[i][k]);
        }
    }
    double size = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    return size > 0.0 ? size : 1.0;
}

/// The tolerance that is asked for, if coordinates can keep it.
static double tolerance_of(const FrNurbsMeshing *meshing, FrSpan span, FrDiags *diags) {
    double size = size_of(meshing->skin), wanted = meshing->params->tolerance;
    if (wanted >= FINEST * size) {
        return wanted;
    }
    if (!(wanted > 0.0)) {
        return size / 2000.0;
    }
    const char *name = meshing->plant->name != NULL ? meshing->plant->name : "plant";
    char *text = g_strdup_printf("the tolerance %g of '%s' is finer than coordinates keep; it "
                                 "is taken for 1/1000000 of the plant's size",
                                 wanted, name);
    if (!fr_nurbs_is_told(diags, text)) {
        fr_diags_add(diags, FR_WARNING, "fine-tolerance", span, "%s", text);
    }
    g_free(text);
    return FINEST * size;
}

static FrStatus mesh_skin(FrNurbsMeshing *meshing, const FrContext *context) {
    uint64_t count = meshing->skin->count, steps = 0;
    for (uint64_t i = 0; i < count; i++) {
        const FrNurbsSurface *s = &meshing->skin->pieces[i].surface;
        steps += s->count_u + s->count_v;
    }
    meshing->tiles = g_new(FrNurbsTile, count + 1);
    meshing->shells = g_new(uint64_t, count + 1);
    meshing->steps = g_malloc(steps + 1);
    find_shells(meshing);
    fr_parallel_for(context->pool, meshing->shell_count, SHELL_GRAIN, measure_shells, meshing,
                    context->progress);
    FrStatus status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
    status = status == FR_OK ? allocate(meshing, context) : status;
    if (status == FR_OK) {
        fr_parallel_for(context->pool, meshing->shell_count, SHELL_GRAIN, write_shells, meshing,
                        context->progress);
        set_boxes(meshing);
        status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
    }
    return status;
}

FrStatus fr_nurbs_mesh(const FrPlant *plant, const FrNurbsParams *params, int lod, FrUpAxis up,
                       FrSpan span, const FrContext *context, FrMesh **mesh) {
    *mesh = NULL;
    int workers = fr_pool_threads(context->pool);
    FrNurbsMeshing meshing = {
        .plant = plant,
        .params = params,
        .up = up,
        .slots = plant->materials->len + 1,
    };
    FrStatus status = fr_nurbs_plant(plant, params, context, &meshing.skin);
    if (status != FR_OK) {
        return status;
    }
    double tolerance = tolerance_of(&meshing, span, context->diags);
    meshing.fineness = (FrNurbsFineness){tolerance * pow(2.0, lod), params->turn * pow(1.4, lod)};
    meshing.part_of = g_new(uint32_t, 2 * (size_t)meshing.slots);
    meshing.grids = g_new0(FrNurbsGrid, (size_t)workers);
    read_tiles(&meshing);
    status = mesh_skin(&meshing, context);
    if (status == FR_OK && params->voxel > 0.0) {
        const FrSolidAsk ask = {params, plant->name, span, context};
        status = fr_solid_of(&meshing.mesh, &ask);
    }
    if (status == FR_OK) {
        *mesh = meshing.mesh;
    } else {
        fr_mesh_free(meshing.mesh);
    }
    for (int worker = 0; worker < workers; worker++) {
        FrNurbsGrid *grid = &meshing.grids[worker];
        g_free(grid->u);
        g_free(grid->v);
        g_free(grid->points);
        g_free(grid->normals);
        g_free(grid->blended);
    }
    g_free(meshing.grids);
    g_free(meshing.bark_tiles);
    g_free(meshing.part_of);
    g_free(meshing.tiles);
    g_free(meshing.shells);
    g_free(meshing.steps);
    fr_nurbs_skin_free(meshing.skin);
    return status;
}
