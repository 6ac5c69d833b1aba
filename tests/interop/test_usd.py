"""TinyUSDZ, an independent reader of USD, reads our layers and counts our triangles."""

import json
import re
import shutil
import subprocess
import sys

import frond_tap as tap

INTEROP = tap.SOURCE / "tests" / "interop"
ROW = """<frond version="1">
  <plant id="rod"><pgraph><horn id="stem" length="2" radius="0.1"/></pgraph></plant>
  <scene><place plant="rod" at="0 0 0"/><place plant="rod" at="5 1 0" scale="2" turn="30"/></scene>
</frond>
"""


def read(path):
    if shutil.which("node") is None:
        raise tap.Skip("node is not installed")
    if not (INTEROP / "node_modules" / "tinyusdz").is_dir():
        raise tap.Skip("tinyusdz is not installed")
    done = subprocess.run(["node", str(INTEROP / "usd_count.mjs"), str(path)],
                          capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def same_triangles(example, lod):
    def test(folder):
        path = folder / "plant.usda"
        stats = tap.statistics(example, "--lod", lod, "-o", path)
        report = read(path)
        assert report["is_read"], report["error"]
        assert report["triangles"] == stats["triangles"] > 0, (report, stats)
        assert -1 not in report["materials"], report
        for picture in re.findall(r"@\./([^@]+)@", path.read_text()):
            assert (folder / picture).is_file(), picture
    return test


def instances_make_up_the_rest(folder):
    """Wood and shapes as read, times the instances that the text gives them."""
    path = folder / "plant.usda"
    stats = tap.statistics(tap.SOURCE / "examples" / "sunflower.frond", "--leaves", "gpu", "-o", path)
    report = read(path)
    assert report["is_read"], report["error"]
    instancers = re.findall(r"int\[\] protoIndices = \[([^\]]*)\].*?Prototypes.*?"
                            r"int\[\] faceVertexCounts = \[([^\]]*)\]", path.read_text(), re.S)
    assert instancers
    shapes = [len(counts.split(",")) for _, counts in instancers]
    shown = [len(indices.split(",")) * size for (indices, _), size in zip(instancers, shapes)]
    assert report["triangles"] - sum(shapes) + sum(shown) == stats["triangles"], (report, stats)
    assert sum(len(indices.split(",")) for indices, _ in instancers) == stats["organs"], stats


def equal_plants_are_instances(folder):
    document, path = folder / "row.frond", folder / "row.usda"
    document.write_text(ROW)
    stats = tap.statistics(document, "-o", path)
    report = read(path)
    assert report["is_read"] and 2 * report["triangles"] == stats["triangles"], (report, stats)
    text = path.read_text()
    assert text.count("instanceable = true") == 2 == text.count("references = </_class_rod_1>")
    assert 'class Xform "_class_rod_1"' in text and 'defaultPrim = "row"' in text
    assert "xformOp:rotateZ = 30" in text and "xformOp:scale = (2, 2, 2)" in text


def broken_is_noticed(folder):
    """The reader itself works: it refuses a layer that is cut off."""
    path = folder / "plant.usda"
    tap.run("build", tap.SOURCE / "examples" / "figure2.frond", "-q", "-o", path)
    path.write_text(path.read_text()[:-200])
    assert not read(path)["is_read"]


TESTS = [("/interop/usd/a layer that is cut off is refused", broken_is_noticed)]
TESTS += [(f"/interop/usd/{example.stem} has all its triangles", same_triangles(example, 3))
          for example in tap.EXAMPLES if "<place" not in example.read_text()]
TESTS += [
    ("/interop/usd/instanced leaves are as many as merged ones", instances_make_up_the_rest),
    ("/interop/usd/equal plants share one class", equal_plants_are_instances),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
