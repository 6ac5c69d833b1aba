"""Blender imports our models with the triangles that the statistics report."""

import os
import re
import shutil
import subprocess
import sys

import frond_tap as tap

SCRIPT = tap.SOURCE / "tests" / "interop" / "blender_count.py"


# Blender looks for its Python along the path, and another than the system's lacks what it needs.
ENVIRONMENT = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}


def counted(path):
    blender = shutil.which("blender")
    if blender is None:
        raise tap.Skip("Blender is not installed")
    done = subprocess.run([blender, "-b", "--factory-startup", "--python-exit-code", "7",
                           "--python", str(SCRIPT), "--", str(path)],
                          env=ENVIRONMENT, capture_output=True, text=True, check=False)
    if "No module named 'numpy'" in done.stdout + done.stderr:
        raise tap.Skip("Blender's importer needs numpy")
    match = re.search(r"^TRIANGLES (\d+)$", done.stdout, re.MULTILINE)
    assert done.returncode == 0 and match, done.stdout[-2000:] + done.stderr[-2000:]
    return int(match[1])


def same_triangles(example, leaves, lod):
    def test(folder):
        path = folder / "plant.glb"
        stats = tap.statistics(example, "--leaves", leaves, "--lod", lod, "-o", path)
        assert counted(path) == stats["triangles"], stats
    return test


TESTS = []
for example in tap.EXAMPLES:
    TESTS.append((f"/interop/blender/{example.stem} has all its triangles",
                  same_triangles(example, "merged", 3)))
TESTS.append(("/interop/blender/leaves as nodes have all their triangles",
              same_triangles(tap.SOURCE / "examples" / "sunflower.frond", "nodes", 3)))

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
