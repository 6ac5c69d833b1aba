"""The Open Asset Import Library reads our .3mf: every triangle is there, where it should be."""

import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

import frond_tap as tap

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
ASSIMP = shutil.which("assimp")
CASES = [("figure2", []), ("figure2", ["--nurbs", "voxel=0.02"]), ("chestnut", ["--lod", 4])]
REAL = r"(-?[0-9.e+-]+)"


def assimp(*arguments):
    done = subprocess.run([ASSIMP, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=100)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def box(path):
    """Of all vertices; the plants of these examples stand at the origin."""
    with zipfile.ZipFile(path) as archive:
        root = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    places = [tuple(float(v.get(k)) for k in "xyz") for v in root.iter(f"{CORE}vertex")]
    return [tuple(map(end, zip(*places))) for end in (min, max)]


def read(example, settings):
    def test(folder):
        if ASSIMP is None:
            raise tap.Skip("assimp is not installed (package assimp-utils)")
        path = folder / "plant.3mf"
        stats = tap.statistics(tap.SOURCE / "examples" / f"{example}.frond", "-o", path, *settings)
        text = assimp("info", path)
        faces = int(re.search(r"^Faces:\s*(\d+)", text, re.M)[1])
        assert faces == stats["triangles"] > 0, (faces, stats["triangles"])
        corners = [tuple(map(float, re.search(rf"^{end} point\s*\({REAL} {REAL} {REAL}\)", text,
                                              re.M).groups())) for end in ("Minimum", "Maximum")]
        for corner, own in zip(corners, box(path)):
            assert all(abs(a - b) < 1e-3 for a, b in zip(corner, own)), (corners, box(path))
    return test


TESTS = [(f"/interop/assimp/{example} {' '.join(map(str, settings))} has all its triangles",
          read(example, settings)) for example, settings in CASES]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
