"""OPF files, read as XML: the same plants as our MTG files have, placed by their matrices."""

import math
import struct
import sys
import xml.etree.ElementTree as xml

import frond_tap as tap

ENTITIES = ("decomp", "follow", "branch")


def matrix(element):
    """What an entity's matrix makes of a point, metres."""
    rows = [[float(v) for v in row.split()] for row in element.find("geometry/mat").text.split("\n")]
    return lambda point: [(sum(a * b for a, b in zip(row, point)) + row[3]) / 100 for row in rows]


def mtg_of(document, folder):
    """(class, Name, place of the tip, length) of the internodes of our .mtg, in its order."""
    path = folder / "plant.mtg"
    tap.run("build", document, "-q", "-o", path)
    lines = path.read_text().splitlines()
    title = lines.index("MTG:") + 1
    columns = lines[title].split("\t").index("Name")
    rows = []
    for line in lines[title + 1:]:
        cells = line.split("\t")
        label = "".join(cells[:columns])
        if label.lstrip("^/<+").split("/")[-1][0] == "I":
            rows.append((cells[columns], [float(v) for v in cells[columns + 3:columns + 6]],
                         float(cells[columns + 1]), float(cells[columns + 2])))
    return rows


def opf_of(document, folder):
    path = folder / "plant.opf"
    stats = tap.statistics(document, "-o", path)
    return xml.parse(path).getroot(), stats


def of_class(root, name):
    return [e for e in root.find("topology").iter() if e.tag in ENTITIES and e.get("class") == name]


def same_internodes(document):
    def test(folder):
        wanted = mtg_of(document, folder)
        root, stats = opf_of(document, folder)
        internodes = [e for e in of_class(root, "Internode") if e.find("geometry") is not None]
        wanted = [row for row in wanted if row[0] or row[2] > 0]
        assert len(internodes) == len(wanted) == stats["nodes"]
        for element, (name, tip, length, radius) in zip(internodes, wanted):
            place = matrix(element)
            assert element.findtext("Name") == name
            assert math.dist(place((1, 0, 0)), tip) < 2e-5, (place((1, 0, 0)), tip)
            assert abs(math.dist(place((0, 0, 0)), place((1, 0, 0))) - length) < 2e-5
            assert abs(float(element.findtext("geometry/dUp")) - 200 * radius) < 2e-4
        assert len(of_class(root, "Leaf")) + len(of_class(root, "Organ")) == stats["organs"]
    return test


def references_are_there(document):
    def test(folder):
        root, _ = opf_of(document, folder)
        meshes = {m.get("Id"): m for m in root.find("meshBDD")}
        materials = {m.get("Id") for m in root.find("materialBDD")}
        shapes = {s.get("Id"): s for s in root.find("shapeBDD")}
        assert len(meshes) == len(root.find("meshBDD")) and len(shapes) == len(root.find("shapeBDD"))
        for shape in shapes.values():
            assert shape.findtext("meshIndex") in meshes and shape.findtext("materialIndex") in materials
        for mesh in meshes.values():
            points = len(mesh.findtext("points").split()) // 3
            corners = [int(i) for face in mesh.find("faces") for i in face.text.split()]
            assert points > 0 and max(corners) < points and len(corners) % 3 == 0
        used = {e.text for e in root.find("topology").iter("shapeIndex")}
        assert used and used <= set(shapes)
        ids = [e.get("id") for e in root.find("topology").iter() if e.tag in ENTITIES]
        assert len(set(ids)) == len(ids)
    return test


def leaves_are_where_models_have_them(folder):
    """The box of all leaves' points is that of the organs in the .obj without wood."""
    document = folder / "leaf.frond"
    document.write_text("""<frond version="1">
  <plant id="p"><pgraph><leaf id="blade" length="0.2" width="0.1" petiole-length="0"/></pgraph></plant>
  <scene><place plant="p" at="1 2 0.5" turn="40" scale="3"/></scene>
</frond>
""")
    root, _ = opf_of(document, folder)
    tap.run("build", document, "-q", "-o", folder / "leaf.ply")
    data = (folder / "leaf.ply").read_bytes()
    count = int(data.split(b"element vertex ")[1].split()[0])
    body = data[data.index(b"end_header\n") + 11:]
    points = [struct.unpack_from("<3f", body, 32 * i) for i in range(count)]
    leaf = of_class(root, "Leaf")[0]
    shape = next(s for s in root.find("shapeBDD") if s.get("Id") == leaf.findtext("geometry/shapeIndex"))
    mesh = next(m for m in root.find("meshBDD") if m.get("Id") == shape.findtext("meshIndex"))
    own = [float(v) for v in mesh.findtext("points").split()]
    place = matrix(leaf)
    placed = [place(own[i:i + 3]) for i in range(0, len(own), 3)]
    for axis in range(3):
        for bound in (min, max):
            assert abs(bound(p[axis] for p in placed) - bound(p[axis] for p in points)) < 1e-4


def bent_internodes_are_segments(folder):
    """Of the same number and length as in the graph; each segment goes on where one ended."""
    document = folder / "tree.frond"
    document.write_text("""<frond version="1">
  <plant id="tree"><species model="open" step="0.4"/></plant>
  <scene><growth steps="12" min="-8,-8,0" max="8,8,12"/><place plant="tree" at="0,0,0"/>
    <place plant="tree" at="2,0,0"/></scene>
</frond>
""")
    wanted = mtg_of(document, folder)
    root, _ = opf_of(document, folder)
    internodes = of_class(root, "Internode")
    assert len(internodes) == len(wanted)
    bent = 0
    for element, (_, tip, length, _) in zip(internodes, wanted):
        parts = [e for e in element.findall("decomp") if e.get("class") == "Segment"] or [element]
        places = [matrix(e) for e in parts]
        bent += len(parts) > 1
        assert math.dist(places[-1]((1, 0, 0)), tip) < 2e-5
        assert all(math.dist(a((1, 0, 0)), b((0, 0, 0))) < 2e-5 for a, b in zip(places, places[1:]))
        assert abs(sum(math.dist(p((0, 0, 0)), p((1, 0, 0))) for p in places) - length) < 5e-5
    assert bent > 10, bent


EXAMPLES = {name: tap.SOURCE / "examples" / f"{name}.frond"
            for name in ("figure2", "sunflower", "sheet-multipliers", "shore-trees")}
TESTS = [(f"/opf/{name} has the internodes of its graph", same_internodes(path))
         for name, path in EXAMPLES.items()]
TESTS += [(f"/opf/{name} names meshes and materials that it has", references_are_there(path))
          for name, path in EXAMPLES.items()]
TESTS.append(("/opf/an internode that bends is made of segments", bent_internodes_are_segments))
TESTS.append(("/opf/leaves stand where a model has them", leaves_are_where_models_have_them))

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
