/// Commands, what they print and how they end.
#include "program.h"

#include <glib.h>
#include <jansson.h>
#include <signal.h>
#include <unistd.h>

typedef struct Command {
    const char *arguments;
    int exit;
    const char *out, *err; ///< patterns with * and ?
} Command;

static const Command commands[] = {
    // help
    {"", 2, "", "usage: frond VERB*build*render*"},
    {"-h", 0, "usage: frond VERB*build*render*check*info*presets*new*", ""},
    {"help", 0, "usage: frond VERB*", ""},
    {"help check", 0, "usage: frond check *", ""},
    {"help biuld", 2, "", "frond: there is no verb 'biuld'; did you mean 'build'?*"},
    {"build -h", 0, "usage: frond build DOC*--leaves*.glb .gltf*", ""},
    {"info whatever --help", 0, "usage: frond info*", ""},
    {"--version", 0, "frond 0.*", ""},
    // verbs and options that are not there
    {"biuld x", 2, "", "frond: there is no verb 'biuld'; did you mean 'build'?*"},
    {"xyzzy", 2, "", "frond: there is no verb 'xyzzy'*build*render*"},
    {"derive x.l", 1, "", "*x.l*"},
    {"vary x.frond", 2, "", "frond: vary needs one folder to write to*"},
    {"convert a", 2, "", "frond: 'convert' needs two files: frond convert IN OUT\n"},
    {"convert a.xyz b.l", 2, "", "frond: cannot convert 'a.xyz' to 'b.l'; known are .l to .frond*"},
    {"convert none.l b.frond", 1, "", "*none.l*"},
    {"convert $S/examples/figure2.frond b.l", 2, "",
     "frond: there is no L-system in the document\n"},
    {"build x --sede 3", 2, "", "frond: unknown option '--sede'; did you mean '--seed'?\n"},
    {"build x -z", 2, "", "frond: unknown option '-z'; frond build -h lists them\n"},
    {"--zzz", 2, "", "frond: unknown option '--zzz'; frond -h lists them\n"},
    {"check x -o y", 2, "", "frond: 'check' does not take --output\n"},
    {"build", 2, "", "frond: 'build' needs a file*"},
    {"build a b", 2, "", "frond: 'b' is too much*"},
    // values
    {"build x --seed", 2, "", "frond: --seed needs a value*"},
    {"build x --seed=-1", 2, "", "frond: --seed takes a whole number*"},
    {"build x --seed 1.5", 2, "", "frond: --seed takes a whole number*"},
    {"build x --threads 0", 2, "", "frond: --threads takes*"},
    {"build x --lod 9", 2, "", "frond: --lod takes*"},
    {"render x --light 3", 2, "", "frond: --light takes a slice*"},
    {"render x --light z=", 2, "", "frond: --light takes a slice*"},
    {"render x --light w=1", 2, "", "frond: --light takes a slice*"},
    {"render x --light x=nan", 2, "", "frond: --light takes a slice*"},
    {"render x --light points=0", 2, "", "frond: --light takes a slice*"},
    {"render x --light points=129", 2, "", "frond: --light takes a slice*"},
    {"render x --light organ", 2, "", "frond: --light takes a slice*"},
    {"render $S/examples/figure2.frond --light points=4 -o p.png --size 32x32 -q", 0, "", ""},
    {"render $S/examples/figure2.frond --light organs -o o.png --size 32x32 -q", 0, "", ""},
    {"build x --quiet=yes", 2, "", "frond: --quiet takes no value\n"},
    {"build x --leaves merge", 2, "", "frond: --leaves takes*did you mean 'merged'?\n"},
    {"build x --limit instance=3", 2, "", "frond: *did you mean 'instances'?\n"},
    {"build x --limit memory=3", 2, "", "frond: there is no limit 'memory'; there are: *nodes*\n"},
    {"build x --limit nodes", 2, "", "frond: --limit takes NAME=VALUE*"},
    {"build x --set a.b", 2, "", "frond: --set takes PATH=VALUE*"},
    {"build x --diag=xml", 2, "", "frond: --diag takes text or json*"},
    {"render x -o a.png --size 10", 2, "", "frond: --size takes WIDTHxHEIGHT*"},
    {"render x -o a.png --size 40000x10", 2, "", "frond: --size takes*from 1 to 32768*"},
    {"render x -o a.png --size 0x10", 2, "", "frond: --size takes WIDTHxHEIGHT*"},
    {"build x -o a.xyz", 2, "", "frond: 'a.xyz': no format of that extension*.glb*"},
    {"render x -o a.jpg", 2, "", "frond: 'a.jpg': pictures are written as .png\n"},
    {"render x", 2, "", "frond: render needs one picture*"},
    // documents
    {"check $S/examples/figure2.frond", 0, "", ""},
    {"check none.frond", 1, "", "*error: *none.frond*"},
    {"check $S/examples/figure2.frond none.frond", 1, "", "*none.frond*"},
    {"build $S/examples/figure2.frond", 0, "", ""},
    {"build $S/examples/figure2.frond --limit instances=11", 3, "", "*[limit-instances]*"},
    {"build $S/examples/figure2.frond --set D.lenght=1", 2, "", "*did you mean 'length'?*"},
    {"build $S/examples/figure2.frond --set D.length=long", 1, "", "*figure2.frond:*length=*^*"},
    {"build $S/examples/figure2.frond --set F.length=1", 2, "", "*nothing is called 'F'*"},
    {"check none.frond --diag=json", 1, "", "[*\"severity\":*\"error\"*]\n"},
    {"build $S/examples/figure2.frond -o none/f.glb", 4, "", "*none/f.glb*"},
    {"render $S/examples/figure2.frond -o f.png --camera frnt", 2, "", "*did you mean 'front'?\n"},
    // what is in it
    {"info $S/examples/figure2.frond", 0, "*12 instances*D*horn*9*in 3 chains of 3\n*", ""},
    {"info $S/data/presets/oak.frond --set oak.size=0.5", 0, "*slider*size*0.5*0.3 to 1.6*\n*", ""},
    {"info $S/data/presets/oak.frond --set oak.size=9", 1, "", "*[out-of-range]*"},
    {"info $S/data/presets/oak.frond --set oak.siez=1", 2, "", "*did you mean 'size'?*"},
    {"info none.glb", 1, "", "*none.glb*"},
    // L-systems
    {"derive $S/examples/lsystems/koch.l --steps 1", 0, "F*", ""},
    {"derive $S/examples/lsystems/koch.l --steps 2 --print steps", 0, "0 7 7\n1 59 59\n2 475 475\n",
     ""},
    {"derive $S/examples/lsystems/koch.l --steps 2 --print count", 0, "475\n", ""},
    {"build $S/examples/lsystems/koch.l --steps 1 --stats -", 0, "*\"drawn\"*\"segments\": 32,*",
     ""},
    {"derive $S/examples/figure2.frond", 2, "", "frond: there is no L-system in the document\n"},
    {"build $S/examples/figure2.frond --steps 2", 2, "", "frond: --steps is for L-systems*"},
    {"derive $S/examples/lsystems/monopodial.l --set r9=1", 1, "", "*did you mean 'r*[unused-*"},
    {"derive $S/examples/lsystems/monopodial.l --steps 2 --set r1=0.5", 0, "*0.5*", ""},
    {"info $S/examples/lsystems/bush.l --steps 2", 0, "*modules*axes*", ""},
    {"check $S/examples/lsystems/bush.l", 0, "", ""},
    {"check $S/examples/lsystems/bush.l --view none.v", 1, "", "error: *'none.v' of --view*"},
    {"info $S/examples/lsystems/signal.l", 0, "*production*drawn*", ""},
    {"build $S/examples/lsystems/bush.l --time 3", 2, "", "frond: --time is for components*"},
    {"render $S/examples/lsystems/koch.l --frames 0..2 -o koch.png --size 16x16 --samples 1 -q", 0,
     "", ""},
    {"build $S/examples/lsystems/koch.l --stats -", 0, "*\"by_production\": {*", ""},
    {"schema", 0, "<?xml*<xs:schema*name=\"phiball\"*</xs:schema>\n", ""},
    {"reference", 0, "# The `.frond` document*## `<phiball>`*", ""},
};

/// Notes what differs and goes on with the next command.
static void expect(Run *did, const Command *command) {
    if (did->exit != command->exit || !g_pattern_match_simple(command->out, did->out) ||
        !g_pattern_match_simple(command->err, did->err)) {
        g_test_fail_printf("frond %s: expected exit %d, output '%s', errors '%s'",
                           command->arguments, command->exit, command->out, command->err);
    }
    clear(did);
}

static void test_commands(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
        const Command *command = &commands[i];
        Run did = run(command->arguments);
        expect(&did, command);
    }
    leave_folder(folder, previous);
}

static json_t *json_of(const char *arguments) {
    Run did = run(arguments);
    g_assert_cmpint(did.exit, ==, 0);
    json_t *json = json_loads(did.out, 0, NULL);
    g_assert_nonnull(json);
    clear(&did);
    return json;
}

static json_int_t number(const json_t *json, const char *key) {
    const json_t *value = json_object_get(json, key);
    g_assert_true(json_is_integer(value));
    return json_integer_value(value);
}

static void test_figure2(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    json_t *info = json_of("info $S/examples/figure2.frond --json");
    json_t *plant = json_array_get(json_object_get(info, "plants"), 0);
    g_assert_cmpint(number(plant, "instances"), ==, 12);
    json_t *component = json_array_get(json_object_get(plant, "components"), 3);
    g_assert_cmpstr(json_string_value(json_object_get(component, "id")), ==, "D");
    g_assert_cmpint(number(component, "instances"), ==, 9);
    json_t *chains = json_object_get(component, "chains");
    g_assert_cmpint(number(chains, "count"), ==, 3);
    g_assert_cmpint(number(chains, "shortest"), ==, 3);
    g_assert_cmpint(number(chains, "longest"), ==, 3);
    json_decref(info);
    leave_folder(folder, previous);
}

/// --stats agrees with what the model holds and with `info` of the model.
static void test_stats(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    json_t *stats = json_of("build $S/examples/figure2.frond -o f.glb -o f.ply --stats -");
    static const char *const keys[] = {"seed",   "threads",  "instances", "plants",
                                       "axes",   "nodes",    "organs",    "shapes",
                                       "meshes", "vertices", "triangles", "peak_bytes"};
    for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
        g_assert_cmpint(number(stats, keys[i]), >=, 0);
    }
    g_assert_cmpint(number(stats, "instances"), ==, 12);
    g_assert_cmpint(number(stats, "plants"), ==, 1);
    g_assert_cmpint(number(json_object_get(stats, "by_component"), "D"), ==, 9);
    g_assert_cmpuint(strlen(json_string_value(json_object_get(stats, "digest"))), ==, 16);
    static const char *const seconds[] = {"read", "build", "skin", "write", "total"};
    for (size_t i = 0; i < G_N_ELEMENTS(seconds); i++) {
        g_assert_true(json_is_real(json_object_get(json_object_get(stats, "seconds"), seconds[i])));
    }
    json_t *model = json_of("info f.glb --json");
    g_assert_cmpint(number(model, "triangles"), ==, number(stats, "triangles"));
    g_assert_cmpint(number(model, "meshes"), ==, number(stats, "meshes"));
    g_assert_cmpint(number(model, "vertices"), ==, number(stats, "vertices"));
    g_assert_true(g_file_test("f.ply", G_FILE_TEST_IS_REGULAR));
    json_decref(model);
    json_decref(stats);
    leave_folder(folder, previous);
}

static char *digest_with(const char *options) {
    char *arguments = g_strconcat("build $S/examples/figure2.frond --stats - ", options, NULL);
    json_t *stats = json_of(arguments);
    char *digest = g_strdup(json_string_value(json_object_get(stats, "digest")));
    json_decref(stats);
    g_free(arguments);
    return digest;
}

static void test_same_seed(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    char *one = digest_with("--threads 1");
    char *three = digest_with("--threads 3");
    char *set = digest_with("--set figure2.seed=5 --set 'D.length=0.3 ~ 0.1'");
    char *seed = digest_with("--seed 5 --set 'D.length=0.3 ~ 0.1'");
    g_assert_cmpstr(one, ==, three);
    g_assert_cmpstr(one, !=, set);
    g_assert_cmpstr(set, ==, seed);
    g_free(one);
    g_free(three);
    g_free(set);
    g_free(seed);
    leave_folder(folder, previous);
}

/// What -o and --stats name keeps its kind: a link stays a link, a device stays a device.
static void test_outputs_keep_their_kind(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    const char *links[] = {"stats.json", "picture.png"};
    const char *writing[] = {
        "build $S/examples/figure2.frond --stats stats.json",
        "render $S/examples/figure2.frond --size 4x4 --samples 1 -o picture.png"};
    for (size_t i = 0; i < G_N_ELEMENTS(links); i++) {
        g_assert_cmpint(symlink("/dev/full", links[i]), ==, 0);
        Run full = run(writing[i]);
        g_assert_cmpint(full.exit, ==, 4);
        g_assert_nonnull(strstr(full.err, "No space left on device"));
        clear(&full);
        g_assert_true(g_file_test(links[i], G_FILE_TEST_IS_SYMLINK));
        g_remove(links[i]);
        g_assert_cmpint(symlink("aim", links[i]), ==, 0);
        g_assert_true(g_file_set_contents("aim", "", 0, NULL));
        Run linked = run(writing[i]);
        g_assert_cmpint(linked.exit, ==, 0);
        clear(&linked);
        g_assert_true(g_file_test(links[i], G_FILE_TEST_IS_SYMLINK));
    }
    leave_folder(folder, previous);
}

/// What a picture or model is made from is not replaced by it.
static void test_inputs_are_spared(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    const char *document = "<frond version='1'><material id='m' picture='leaf.png'/><plant id='p'>"
                           "<pgraph><simple id='h' material='m' primitive='mesh' file='x.stl'/>"
                           "</pgraph></plant><plant id='q'><skeleton file='q.ply'/></plant>"
                           "</frond>";
    g_assert_true(g_file_set_contents("a.frond", document, -1, NULL));
    g_assert_true(g_file_set_contents("leaf.png", "a picture", -1, NULL));
    g_assert_true(g_file_set_contents("x.stl", "triangles", -1, NULL));
    g_assert_true(g_file_set_contents("q.ply", "0 0 0 0 0 1 0.1", -1, NULL));
    g_assert_cmpint(symlink("a.frond", "a.glb"), ==, 0);
    const char *writing[] = {"build a.frond --stats a.frond",
                             "build a.frond -o b.glb -o a.glb",
                             "build a.frond -o x.stl",
                             "build a.frond -o b.glb -o q.ply",
                             "render ./a.frond -o ../$F/leaf.png",
                             "build a.frond --stats leaf.png"};
    for (size_t i = 0; i < G_N_ELEMENTS(writing); i++) {
        char **parts = g_strsplit(writing[i], "$F", -1);
        char *name = g_path_get_basename(folder);
        char *line = g_strjoinv(name, parts);
        Run refused = run(line);
        g_assert_cmpint(refused.exit, ==, 2);
        g_assert_nonnull(strstr(refused.err, "would be overwritten"));
        clear(&refused);
        g_free(line);
        g_free(name);
        g_strfreev(parts);
    }
    char *text;
    g_assert_true(g_file_get_contents("a.frond", &text, NULL, NULL));
    g_assert_cmpstr(text, ==, document);
    g_free(text);
    g_assert_false(g_file_test("b.glb", G_FILE_TEST_EXISTS));
    leave_folder(folder, previous);
}

static void test_new(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    g_mkdir("presets", 0777);
    g_assert_true(g_file_set_contents(
        "presets/oak.frond", "<!-- An oak\n  of no kind -->\n<frond version='1'/>\n", -1, NULL));
    g_setenv("FROND_DATA", ".", TRUE);
    g_setenv("XDG_DATA_HOME", folder, TRUE);
    g_mkdir_with_parents("frond/presets", 0777);
    g_assert_true(
        g_file_set_contents("frond/presets/my twig.frond", "<frond version='1'/>\n", -1, NULL));
    g_assert_true(g_file_set_contents("frond/presets/torn.frond",
                                      "<frond version='1'>\n  <plant id='p' sede='1'/>\n</frond>\n",
                                      -1, NULL));
    static const Command rows[] = {
        {"presets", 0,
         "oak              An oak\nmy twig          your own\n"
         "torn             not right: it cannot be used\n",
         "*/frond/presets/torn.frond:2:* error: *"},
        {"presets --json", 0,
         "[*\"name\": \"oak\"*\"title\": \"An oak\"*\"own\": false*\"name\": \"my twig\"*"
         "\"own\": true*\"broken\": false*\"broken\": true*]\n",
         "*torn.frond:2:*"},
        {"new torn --preset torn", 1, "",
         "*/frond/presets/torn.frond:2:* error: *frond: the preset 'torn' is not right: no "
         "document "
         "is begun with it\n"},
        {"check torn.frond", 1, "", "error: cannot read 'torn.frond'*"},
        {"new twig --preset 'my twig'", 0, "twig.frond\n", ""},
        {"new other --preset 'my twg'", 2, "",
         "frond: there is no preset*did you mean 'my twig'?\n"},
        {"new mine --preset oka", 2, "", "frond: there is no preset 'oka'; did you mean 'oak'?\n"},
        {"new mine --preset ../oak", 2, "", "frond: there is no preset*"},
        {"new mine --preset oak", 0, "mine.frond\n", ""},
        {"new mine.frond --preset oak", 4, "", "frond: 'mine.frond' is there already*"},
        {"new '' --preset oak", 2, "", "frond: '' is no name for a document\n"},
        {"new presets/ --preset oak", 2, "", "frond: 'presets/' is no name for a document\n"},
        {"new none/mine --preset oak", 4, "", "frond: cannot write 'none/mine.frond'*"},
        {"check mine.frond", 0, "", ""},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Run did = run(rows[i].arguments);
        expect(&did, &rows[i]);
    }
    g_setenv("FROND_DATA", "none", TRUE);
    Run did = run("presets");
    g_assert_cmpint(did.exit, ==, 4);
    clear(&did);
    char *data = g_build_filename(g_getenv("FROND_SOURCE"), "data", NULL);
    g_setenv("FROND_DATA", data, TRUE);
    g_free(data);
    // Without a species a young tree, from the presets of the program itself.
    did = run("new young");
    expect(&did, &(Command){"new young", 0, "young.frond\n", ""});
    did = run("build young.frond");
    expect(&did, &(Command){"build young.frond", 0, "", ""});
    g_remove("presets/oak.frond");
    g_remove("frond/presets/my twig.frond");
    g_remove("frond/presets/torn.frond");
    g_remove("frond/presets");
    leave_folder(folder, previous);
}

/// Ctrl-C in the middle of a long picture: ends by the signal, leaves no file.
static void test_interrupted(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    pid_t child = start("render $S/examples/figure2.frond -o f.png --size 4000x4000 "
                        "--samples 65536 --threads 1");
    g_usleep(1500000);
    kill(child, SIGINT);
    Run did = finish(child);
    g_assert_cmpint(did.signal, ==, SIGINT);
    g_assert_cmpstr(did.err, ==, "frond: stopped\n");
    clear(&did);
    g_remove("out.txt");
    g_remove("err.txt");
    GDir *directory = g_dir_open(".", 0, NULL);
    g_assert_null(g_dir_read_name(directory));
    g_dir_close(directory);
    leave_folder(folder, previous);
}

/// A limit of the shell for files is an error like a full disk, and leaves no part.
static void test_file_size_limit(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    struct rlimit old, low;
    g_assert_cmpint(getrlimit(RLIMIT_FSIZE, &old), ==, 0);
    low = (struct rlimit){.rlim_cur = 8192, .rlim_max = old.rlim_max};
    g_assert_cmpint(setrlimit(RLIMIT_FSIZE, &low), ==, 0);
    Run did = run("build $S/examples/figure2.frond -o a.stp");
    g_assert_cmpint(setrlimit(RLIMIT_FSIZE, &old), ==, 0);
    g_assert_cmpint(did.exit, ==, 4);
    g_assert_nonnull(strstr(did.err, "cannot write 'a.stp': File too large"));
    clear(&did);
    g_remove("out.txt");
    g_remove("err.txt");
    GDir *directory = g_dir_open(".", 0, NULL);
    g_assert_null(g_dir_read_name(directory));
    g_dir_close(directory);
    leave_folder(folder, previous);
}

/// Each shell's completion offers every verb that the program has.
static void test_completions(void) {
    static const char *const files[] = {"data/frond.bash", "data/frond.zsh", "data/frond.fish"};
    Run did = run("help");
    char **lines = g_strsplit(did.out, "\n", -1);
    for (size_t f = 0; f < G_N_ELEMENTS(files); f++) {
        char *path = g_build_filename(g_getenv("FROND_SOURCE"), files[f], NULL), *text;
        g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
        guint verbs = 0;
        for (char **line = lines; *line != NULL; line++) {
            if (g_str_has_prefix(*line, "  ") && g_ascii_isalpha((*line)[2])) {
                char *verb = g_strndup(*line + 2, strcspn(*line + 2, " "));
                g_test_message("%s in %s", verb, files[f]);
                g_assert_nonnull(strstr(text, verb));
                g_free(verb);
                verbs++;
            }
        }
        g_assert_cmpuint(verbs, >=, 10);
        g_free(text);
        g_free(path);
    }
    g_strfreev(lines);
    clear(&did);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/cli/commands end as they should and say why", test_commands);
    g_test_add_func("/cli/figure 2 has nine of D in three chains of three", test_figure2);
    g_test_add_func("/cli/statistics agree with the model", test_stats);
    g_test_add_func("/cli/a link or device that is written to stays one",
                    test_outputs_keep_their_kind);
    g_test_add_func("/cli/what is read is not overwritten", test_inputs_are_spared);
    g_test_add_func("/cli/a seed gives the same plant for any number of threads", test_same_seed);
    g_test_add_func("/cli/a preset begins a document and overwrites none", test_new);
    g_test_add_func("/cli/an interrupt leaves no file", test_interrupted);
    g_test_add_func("/cli/a limit of file size leaves no file", test_file_size_limit);
    g_test_add_func("/cli/completions offer every verb", test_completions);
    return g_test_run();
}
