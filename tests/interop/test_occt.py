"""OpenCASCADE reads our IGES and STEP: every face is there, valid, and where we evaluate it."""

import functools
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import frond_tap as tap

DRAW = next((name for name in ("occt-draw-7.6", "occt-draw", "DRAWEXE") if shutil.which(name)), None)
SMALL = [example for example in tap.EXAMPLES if example.stem in ("figure2", "sunflower")]
SAMPLES = [(0.0, 0.0), (0.13, 0.31), (0.5, 0.5), (0.77, 0.93), (1.0, 1.0)]


def run_draw(folder, script):
    path = folder / "read.tcl"
    path.write_text("pload ALL\n" + script)
    return subprocess.run([DRAW, "-b", "-f", str(path)], capture_output=True, text=True,
                          check=False, timeout=500)


@functools.cache
def reason_to_skip():
    """The command alone is not enough: its modules are found through resources of their own."""
    if DRAW is None:
        return "occt-draw is not installed"
    with tempfile.TemporaryDirectory() as folder:
        done = run_draw(pathlib.Path(folder), "box b 1 1 1\nputs [nbshapes b]\n"
                        "puts \"READERS [llength [info commands igesbrep]]"
                        "[llength [info commands stepread]]\"\n")
    works = re.search(r"FACE\s*:\s*6\b", done.stdout) and "READERS 11" in done.stdout
    return None if works else ("OpenCASCADE's draw finds no modules; their resources are in the "
                               "package libocct-draw-dev")


def draw(folder, script):
    if reason_to_skip() is not None:
        raise tap.Skip(reason_to_skip())
    done = run_draw(folder, script)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return done.stdout + done.stderr


def same_faces(example, extension, read, *settings):
    def test(folder):
        path = folder / f"plant{extension}"
        stats = tap.statistics(example, "-o", path, *settings)
        answer = draw(folder, read.format(path) + "puts [nbshapes g -t]\nputs [checkshape g short]\n")
        faces = int(re.search(r"FACE\s*:\s*(\d+)", answer)[1])
        assert faces == stats["surfaces"] > 0, (faces, stats)
        assert "looks OK" in answer or "seems to be valid" in answer, answer[-2000:]
    return test


def read_free_form(path):
    """Surfaces of a .nurbs.obj, z up: (degrees, counts, knots, points with weights)."""
    points, surfaces = [], []
    for line in path.read_text().splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            x, y, z, w = map(float, rest)
            points.append((x, -z, y, w))
        elif word == "deg":
            degrees = [int(n) for n in rest]
        elif word == "surf":
            controls = [points[int(n)] for n in rest[4:]]
            knots = {}
        elif word == "parm":
            knots[rest[0]] = [float(n) for n in rest[1:]]
        elif word == "end":
            surfaces.append((degrees, knots["u"], knots["v"], controls))
    return surfaces


def basis(knots, degree, i, t):
    """Cox and de Boor's recursion, the slow and plain way; the end belongs to the last piece."""
    if degree == 0:
        is_last = t == knots[-1] and knots[i] < knots[i + 1] == t
        return 1.0 if knots[i] <= t < knots[i + 1] or is_last else 0.0
    value = 0.0
    if knots[i + degree] > knots[i]:
        value += (t - knots[i]) / (knots[i + degree] - knots[i]) * basis(knots, degree - 1, i, t)
    if knots[i + degree + 1] > knots[i + 1]:
        value += ((knots[i + degree + 1] - t) / (knots[i + degree + 1] - knots[i + 1])
                  * basis(knots, degree - 1, i + 1, t))
    return value


def evaluate(surface, u, v):
    (p, q), knots_u, knots_v, controls = surface
    across = len(knots_u) - p - 1
    total = [0.0] * 4
    for j in range(len(knots_v) - q - 1):
        along = basis(knots_v, q, j, v)
        for i in range(across) if along else ():
            x, y, z, w = controls[j * across + i]
            part = along * basis(knots_u, p, i, u) * w
            for k, value in enumerate((x, y, z, 1.0)):
                total[k] += part * value
    return [value / total[3] for value in total[:3]]


def same_points(example, extension, read):
    """Both read the same numbers, so a wrong order of points, knots or weights shows."""
    def test(folder):
        path, own = folder / f"plant{extension}", folder / "plant.nurbs.obj"
        tap.run("build", example, "-q", "-o", path, "-o", own, "--nurbs", "share=no")
        surfaces = read_free_form(own)
        chosen = [n for n in range(len(surfaces)) if n % max(len(surfaces) // 40, 1) == 0]
        script = read.format(path) + "explode g f\n"
        for n in chosen:
            script += f"mksurface s g_{n + 1}\n"
            for u, v in SAMPLES:
                script += (f'if {{[catch {{svalue s {u} {v} x y z; puts "AT {n} {u} {v} '
                           '[dval x] [dval y] [dval z] [regexp BSpline [dump s]]"}]} {}\n')
        compared = 0
        for line in re.findall(r"^AT (.*)$", draw(folder, script), re.MULTILINE):
            n, u, v, x, y, z, is_spline = map(float, line.split())
            if is_spline == 1:
                point = evaluate(surfaces[int(n)], u, v)
                off = max(abs(a - 0.001 * b) for a, b in zip(point, (x, y, z)))
                assert off < 1e-6, (example.stem, line, point)
                compared += 1
        assert compared >= len(SAMPLES) * 2, compared
    return test


def published_string(folder):
    """F(+F(+F)(-F))F(-F)F has seven segments and four branches, each a tube with two caps."""
    stats = tap.statistics(NURBS / "branching.l", "-o", folder / "plant.stp")
    assert (stats["nodes"], stats["axes"], stats["surfaces"]) == (7, 1 + 4, 3 * 5), stats


IGES, STEP = "igesbrep {0} g *\n", "stepread {0} s *\nrenamevar s_1 g\n"
NURBS = tap.SOURCE / "examples" / "nurbs"
TESTS = [("/interop/occt/the published string has seven segments and four branches",
          published_string)]
for example in [*SMALL, NURBS / "branching.l", NURBS / "star.frond"]:
    TESTS += [
        (f"/interop/occt/{example.stem} has all its faces in STEP by AP203",
         same_faces(example, ".stp", STEP, "--nurbs", "step=ap203")),
        (f"/interop/occt/{example.stem} has all its faces in IGES", same_faces(example, ".igs", IGES)),
        (f"/interop/occt/{example.stem} has all its faces in STEP", same_faces(example, ".stp", STEP)),
        (f"/interop/occt/{example.stem} is in IGES where it should be",
         same_points(example, ".igs", IGES)),
        (f"/interop/occt/{example.stem} is in STEP where it should be",
         same_points(example, ".stp", STEP)),
    ]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
