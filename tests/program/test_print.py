"""Files for printers are closed: every edge has two triangles, one each way, by our own count."""

import collections
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

import frond_tap as tap

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
SOLIDS = [("figure2", []), ("figure2", ["--nurbs", "voxel=0.02"]),
          ("sunflower", ["--nurbs", "thickness=0.002", "--nurbs", "voxel=0.006"])]


def judge(triangles):
    """Asserts that triangles of hashable corners (with their places) are closed; answers the volume."""
    edges, volume = collections.Counter(), 0.0
    for corners in triangles:
        (a, b, c) = [place for _, place in corners]
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                   + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        for k in range(3):
            edges[corners[k][0], corners[(k + 1) % 3][0]] += 1
    assert edges
    for (a, b), count in edges.items():
        assert a != b and edges.get((b, a)) == count, (a, b, count)
    assert volume > 0, volume
    return volume


def read_stl(path):
    data = path.read_bytes()
    count = struct.unpack("<I", data[80:84])[0]
    assert len(data) == 84 + 50 * count
    for n in range(count):
        numbers = struct.unpack("<12f", data[84 + 50 * n:132 + 50 * n])
        yield [(numbers[k:k + 3], numbers[k:k + 3]) for k in (3, 6, 9)]


def read_3mf(path):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        assert archive.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
        root = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    assert root.get("unit") == "meter"
    colours = len(root.findall(f"./{CORE}resources/{CORE}basematerials/{CORE}base"))
    objects = root.findall(f"./{CORE}resources/{CORE}object")
    items = root.findall(f"./{CORE}build/{CORE}item")
    assert {item.get("objectid") for item in items} == {one.get("id") for one in objects}
    for one in objects:
        places = [tuple(float(v.get(k)) for k in "xyz") for v in one.iter(f"{CORE}vertex")]
        assert len(set(places)) == len(places)
        for triangle in one.iter(f"{CORE}triangle"):
            numbers = [int(triangle.get(k)) for k in ("v1", "v2", "v3")]
            assert int(triangle.get("p1")) < colours
            yield [(n, places[n]) for n in numbers]


def closed(example, settings):
    def test(folder):
        stl, mf = folder / "plant.stl", folder / "plant.3mf"
        done = tap.run("build", tap.SOURCE / "examples" / f"{example}.frond", "-q", "-o", stl,
                       "-o", mf, "--nurbs", "caps=yes", *settings)
        assert "not-closed" not in done.stderr, done.stderr
        volumes = judge(read_stl(stl)), judge(read_3mf(mf))
        assert abs(volumes[0] / volumes[1] - 1) < 1e-4, volumes
    return test


def open_is_told(folder):
    """Leaves are sheets; whoever prints them is told what to do."""
    done = tap.run("build", tap.SOURCE / "examples/sunflower.frond", "-o", folder / "plant.3mf")
    assert "[not-closed]" in done.stderr and "thickness" in done.stderr, done.stderr


def same_bytes(folder):
    files = []
    for threads in (1, 3):
        path = folder / f"{threads}.3mf"
        tap.run("build", tap.SOURCE / "examples/figure2.frond", "-q", "-o", path, "--threads", threads,
                "--nurbs", "voxel=0.02")
        files.append(path.read_bytes())
    assert files[0] == files[1]


TESTS = [(f"/program/print/{example} {' '.join(settings[1::2]) or 'as shells'} is closed",
          closed(example, settings)) for example, settings in SOLIDS]
TESTS += [("/program/print/open surfaces are told", open_is_told),
          ("/program/print/the same plant makes the same archive", same_bytes)]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
