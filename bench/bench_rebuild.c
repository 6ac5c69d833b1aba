// A document that is edited while it is shown: how long until an edit is in the mesh.
#include "bench.h"

#include <string.h>

// As many levels, branches, cross-sections and leaves as the tree `oak_large` of ez-tree has, which
// is 22 566 triangles on 30 104 vertices.
static const char *const oak =
    "<frond version=\"1\"><plant id=\"oak\" seed=\"23399\"><pgraph>\n"
    "<tree id=\"trunk\" length=\"12\" radius=\"0.45\" segments=\"16\" gnarl=\"12\" curvature=\"6\""
    " number=\"9\" start=\"0.3\" branching-angle=\"70..35 ~ 8\"/>\n"
    "<tree id=\"limb\" length=\"6..3 ~ 0.5\" radius=\"0.4\" radius-mode=\"of-parent\" gnarl=\"20\""
    " segments=\"9\" number=\"6\" start=\"0.2\" branching-angle=\"55 ~ 8\"/>\n"
    "<tree id=\"branch\" length=\"0.5\" length-mode=\"of-parent\" radius=\"0.5\""
    " radius-mode=\"of-parent\" gnarl=\"20\" segments=\"8\" number=\"5\" start=\"0.2\"/>\n"
    "<tree id=\"twig\" length=\"0.4 ~ 0.1\" length-mode=\"of-parent\" radius=\"0.5\""
    " radius-mode=\"of-parent\" gnarl=\"10\" segments=\"3\" number=\"10\" start=\"0.1\"/>\n"
    "<leaf id=\"leaf\" length=\"0.3\" width=\"0.25\" scale=\"1 ~ 0.3\" petiole-length=\"0\""
    " segments-along=\"1\" segments-across=\"1\" fold=\"20\"/>\n"
    "<link from=\"trunk\" to=\"limb\" kind=\"branch\"/>\n"
    "<link from=\"limb\" to=\"branch\" kind=\"branch\"/>\n"
    "<link from=\"branch\" to=\"twig\" kind=\"branch\"/>\n"
    "<link from=\"twig\" to=\"leaf\" kind=\"branch\"/>\n"
    "</pgraph></plant></frond>\n";

typedef struct Editing {
    FrContext context;
    FrDocument *document;
    FrRebuild *shown;
    const char *path;
    const char *values[2];
    int edits;
    double updating; ///< shortest, s, without reading the edited document
} Editing;

static void edit(void *data) {
    Editing *editing = data;
    FrStatus status = fr_document_set(editing->document, editing->path,
                                      editing->values[editing->edits++ % 2], &editing->context);
    FR_ASSERT(status == FR_OK);
    double start = bench_now();
    status = fr_rebuild_update(editing->shown, editing->document, -1, &editing->context);
    FR_ASSERT(status == FR_OK);
    editing->updating = MIN(editing->updating, bench_now() - start);
}

// The first showing of a document: all of it.
static void show(void *data) {
    Editing *editing = data;
    FrSkinParams params = fr_skin_default();
    FrRebuild *shown = fr_rebuild_new(&params, FR_UP_Y);
    FrStatus status = fr_rebuild_update(shown, editing->document, -1, &editing->context);
    FR_ASSERT(status == FR_OK);
    fr_rebuild_free(shown);
}

// What is shown must be what a whole build makes.
static const FrPlant *check(const Editing *editing, FrMesh **mesh) {
    FrScene *scene;
    FrMesh *fresh;
    FrSkinParams params = fr_skin_default();
    FrStatus status = fr_scene_build(editing->document, -1, &editing->context, &scene);
    FR_ASSERT(status == FR_OK);
    FR_ASSERT(fr_scene_digest(scene) == fr_scene_digest(fr_rebuild_scene(editing->shown)));
    status = fr_skin_plant(g_array_index(scene->plants, FrScenePlant, 0).plant, &params, FR_UP_Y,
                           &editing->context, &fresh);
    FR_ASSERT(status == FR_OK);
    *mesh = fr_skin_mesh(fr_rebuild_skin(editing->shown, 0));
    FR_ASSERT(fr_mesh_digest(fresh) == fr_mesh_digest(*mesh));
    fr_mesh_free(fresh);
    fr_scene_free(scene);
    return g_array_index(fr_rebuild_scene(editing->shown)->plants, FrScenePlant, 0).plant;
}

static void tell(const char *name, const Editing *editing, double seconds, double updating,
                 const char *what) {
    FrMesh *mesh;
    const FrPlant *plant = check(editing, &mesh);
    FrRebuildWork work = fr_rebuild_work(editing->shown);
    bench_tell(name, 1 / seconds, 0, "edits/s",
               "%s in %.2f ms, of which %.2f read the document: %u organs, %.0f triangles, %.0f "
               "vertices; %.0f of %.0f instances made, %.0f of %.0f runs of tubes and %.0f organs "
               "written, %d threads; compared with a whole build",
               what, seconds * 1e3, (seconds - updating) * 1e3, plant->organs.count,
               (double)mesh->index_count / 3, (double)mesh->vertex_count,
               (double)work.instances_made, (double)work.instances, (double)work.skin.runs_written,
               (double)work.skin.runs, (double)work.skin.organs_written,
               fr_pool_threads(editing->context.pool));
    fr_mesh_free(mesh);
}

static void bench_edit(Editing *editing, const char *name, const char *path, const char *a,
                       const char *b, const char *what) {
    editing->path = path;
    editing->values[0] = a;
    editing->values[1] = b;
    edit(editing);
    edit(editing);
    editing->updating = 1;
    double seconds = bench_shortest(12, edit, editing);
    tell(name, editing, seconds, editing->updating, what);
}

static void begin(Editing *editing, FrDocument *document) {
    FrSkinParams params = fr_skin_default();
    *editing = (Editing){.context = fr_context_default(), .document = document};
    editing->context.pool = fr_pool_new(2);
    editing->shown = fr_rebuild_new(&params, FR_UP_Y);
    FrStatus status = fr_rebuild_update(editing->shown, document, -1, &editing->context);
    FR_ASSERT(status == FR_OK);
}

static void end(Editing *editing) {
    fr_rebuild_free(editing->shown);
    fr_document_free(editing->document);
    fr_pool_free(editing->context.pool);
}

void bench_rebuild(void) {
    FrContext context = fr_context_default();
    Editing editing;
    FrDocument *document;
    FrStatus status = fr_document_load(BENCH_EXAMPLES "/chestnut.frond", &context, &document);
    FR_ASSERT(status == FR_OK);
    begin(&editing, document);
    bench_edit(&editing, "rebuild.chestnut-colour", "bark.colour", "#7d6f60", "#8d7f70",
               "chestnut, another colour of bark");
    bench_edit(&editing, "rebuild.chestnut-shape", "chestnut.leaf.width", "0.058", "0.06",
               "chestnut, another width of leaves");
    bench_edit(&editing, "rebuild.chestnut-leaf", "chestnut.leaf.phototropism", "0.45", "0.5",
               "chestnut, leaves turned otherwise");
    bench_edit(&editing, "rebuild.chestnut-trunk", "trunk.gnarl", "9", "9.5",
               "chestnut, another trunk");
    end(&editing);
    FrSource *source = fr_source_new("oak.frond", oak, strlen(oak));
    status = fr_document_parse(source, NULL, &context, &document);
    FR_ASSERT(status == FR_OK);
    fr_source_unref(source);
    begin(&editing, document);
    bench_edit(&editing, "rebuild.oak-trunk", "trunk.gnarl", "12", "12.5", "oak, another trunk");
    bench_edit(&editing, "rebuild.oak-twig", "twig.gnarl", "10", "11", "oak, other twigs");
    double seconds = bench_shortest(20, show, &editing);
    tell("rebuild.oak-first", &editing, seconds, seconds, "oak, shown for the first time");
    end(&editing);
}
