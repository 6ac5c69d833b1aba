"""A reader of MTG files, written after the format's definition, finds the plants in ours."""

import json
import math
import sys

import frond_tap as tap

SCALES = {"P": 1, "A": 2, "I": 3, "L": 3, "O": 3}


def read(path):
    """The entities of a file: dicts with label, relation, and the entity that each hangs on."""
    lines = path.read_text().splitlines()
    sections = [line.rstrip(":") for line in lines if line.endswith(":") and "\t" not in line]
    assert sections == ["CLASSES", "DESCRIPTION", "FEATURES", "MTG"], sections
    classes = dict(line.split("\t")[:2] for line in lines[lines.index("CLASSES:") + 2:][:6])
    assert {k: int(v) for k, v in classes.items() if k != "$"} == SCALES, classes
    title = lines.index("MTG:") + 1
    names = lines[title].split()[1:]
    columns = lines[title].split("\t").index(names[0])
    entities, last, plant = [], {}, 0  # the last internode or plant of each column
    for line in lines[title + 1:]:
        cells = line.split("\t")
        column = next(i for i, cell in enumerate(cells) if cell)
        assert column < columns and len(cells) == columns + len(names), line
        values = dict(zip(names, cells[columns:]))
        label = cells[column]
        relation, bearer = label[0], last.get(column - 1)
        if relation == "^":
            relation, bearer = label[1], last[column]
        assert relation in "/<+", label
        parts = label.lstrip("^/<+").split("/")
        entity = {"class": parts[-1][0], "relation": relation, "bearer": bearer, "axis": len(parts) == 2,
                  "at": [float(values[k]) for k in ("XX", "YY", "ZZ")], **values}
        plant += entity["class"] == "P"
        entity["plant"] = plant
        entities.append(entity)
        last[column] = entity
        for deeper in [c for c in last if c > column]:
            del last[deeper]
    return entities


def of_class(entities, letter):
    return [entity for entity in entities if entity["class"] == letter]


def counts_agree(example):
    def test(folder):
        path = folder / "plant.mtg"
        stats = tap.statistics(example, "-o", path)
        entities = read(path)
        internodes = of_class(entities, "I")
        real = [i for i in internodes if i["Name"] or float(i["Length"]) > 0]
        assert len(of_class(entities, "P")) == stats["plants"], stats
        assert len(real) == stats["nodes"], (len(real), stats)
        assert len(of_class(entities, "L")) + len(of_class(entities, "O")) == stats["organs"], stats
        followers = {}
        for internode in internodes:
            if internode["relation"] == "<":
                followers[id(internode["bearer"])] = followers.get(id(internode["bearer"]), 0) + 1
        assert all(count == 1 for count in followers.values())
    return test


def lengths_are_distances(folder):
    path = folder / "plant.mtg"
    tap.run("build", tap.SOURCE / "examples" / "chestnut.frond", "-o", path)
    checked = 0
    for internode in of_class(read(path), "I"):
        if internode["relation"] == "<":
            distance = math.dist(internode["at"], internode["bearer"]["at"])
            assert abs(distance - float(internode["Length"])) < 1e-4, internode
            checked += 1
    assert checked > 10000, checked


def branches_as_published(folder):
    path = folder / "figure2.mtg"
    tap.run("build", tap.SOURCE / "examples" / "figure2.frond", "-o", path)
    axes = [entity for entity in read(path) if entity["axis"]]
    assert [axis["Name"] for axis in axes] == ["B"] + 9 * ["D"]
    bearers = [axis["bearer"]["Name"] for axis in axes]
    assert bearers == ["figure2"] + 3 * ["B", "D", "D"], bearers


def stands_are_plants(folder):
    document = folder / "row.frond"
    document.write_text("""<frond version="1">
  <plant id="rod"><pgraph><horn id="stem" length="2" radius="0.1"/></pgraph></plant>
  <scene><place plant="rod" at="0 0 0"/><place plant="rod" at="5 1 0" scale="2"/></scene>
</frond>
""")
    path = folder / "row.mtg"
    tap.run("build", document, "-o", path)
    entities = read(path)
    tips = [[i for i in of_class(entities[begin:end], "I")][-1]["at"]
            for begin, end in ((0, len(entities) // 2), (len(entities) // 2, None))]
    assert all(math.dist(tip, want) < 1e-5 for tip, want in zip(tips, ([0, 0, 2], [5, 1, 4]))), tips


def comes_back_as_lines(folder):
    path, document = folder / "chestnut.mtg", folder / "again.frond"
    source = tap.SOURCE / "examples" / "chestnut.frond"
    tap.run("convert", source, path)
    tap.run("convert", path, document)
    assert 'file="chestnut.mtg"' in document.read_text()
    stats, again = tap.statistics(source), tap.statistics(document)
    assert again["nodes"] == stats["nodes"], (again, stats)
    tap.run("convert", document, folder / "again.txt")
    tips = lambda p: sorted(line.split()[3:6] for line in p.read_text().splitlines() if line[0] != "#")
    drawn = sorted([f"{v:.2f}" for v in i["at"]] for i in of_class(read(path), "I"))
    kept = sorted([f"{float(v):.2f}" for v in tip] for tip in tips(folder / "again.txt"))
    missing = {tuple(tip) for tip in drawn} - {tuple(tip) for tip in kept}
    assert len(missing) < len(drawn) / 200, len(missing)  # those that rounding parts


def bent_internodes_are_one(folder):
    """Axes drawn as splines have the internodes that have grown, at least as long as their chords."""
    document = folder / "tree.frond"
    document.write_text("""<frond version="1">
  <plant id="tree"><species model="open" step="0.4"/></plant>
  <scene><growth steps="12" min="-8,-8,0" max="8,8,12"/>
    <place plant="tree" at="0,0,0"/><place plant="tree" at="2,0,0"/></scene>
</frond>
""")
    path = folder / "tree.mtg"
    stats = tap.statistics(document, "-o", path)
    internodes = of_class(read(path), "I")
    assert len(internodes) == stats["nodes"] == stats["per_step"][-1]["nodes"], (len(internodes), stats)
    spare = [float(i["Length"]) - math.dist(i["at"], i["bearer"]["at"]) for i in internodes
             if i["relation"] == "<"]
    assert min(spare) > -1e-4 and max(spare) > 1e-4, (min(spare), max(spare))
    whole = tap.statistics(document, "--set", "tree.species.smooth=no")
    assert whole["nodes"] == stats["nodes"], (whole, stats)
    done = tap.run("info", document, "--only", "place-1", "--json")
    one = json.loads(done.stdout)["stands"][0]["nodes"]
    first = sum(1 for i in internodes if i["plant"] == 1)
    assert one == first > 4, (one, first)


def lines_make_a_document(folder):
    (folder / "scan.txt").write_text("0 0 0  0 0 1  0.1\n0 0 1  0 1 2  0.05\n")
    tap.run("convert", folder / "scan.txt", folder / "scan.frond")
    assert tap.statistics(folder / "scan.frond")["nodes"] == 2
    (folder / "bad.txt").write_text("0 0 0  0 0\n")
    done = tap.run("convert", folder / "bad.txt", folder / "bad.frond", status=1)
    assert "bad.txt:1:" in done.stderr and not (folder / "bad.frond").exists()


TESTS = [(f"/mtg/{example.stem} has all its internodes and organs", counts_agree(example))
         for example in tap.EXAMPLES if example.stem in
         ("figure2", "sunflower", "chestnut", "sheet-multipliers", "shore-trees")]
TESTS += [
    ("/mtg/internodes are as long as their tips are apart", lengths_are_distances),
    ("/mtg/an internode that bends is one", bent_internodes_are_one),
    ("/mtg/figure 2 has its three chains of three", branches_as_published),
    ("/mtg/each place is a plant of its own", stands_are_plants),
    ("/mtg/a plant comes back from its graph as lines", comes_back_as_lines),
    ("/mtg/a table of lines becomes a document", lines_make_a_document),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
