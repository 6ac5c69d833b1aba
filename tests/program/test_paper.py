"""The table of what Lintermann and Deussen's paper names, and its plants as a whole."""

import json
import re
import sys
import xml.etree.ElementTree

import frond_tap as tap

PAGE = tap.SOURCE / "docs" / "paper-1.md"
FAMILIES = {"S": 10, "L": 7, "B": 7, "C": 37, "F": 7, "X": 3}
MOST_BYTES = 1_500_000_000


def components_of(example, *options):
    done = tap.run("info", tap.SOURCE / "examples" / f"{example}.frond", "--json", *options)
    plant = json.loads(done.stdout)["plants"][0]
    return {component["id"]: component["instances"] for component in plant["components"]}


def table_is_right(folder):
    """Every id has a row; every test that it names is there, and every picture."""
    text = PAGE.read_text(encoding="utf-8")
    ids = set(re.findall(r"\b([A-Z]\d+)\b", "".join(
        line.split("|")[1] for line in text.splitlines() if line.startswith("| "))))
    expected = {f"{family}{i}" for family, count in FAMILIES.items() for i in range(1, count + 1)}
    assert expected <= ids, f"without a row: {sorted(expected - ids)}"
    sources = "".join(path.read_text(encoding="utf-8")
                      for kind in ("*.c", "*.py") for path in (tap.SOURCE / "tests").rglob(kind))
    for group, name in re.findall(r"`/(\w+(?:/\w+)?)/([^`]*)`", text):
        begin = name.removesuffix(" …").removesuffix("…")
        assert re.search(rf'["/]{re.escape(begin)}', sources), f"no test /{group}/{name}"
    gallery = (tap.SOURCE / "docs" / "gallery.md").read_text(encoding="utf-8")
    for names in re.findall(r"pictures? ((?:`[\w-]+`(?:, )?)+)", text):
        for name in re.findall(r"`([\w-]+)`", names):
            picture = tap.SOURCE / "docs" / "pictures" / f"{name}.png"
            assert picture.exists(), f"no picture {name}"
            assert picture.name in gallery or name == "sunflower", f"{name} is not in the gallery"


def manual_walks(folder):
    """The steps of the first plant begin with what `frond new` makes and hold what the page shows."""
    steps = tap.SOURCE / "docs" / "first-plant"
    tap.run("new", folder / "mine", "-q")
    assert (folder / "mine.frond").read_bytes() == (steps / "1.frond").read_bytes()
    documents = [path.read_text(encoding="utf-8") for path in sorted(steps.glob("*.frond"))]
    written = [" ".join(document.split()) for document in documents]
    page = (tap.SOURCE / "docs" / "first-plant.md").read_text(encoding="utf-8")
    for block in re.findall(r"```xml\n(.*?)```", page, re.DOTALL):
        for element in re.findall(r"<.*?/>", block, re.DOTALL):
            assert any(" ".join(element.split()) in text for text in written), element
    for path in sorted(steps.glob("*.frond")):
        assert tap.run("check", path).stderr == "", path


def many_leaves(folder):
    chestnut = tap.SOURCE / "examples" / "chestnut.frond"
    made = tap.statistics(chestnut, "-q", "--set", "shoot.number=36", "--leaves", "gpu",
                          "-o", folder / "chestnut.glb")
    assert made["by_component"]["leaf"] >= 300_000, made["by_component"]
    assert made["peak_bytes"] < MOST_BYTES, made["peak_bytes"]
    print(f"# {made['by_component']['leaf']} leaves, {made['seconds']['total']:.2f} s, "
          f"{made['peak_bytes'] / 1e6:.0f} MB", flush=True)


def rhododendron(folder):
    made = components_of("rhododendron")
    path = tap.SOURCE / "examples" / "rhododendron.frond"
    root = xml.etree.ElementTree.parse(path).getroot()
    flags = {each.get("id"): each.get("only") for each in root.iter() if each.get("only")}
    assert set(flags.values()) == {"!2,13", "2,13"}, flags
    twigs = made["twig"]
    assert twigs == 20, made
    stalks = sum(made[name] for name, only in flags.items() if only == "2,13")
    assert stalks == 2 * twigs, made
    assert any(each.tag == "revo" for each in root.iter()), "no container"


TESTS = [
    ("/program/paper/every point of the table has its test or picture", table_is_right),
    ("/program/paper/the manual's first plant is what it says", manual_walks),
    ("/program/paper/S10 a chestnut of 300 000 leaves is built and written", many_leaves),
    ("/program/paper/the rhododendron has twenty twigs and two exceptions on each", rhododendron),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
