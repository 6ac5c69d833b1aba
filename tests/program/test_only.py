"""Plants taken out of a scene: they keep the shape that they have grown among the others."""

import json
import struct
import sys

import frond_tap as tap

PARTS = tap.SOURCE / "examples" / "crown-parts.frond"
STEPS = ("-q", "--steps", 9)
# What grows bud by bud beside a p-graph, an L-system that asks for room, and an obstacle.
MIXED = """<frond version="1">
  <plant id="stake"><pgraph>
    <camera id="root"/><tree id="stem" length="2 ~ 1"/><leaf id="leaf" length="0.3"/>
    <link from="root" to="stem"/><link from="stem" to="leaf" kind="leaf"/>
  </pgraph></plant>
  <plant id="shrub"><species model="open" step="0.2" auxin-reach="1" leaves="1"/></plant>
  <plant id="climber"><lsystem><![CDATA[
derivation length: 12
w : D(?,?)A
p1 : D(d,a) < A : a > 0.2 -> F(0.1)[+(60)F(0.1)]D(?,?)A
  ]]></lsystem></plant>
  <scene>
    <growth steps="5" min="-8, -8, -1" max="8, 8, 6" cell="0.05"/>
    <row plants="stake, shrub" spacing="1" individuals="2" turn="90" except="1">-3,1,0 3,1,0</row>
    <place plant="shrub" at="0, 0, 0"/>
    <place plant="climber" at="0.8, 0, 0"/>
    <place plant="climber" at="-0.8, 0, 0"/>
    <obstacle shape="box" at="2, -1, 0" size="1, 1, 1"/>
  </scene>
</frond>
"""


class Model:
    """The nodes of a .glb, each with the bytes of its vertices and where it stands."""

    def __init__(self, path):
        content = path.read_bytes()
        size = struct.unpack("<I", content[12:16])[0]
        self.json = json.loads(content[20:20 + size])
        self.binary = content[28 + size:]

    def vertices(self, node):
        """Position, normal and texture coordinates of every vertex, primitive by primitive."""
        found = []
        for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
            for name in ("POSITION", "NORMAL", "TEXCOORD_0"):
                accessor = self.json["accessors"][primitive["attributes"][name]]
                view = self.json["bufferViews"][accessor["bufferView"]]
                width = {"VEC3": 12, "VEC2": 8}[accessor["type"]]
                begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
                stride = view.get("byteStride", width)
                found.append(b"".join(self.binary[begin + i * stride:begin + i * stride + width]
                                      for i in range(accessor["count"])))
        return found

    def nodes(self):
        return [node for node in self.json["nodes"] if "mesh" in node]


def built(folder, document, *options):
    path = folder / "model.glb"
    tap.run("build", document, "-o", path, *options)
    return Model(path)


def mixed(folder):
    path = folder / "mixed.frond"
    path.write_text(MIXED)
    return path


def grown_together(folder):
    whole = built(folder, PARTS, *STEPS)
    shapes = [whole.vertices(node) for node in whole.nodes()]
    assert [node["name"] for node in whole.nodes()] == ["left", "middle", "right"]
    for number, name in enumerate(("left", "middle", "right"), 1):
        model = built(folder, PARTS, *STEPS, "--only", f"place-{number}")
        (node,) = model.nodes()
        assert node["name"] == name and "translation" not in node, node
        assert model.vertices(node) == shapes[number - 1], name
    # By itself, it would have grown otherwise.
    alone = folder / "alone.frond"
    text = PARTS.read_text(encoding="utf-8")
    alone.write_text("\n".join(line for line in text.splitlines()
                               if '<place plant="middle"' not in line and '<place plant="right"' not in line))
    other = built(folder, alone, *STEPS)
    assert other.vertices(other.nodes()[0]) != shapes[0]


def every_kind(folder):
    document = mixed(folder)
    whole = built(folder, document)
    nodes = whole.nodes()
    assert nodes[-1]["name"] == "obstacles" and len(nodes) == 10, nodes
    asked = ["place-1", "place-2", "place-3"] + [f"row.{i}" for i in (0, 2, 3, 4, 5, 6)]
    # Those of the scene stand by hand first, then in the row, in the order of x.
    for node, name in zip(nodes[:3] + sorted(nodes[3:9], key=lambda n: n["translation"][0]), asked):
        model = built(folder, document, "--only", name, "--in-place")
        (own,) = model.nodes()
        assert own["name"] == node["name"].split()[0], (name, own, node)
        assert model.vertices(own) == whole.vertices(node), name
        assert all(own.get(key) == node.get(key) for key in ("translation", "rotation", "scale")), name


def several(folder):
    document = mixed(folder)
    stakes = built(folder, document, "--only", "row").nodes()
    assert len(stakes) == 6 and "translation" not in stakes[0], stakes
    assert max(node.get("translation", [0])[0] for node in stakes) == 6, "they keep their distances"
    both = built(folder, document, "--only", "place-3", "--only=climber", "--in-place").nodes()
    assert [round(node["translation"][0], 6) for node in both] == [0.8, -0.8], both


def pictures(folder):
    """A sequence shows the one plant, as large as it is."""
    small = ("-q", "--size", "24x24", "--samples", 2)
    tap.run("render", PARTS, "-o", folder / "grow.png", "--frames", "4..5", "--only", "left", *small)
    assert sorted(path.name for path in folder.iterdir()) == ["grow-0004.png", "grow-0005.png"]
    images = []
    for options in ((), ("--only", "left")):
        tap.run("render", PARTS, "-o", folder / "still.png", *STEPS, *small[1:], *options)
        images.append((folder / "still.png").read_bytes())
    assert images[0] != images[1]


def unknown(folder):
    """A wrong name is told before anything grows, with what there is."""
    document = mixed(folder)
    for name in ("oak", "row.1", "row.7", "row-1", "row-1.0", "place", "place-0", "place-4", "place-2.0", "obstacle", "", "row.",
                 ".", "row.-1", "row.00", "x" * 5000, "%s%n"):
        said = tap.run("build", document, f"--only={name}", "-o", folder / "none.glb", status=2).stderr
        assert "[unknown-stand]" in said and "shrub, climber, stake, place-1, place-2, place-3, row.0, row.2 to row.6" in said, said
    said = tap.run("build", document, "--only", "shrubs", status=2).stderr
    assert "did you mean 'shrub'?" in said, said
    many = folder / "many.frond"
    many.write_text(MIXED.replace("<place plant=\"shrub\"", "".join(
        f'<place plant="stake" at="{i % 90},9,0"/>' for i in range(3000)) + "<place plant=\"shrub\""))
    assert ", …" in tap.run("build", many, "--only", "x", status=2).stderr
    empty = folder / "empty.frond"
    empty.write_text('<frond version="1"/>')
    assert "there are: none" in tap.run("build", empty, "--only", "x", status=2).stderr
    assert not (folder / "none.glb").exists()
    gaps = folder / "gaps.frond"
    gaps.write_text(MIXED.replace('except="1"', 'except="0 2 3 6"'))
    said = tap.run("build", gaps, "--only", "x", status=2).stderr
    assert "place-3, row.1, row.4 to row.5" in said and "row.6" not in said, said
    for verb in ("check", "derive"):
        tap.run(verb, document, "--only", "shrub", status=2)


def seeds_without_place(folder):
    """What never got a place is no model; others of the same call are."""
    document = folder / "taken.frond"
    document.write_text(MIXED.replace('<obstacle', '<place plant="shrub" at="2, -1, 0"/><obstacle'))
    model = folder / "none.glb"
    for verb, name in (("build", "none.glb"), ("render", "none.png"), ("info", None)):
        more = ("-o", folder / name) if name else ()
        said = tap.run(verb, document, "--only", "place-4", *more, status=1).stderr
        assert "error: nothing of what --only names has grown" in said and "[only-seeds]" in said, said
        assert name is None or not (folder / name).exists(), name
    tap.run("render", document, "-o", folder / "grow.png", "--frames", "1..2", "--only", "place-4", status=1)
    assert not list(folder.glob("*.png"))
    (node,) = built(folder, document, "--only", "place-4", "--only", "place-1", "--in-place").nodes()
    assert node["name"] == "shrub", node
    assert not model.exists()


def in_place_alone(folder):
    """--in-place says nothing without --only, so it is a mistake."""
    for verb, name in (("build", "x.glb"), ("render", "x.png")):
        said = tap.run(verb, mixed(folder), "--in-place", "-o", folder / name, status=2).stderr
        assert "there is no --only" in said and not (folder / name).exists(), said


def told(folder):
    """info tells of a plant as it has grown in the scene, with the numbers of its model."""
    document = mixed(folder)
    whole = json.loads(tap.run("info", document, "--only", "place-1", "--json").stdout)
    (shrub,) = whole["stands"]
    assert shrub["plant"] == "shrub" and shrub["at"] == [0, 0, 0] and shrub["nodes"] > 4, shrub
    alone = json.loads(tap.run("info", document, "--json").stdout)["plants"]
    assert shrub["nodes"] != next(plant["nodes"] for plant in alone if plant["id"] == "shrub"), alone
    stats = tap.statistics(document, "--only", "place-1")
    assert (stats["nodes"], stats["organs"]) == (shrub["nodes"], shrub["organs"]), (stats, shrub)
    text = tap.run("info", document, "--only", "row.0", "--only", "climber").stdout.splitlines()
    assert [line.split(": ")[0] for line in text[:2]] == ["climber at 0.8, 0, 0", "climber at -0.8, 0, 0"], text
    assert len(text) == 3 and text[2].split(" at ")[1].startswith("-3, 1, 0: "), text
    assert "[unknown-stand]" in tap.run("info", document, "--only", "oak", status=2).stderr
    assert "go together" in tap.run("info", document, "--only", "stake", "--paths", "stem", status=2).stderr
    built(folder, document)
    assert "a model" in tap.run("info", folder / "model.glb", "--only", "stake", status=2).stderr


def without_places(folder):
    """The one plant of a document stands in its scene, too."""
    document = tap.SOURCE / "examples" / "figure2.frond"
    text = document.read_text(encoding="utf-8")
    name = text.split('<plant id="')[1].split('"')[0]
    assert tap.statistics(document, "-q", "--only", name)["digest"] == tap.statistics(document, "-q")["digest"]


sys.exit(tap.main([
    ("a plant that has grown among others is written as it stands there, bit for bit", grown_together),
    ("so are p-graphs, L-systems and plants of rows, where they stand", every_kind),
    ("several names give several plants, which keep their distances", several),
    ("pictures and sequences show it alone", pictures),
    ("a name that nothing has lists what there is", unknown),
    ("a seed that has no place is told and nothing is written", seeds_without_place),
    ("--in-place needs --only", in_place_alone),
    ("info tells of a plant as it stands in the scene", told),
    ("a document without places has its first plant", without_places),
]))
