"""The presets: each is sound, light, documented and a beginning that works."""

import json
import os
import re
import struct
import sys
import xml.etree.ElementTree

import frond_tap as tap

DATA = tap.SOURCE / "data"
PRESETS = sorted((DATA / "presets").glob("*.frond"))
MOST_TRIANGLES = 400_000
MOST_LINES = 70
MOST_THUMBNAIL_BYTES = 2_000_000
os.environ["FROND_DATA"] = str(DATA)


def no_complaint(preset):
    done = tap.run("check", preset)
    assert done.stdout + done.stderr == "", done.stdout + done.stderr


def grows(preset, folder):
    made = tap.statistics(preset, "-q", "-o", folder / "plant.glb")
    assert 0 < made["triangles"] <= MOST_TRIANGLES, f"{made['triangles']} triangles"


def begins_a_document(preset, folder):
    path = folder / "mine.frond"
    tap.run("new", path, "--preset", preset.stem, "-q")
    assert path.read_bytes() == preset.read_bytes()
    no_complaint(path)


def sound(preset):
    def test(folder):
        no_complaint(preset)
        grows(preset, folder)
        begins_a_document(preset, folder)
    return test


def plants_of(preset, *options):
    done = tap.run("info", preset, "--json", *options)
    assert done.stderr == "", done.stderr
    return {plant["id"]: plant for plant in json.loads(done.stdout)["plants"]}


def model_of(folder, preset, *options):
    path = folder / "model.glb"
    tap.run("build", str(preset), "-o", str(path), "-q", *options)
    return path.read_bytes()


def sliders_do_something(folder):
    """At both ends of every slider a plant grows, and it is another one than before."""
    for preset in PRESETS:
        for name, plant in plants_of(preset).items():
            if preset.stem != "phyllotaxis":  # whose four plants are to be compared as they are
                assert plant["sliders"], f"{preset.stem} has no sliders"
            for slider in plant["sliders"]:
                what = f"{preset.stem}: {slider['id']}"
                assert slider["label"], f"{what} has no label"
                for end in ("min", "max"):
                    set_to = f"--set={name}.{slider['id']}={slider[end]:.10g}"
                    other = plants_of(preset, set_to)[name]
                    is_same = slider[end] == slider["value"]
                    does_nothing = other["digest"] == plant["digest"]
                    if does_nothing and "choices" in slider:  # what it picks may be a material
                        does_nothing = model_of(folder, preset, set_to) == model_of(folder, preset)
                    assert does_nothing == is_same, f"{what} at its {end}"


def all_are_there(folder):
    told = json.loads(tap.run("presets", "--json").stdout)
    listed = [preset["name"] for preset in told if not preset["own"]]
    assert listed == [preset.stem for preset in PRESETS]
    assert len(listed) >= 24, f"only {len(listed)} presets"


def each_can_be_read(folder):
    for preset in PRESETS:
        text = preset.read_text(encoding="utf-8")
        lines = text.count("\n")
        assert lines <= MOST_LINES, f"{preset.name} has {lines} lines"
        comments = re.findall(r"<!-- (.*?) -->", text.split("<frond")[0], re.DOTALL)
        assert len(comments) >= 2, f"{preset.name} begins without its name and source"


def colours_meet_the_cut(folder):
    """A painted blade that is not elliptic is painted in the form in which it is cut."""
    for preset in PRESETS:
        root = xml.etree.ElementTree.parse(preset).getroot()
        materials = {each.get("id"): each for each in root.iter("material")}
        for leaf in root.iter("leaf"):
            material = materials.get(leaf.get("material"))
            if material is None or material.get("texture") is None:
                continue
            what = f"{preset.name}: leaf {leaf.get('id')}, material {material.get('id')}"
            if leaf.get("outline", "elliptic") != "elliptic":
                assert material.get("outline") is not None, what
            else:
                assert leaf.get("outline-points") == material.get("outline"), what


def each_has_a_thumbnail(folder):
    size = 0
    for preset in PRESETS:
        picture = preset.with_suffix(".png").read_bytes()
        size += len(picture)
        assert picture[:8] == b"\x89PNG\r\n\x1a\n", f"{preset.stem}.png is not PNG"
        assert struct.unpack(">II", picture[16:24]) == (240, 300), f"{preset.stem}.png"
    assert size < MOST_THUMBNAIL_BYTES, f"the thumbnails have {size} bytes"
    alone = [path.name for path in (DATA / "presets").glob("*.png")
             if not path.with_suffix(".frond").exists()]
    assert alone == [], f"thumbnails without a preset: {alone}"


def gallery_shows_all(folder):
    page = (tap.SOURCE / "docs" / "presets.md").read_text(encoding="utf-8")
    shown = re.findall(r"\]\(\.\./data/presets/([^)]*)\.png\)", page)
    assert sorted(shown) == [preset.stem for preset in PRESETS]


TESTS = [(f"/program/presets/{preset.stem} is sound and begins a document", sound(preset))
         for preset in PRESETS]
TESTS += [
    ("/program/presets/the program lists them all", all_are_there),
    ("/program/presets/each is short and says what it is", each_can_be_read),
    ("/program/presets/their sliders do something", sliders_do_something),
    ("/program/presets/the picture of a leaf has the outline of its blade", colours_meet_the_cut),
    ("/program/presets/each has a thumbnail", each_has_a_thumbnail),
    ("/program/presets/the gallery shows them all", gallery_shows_all),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
