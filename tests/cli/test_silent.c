/// What users can write without effect, or by a slip, is not passed over in silence.
#include "program.h"

typedef struct Case {
    const char *name, *text, *arguments;
    int exit;
    const char *out, *err; ///< patterns with * and ?
} Case;

#define ROOT(inner) "<frond version=\"1\">\n" inner "\n</frond>\n"
#define GRAPH(inner) ROOT("<plant id=\"p\"><pgraph>" inner "</pgraph></plant>")
#define SCAN                                                                                       \
    "<plant id=\"scan\"><skeleton>0 0 0 0 0 1 .1\n0 0 1.3 0 0 2 .1\n0 0 2 0 0 2 .1</skeleton>"     \
    "</plant>"

static const Case cases[] = {
    {"an attribute of another mode is said to have no effect",
     GRAPH("<tree id=\"t\" density=\"3\"/>"), "check a.frond", 0, "",
     "a.frond:2:*warning: 'density' has no effect here: it is read where mode is "
     "density*[without-effect]*"},
    {"an attribute of its mode is not", GRAPH("<tree id=\"t\" mode=\"density\" density=\"3\"/>"),
     "check a.frond", 0, "", ""},
    {"two ways to say one thing are told apart",
     GRAPH("<leaf id=\"l\" outline=\"ovate\" outline-points=\"0,0 .5,.5 1,0\"/>"), "check a.frond",
     0, "", "*'outline' has no effect here: it is read where outline-points is not given*"},
    {"veins of a bark are said to have no effect",
     ROOT("<material id=\"m\" texture=\"bark-plated\" vein-density=\"2\" tooth-depth=\".1\"/>"
          "<material id=\"n\" texture=\"leaf\" vein-density=\"2\"/>"),
     "check a.frond", 0, "",
     "a.frond:2:*'vein-density' has no effect here: it is read where texture is leaf *"
     "a.frond:2:*'tooth-depth' has no effect here: it is read where texture is leaf or petal *"},
    {"what needs another number says which", GRAPH("<horn id=\"h\" fork-angle=\"30\"/>"),
     "check a.frond", 0, "", "*'fork-angle' has no effect here: it is read where forks is not 0*"},
    {"an axis for a leaf has no effect",
     ROOT("<plant id=\"p\"><pgraph><leaf id=\"l\"/></pgraph>"
          "<edits><edit at=\"l\" axis=\"0,0,0 0,0,1\"/></edits></plant>"),
     "check a.frond", 0, "", "*the axis drawn for 'l' has no effect*leaf, not a stem*"},
    {"an edit that a later one overrules is told apart from one without a place",
     ROOT("<plant id=\"p\"><pgraph><leaf id=\"l\"/></pgraph><edits><edit at=\"l\" bend=\"1\"/>"
          "<edit at=\"l\" scale=\"2\"/><edit at=\"m\" prune=\"yes\"/></edits></plant>"),
     "info a.frond", 0,
     "*edit l *bend  (a later one has its place)\n*edit l *scale\n*edit m *(has no place now)\n*",
     "*[duplicate-edit]*"},
    {"a mesh without a file lacks an attribute", GRAPH("<simple id=\"s\" primitive=\"mesh\"/>"),
     "check a.frond", 1, "", "*'s' needs the attribute 'file'*[missing-attribute]*"},
    {"plants that stand nowhere are checked too",
     ROOT("<plant id=\"p\"><pgraph><tree id=\"t\"/></pgraph></plant><plant id=\"v\"><vary "
          "base=\"p\">"
          "<stroke select=\"u\">0,0,0 0,0,1</stroke></vary></plant><scene><place plant=\"p\"/>"
          "</scene>"),
     "check a.frond", 1, "", "a.frond:2:*no branch of this plant is 'u'*[unknown-branch]*"},
    {"lines without length and stems in the air are told at their place", ROOT(SCAN),
     "check a.frond", 0, "",
     "a.frond:2:*[skeleton-point]*a.frond:2:*1 of 2 stems hang in the air*[skeleton-apart]*"},
    {"branches of a skeleton are listed as strokes select them", ROOT(SCAN),
     "info a.frond -q --paths stem", 0,
     "*stem *branches *2  select=\"stem\", \"stem:1\" to \"stem:2\"\n  stem:1  #*\n  stem:2  #*\n*",
     ""},
    {"an option that no output reads is said to have no effect", GRAPH("<leaf id=\"l\"/>"),
     "build a.frond -o a.mtg --leaves gpu --nurbs circle=nine", 0, "*a.mtg: *",
     "frond: --leaves has no effect: *\nfrond: --nurbs has no effect: *\n"},
    {"an option that an output reads is not", GRAPH("<leaf id=\"l\"/>"),
     "build a.frond -o a.obj -o a.glb --leaves nodes --lod 1", 0, "*a.obj: *a.glb: *", ""},
    {"settings of surfaces are read by every format that has one", GRAPH("<leaf id=\"l\"/>"),
     "build a.frond -o a.stl --nurbs circle=nine", 0, "*a.stl: *", ""},
    {"a setting of surfaces that there is not is told with the nearest", GRAPH("<leaf id=\"l\"/>"),
     "build a.frond -o a.stl --nurbs voxl=3", 2, "",
     "frond: --nurbs has no setting 'voxl'; did you mean 'voxel'?\n*"},
    {"where none is near all are listed", GRAPH("<leaf id=\"l\"/>"),
     "vary a.frond -o a --nurbs nonsense=3", 2, "",
     "frond: --nurbs has no setting 'nonsense'; there are circle, join, *profile-degree, *\n*"},
    {"a value of surfaces out of range is told with its name", GRAPH("<leaf id=\"l\"/>"),
     "build a.frond -o a.stl --nurbs profile-degree=7", 2, "",
     "frond: --nurbs profile-degree: 7 is outside the range from 1 to 3\n*"},
    {"a model through whose lattice everything falls is refused with its place",
     ROOT("<plant id=\"p\"><nurbs voxel=\"50\"/><pgraph><horn id=\"h\"/></pgraph></plant>"),
     "build a.frond -o a.stl", 1, "", "a.frond:2:16: error: 'p': *[voxel-too-coarse]*"},
    {"finishes that surfaces leave out are told once by name and place",
     GRAPH("<tree id=\"t\" relief=\"0.2\" buttresses=\"4\"/>"), "build a.frond -o a.stp -o a.igs",
     0, "*a.stp: *",
     "a.frond:2:*warning: 'p': its surfaces are without buttresses, relief [left-out]\n    2 | *"},
    {"a folder is not said to be missing",
     GRAPH("<simple id=\"s\" primitive=\"mesh\" file=\".\"/>"), "check a.frond", 1, "",
     "a.frond:2:*' is not a file [missing-file]*"},
    {"a slip of a digit is refused before there is a mesh",
     GRAPH("<tree id=\"t\" number=\"1000\"/><tree id=\"b\" number=\"1000\"/><leaf id=\"leaf\"/>"
           "<link from=\"t\" to=\"b\" kind=\"branch\"/><link from=\"b\" to=\"leaf\" "
           "kind=\"branch\"/>"),
     "build a.frond -o a.glb", 3, "",
     "a.frond:2:*leaf asks for *the limit 'plant-triangles'*[limit-plant_triangles]*\n"
     "frond: if it is meant, --limit plant-triangles=N allows more\n"},
};

static void test_case(gconstpointer data) {
    const Case *given = data;
    char *previous;
    char *folder = enter_folder(&previous);
    g_assert_true(g_file_set_contents("a.frond", given->text, -1, NULL));
    Run did = run(given->arguments);
    g_assert_cmpint(did.exit, ==, given->exit);
    if (!g_pattern_match_simple(given->out, did.out)) {
        g_error("expected output '%s', got '%s'", given->out, did.out);
    }
    if (!g_pattern_match_simple(given->err, did.err)) {
        g_error("expected errors '%s', got '%s'", given->err, did.err);
    }
    clear(&did);
    leave_folder(folder, previous);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        char *path = g_strconcat("/cli/silent/", cases[k].name, NULL);
        g_test_add_data_func(path, &cases[k], test_case);
        g_free(path);
    }
    return g_test_run();
}
