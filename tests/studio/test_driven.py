"""The studio with a person's hands: dragging, sliding, drawing, undoing, saving, on a real display."""

import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import time

import studio_driver as driver

SOURCE = pathlib.Path(os.environ.get("FROND_SOURCE", "."))
PICTURES = pathlib.Path(os.environ.get("FROND_PICTURES", "build/studio-pictures"))

BEGINNING = """<?xml version="1.0" encoding="UTF-8"?>
<frond version="1">
  <!-- a stem -->
  <material id="green" texture="leaf" colour="#4f7a2c" size="64"/>
  <curve id="thick" points="0,1 0.5,0.6 1,0.2"/>
  <plant id="flower" seed="1">
    <pgraph>
      <camera id="root"/>
      <horn id="stem" length="0.6" radius="0.01"/>
      <link from="root" to="stem"/>
    </pgraph>
  </plant>
</frond>
"""


WEED = """<frond version="1">
  <plant id="weed">
    <lsystem steps="4">
      <define id="turn" value="25"/>
      <![CDATA[
Lsystem: 1
derivation length: 4
axiom: F(0.02)
F(x) --> F(x)[+(turn)F(x)]F(x)[-(turn)F(x)]F(x)
endlsystem
]]>
    </lsystem>
  </plant>
</frond>
"""


ROOM = """<frond version="1">
  <plant id="p"><pgraph><horn id="h" length="0.6" radius="0.03"/></pgraph></plant>
  <scene sun-strength="0" sky-strength="0">
    <light by="density" photons="4000" distance="0.2" reference="0.4, 0, 0.5"/>
    <lamp id="bulb" at="0, 0, 0.9"/>
    <obstacle at="0, 0, -0.1" size="2, 2, 0.1"/>
    <place plant="p"/>
  </scene>
</frond>
"""


BULBS = """<frond version="1">
  <plant id="p"><pgraph><horn id="h" length="0.6" radius="0.1"/></pgraph></plant>
  <scene sun-strength="0" sky-strength="0">
    <lamp id="red" at="-1, -0.5, 0.3" colour="#ff6060"/>
    <lamp id="blue" at="1, -0.5, 0.3" colour="#6060ff"/>
    <place plant="p"/>
    <view name="front" azimuth="0" elevation="0"/>
  </scene>
</frond>
"""


PATCH = """<frond version="1">
  <plant id="p">
    <pgraph>
      <hyperpatch id="patch" box-from="-0.2, -0.2, 0" box-to="0.2, 0.2, 0.6"/>
      <simple id="block" primitive="cylinder" size="0.3, 0.3, 0.6" detail="24"/>
      <link from="patch" to="block"/>
    </pgraph>
  </plant>
</frond>
"""


GROVE = """<frond version="1">
  <plant id="tree">
    <species leaf-length="0.3" leaf-width="0.2"/>
  </plant>
  <scene>
    <growth steps="0"/>
    <place plant="tree" at="0, 0, 0"/>
  </scene>
</frond>
"""


ROWS = """<frond version="1">
  <plant id="tree"><pgraph><horn id="h" length="2 ~ 0.5" radius="0.05"/></pgraph></plant>
  <scene>
    <row plants="tree" spacing="2" turn="0">-4,0,0 4,0,0</row>
    <strew plants="tree" number="30" at="0, 8, 0" width="10" depth="6"/>
  </scene>
</frond>
"""


class Run:
    """One studio for all tests, as a person has one."""

    def __init__(self):
        self.home = tempfile.mkdtemp(prefix="frond-studio-")
        self.display = driver.Display()
        self.studio = driver.Studio(self.display, self.home)
        self.file = os.path.join(self.home, "flower.frond")
        with open(self.file, "w", encoding="utf-8") as file:
            file.write(BEGINNING)
        PICTURES.mkdir(parents=True, exist_ok=True)

    def close(self):
        self.studio.kill()
        self.display.close()
        shutil.rmtree(self.home)

    def picture(self, name):
        self.studio.wait()
        self.studio.ask(f"picture {PICTURES / name}.png")


def test_examples(run):
    """every example opens without a problem and is drawn"""
    run.studio.ask("size 900 600")
    for file in sorted((SOURCE / "examples").glob("*.frond")):
        run.studio.ask(f"open {file}")
        run.picture("example-" + file.stem)
        state = run.studio.state()
        assert state["problems"] == 0, f"{file.name}: {state}"
        assert state["triangles"] > 0, f"{file.name}: nothing is drawn"
        assert state["saved"], f"{file.name} was changed by opening it"


def test_broken(run):
    """a document that cannot be read shows no plant of the one before"""
    broken = os.path.join(run.home, "broken.frond")
    with open(broken, "w", encoding="utf-8") as file:
        file.write('<frond version="1"><plant id="p"')
    run.studio.ask(f"open {SOURCE / 'examples' / 'sunflower.frond'}")
    run.studio.wait()
    assert run.studio.state()["triangles"] > 0
    run.studio.ask(f"open {broken}")
    run.picture("broken")
    state = run.studio.state()
    assert state["problems"] == 1 and state["triangles"] == 0, state


def test_welcome(run):
    """a new window welcomes with presets"""
    run.studio.ask("size 1440 900")
    run.picture("welcome")


def open_flower(run):
    run.studio.ask("size 1440 900")
    run.studio.ask(f"open {run.file}")
    run.studio.wait()
    run.first = run.studio.state()["digest"]


def open_grove(run):
    studio = run.studio
    grove = os.path.join(run.home, "grove.frond")
    with open(grove, "w", encoding="utf-8") as file:
        file.write(GROVE)
    studio.ask(f"open {grove}")
    studio.wait()
    studio.ask("turn 0 20 7")
    studio.wait()


def test_grove(run):
    """three trees are planted by clicks and grow ten steps"""
    open_grove(run)
    studio = run.studio
    studio.click(studio.middle("tool-plant"))
    for place in ((1.5, -0.5, 0), (-1.5, 0, 0), (0.5, 1.5, 0)):
        studio.click(studio.point(*place))
        studio.wait()
    state = studio.state()
    assert state["steps"] == 3 and state["problems"] == 0, state
    assert studio.text(run.home).count("<place") == 4
    for _ in range(10):
        studio.click(studio.middle("A step"))
        studio.wait()
    grown = studio.state()
    assert grown["leaves"] > 20 and grown["digest"] == state["digest"], grown
    run.picture("grove-grown")


def test_levels(run):
    """a species has three levels; one of its six numbers is dragged as one step"""
    studio = run.studio
    before = studio.state()
    studio.ask("do select::tree")
    studio.click(studio.middle("level-1"))
    run.picture("levels-plant")
    studio.click(studio.middle("level-2"))
    studio.wait()
    x, y, width, height = studio.where("six-gravity")
    studio.drag([x + width / 2, y + height / 2], [x + 0.2 * width, y + height / 2])
    studio.wait()
    state = studio.state()
    assert state["steps"] == before["steps"] + 1, state
    assert '<sliders gravity="-' in studio.text(run.home), studio.text(run.home)
    run.picture("levels-shape")
    studio.click(studio.middle("level-3"))
    run.picture("levels-all")
    studio.click(studio.middle("level-2"))
    studio.ask("do undo")
    studio.wait()
    assert studio.state()["digest"] == before["digest"]


def test_arrange(run):
    """a tree is moved by its handle, others are painted and taken out, a road is drawn"""
    studio = run.studio
    studio.click(studio.middle("tool-move"))
    studio.click(studio.point(1.5, -0.5, 0))
    assert studio.state()["selected"].endswith("place#1"), studio.state()
    foot = studio.point(1.5, -0.5, 0)
    studio.drag(foot, [foot[0] + 60, foot[1] + 30])
    studio.wait()
    assert studio.state()["steps"] == 4, "a drag is one step"
    assert studio.text(run.home).count("<place") == 4
    run.picture("grove-moved")
    studio.pointer("key", "Delete")
    studio.wait()
    assert studio.text(run.home).count("<place") == 3
    studio.pointer("key", "b")
    now = studio.state()
    studio.drag(studio.point(-2, -2, 0), studio.point(1, -2, 0), is_cancelled=True)
    is_left(studio, now)
    studio.drag(studio.point(-2, -2, 0), studio.point(1, -2, 0))
    studio.wait()
    painted = studio.text(run.home).count("<place")
    assert painted > 3 and studio.state()["steps"] == 6, studio.state()
    studio.pointer("key", "x")
    studio.drag(studio.point(-2, -2, 0), studio.point(1, -2, 0))
    studio.wait()
    assert studio.text(run.home).count("<place") < painted
    studio.pointer("key", "r")
    now = studio.state()
    studio.drag(studio.point(-2, 0.8, 0), studio.point(2, 1, 0), is_cancelled=True)
    is_left(studio, now)
    studio.drag(studio.point(-2, 0.8, 0), studio.point(2, 1, 0))
    studio.wait()
    assert studio.text(run.home).count("<obstacle") == 2 and studio.state()["problems"] == 0
    studio.pointer("key", "e")
    foot = studio.point(0, 0, 0.1)
    studio.drag([foot[0] + 5, foot[1]], [foot[0] + 60, foot[1] - 120])
    studio.wait()
    assert "envelope=" in studio.text(run.home)
    run.picture("grove-arranged")
    steps = studio.state()["steps"]
    studio.ask("turn 0 -25 1")
    studio.wait()
    studio.pointer("key", "p")
    studio.click(studio.point(0, 400, 0))  # just below the horizon
    studio.wait()
    assert studio.state()["steps"] == steps, "planted far away"
    studio.pointer("key", "Escape")
    studio.undo_all()
    studio.wait()
    assert studio.text(run.home) == GROVE


def test_rows(run):
    """a plant of a row is taken out and moved, another left out, others brushed out of an area"""
    studio = run.studio
    rows = os.path.join(run.home, "rows.frond")
    with open(rows, "w", encoding="utf-8") as file:
        file.write(ROWS)
    studio.ask(f"open {rows}")
    studio.wait()
    studio.ask("turn 0 20 1.5")
    studio.ask("do scene-tool::move")
    studio.wait()
    studio.click(studio.point(2, 0, 0.8))
    studio.wait()
    run.picture("rows-one")
    studio.click(studio.middle("take-one"))
    studio.wait()
    state = studio.state()
    assert state["steps"] == 1 and state["selected"] == "frond/scene/place", state
    assert ' except="3"' in studio.text(run.home)
    studio.drag(studio.point(2, 0, 0), studio.point(2.5, -1.5, 0))
    studio.wait()
    assert '<place plant="tree" at="2.5, -1.5, 0"' in studio.text(run.home), studio.text(run.home)
    studio.click(studio.point(-2, 0, 0.8))
    studio.wait()
    studio.pointer("key", "shift+Delete")
    studio.wait()
    assert ' except="3 1"' in studio.text(run.home)
    studio.ask("do scene-tool::take-out")
    studio.drag(studio.point(-3, 8, 0), studio.point(3, 8, 0))
    studio.wait()
    assert studio.text(run.home).count("except=") == 2 and studio.state()["steps"] == 4
    run.picture("rows-brushed")
    studio.ask("do scene-tool::move")
    studio.click(studio.point(2.5, -1.5, 0.8))
    studio.wait()
    for key, end in (("alt", (4, -2, 0)), ("shift", (6, -3, 0))):
        begin = (2.5, -1.5, 0) if key == "alt" else (4, -2, 0)
        studio.pointer("keydown", key)
        studio.drag(studio.point(*begin), studio.point(*end))
        studio.pointer("keyup", key)
        studio.wait()
    text = studio.text(run.home)
    assert 'at="2.5, -1.5, 0"' in text and text.count("<place") == 2, text
    assert text.count(', -2, 0" seed=') == 1, text
    assert studio.state()["steps"] == 6, studio.state()
    studio.ask("do save-to('/proc/nowhere.frond')")
    assert "nowhere" in studio.ask("said"), studio.ask("said")
    studio.ask("do leave-one-out")
    studio.ask("do take-one")
    assert studio.ask("said").startswith("Click a plant of a row"), studio.ask("said")
    run.picture("rows-said")
    studio.ask("do scene-tool::select")
    studio.undo_all()
    studio.wait()
    assert studio.text(run.home) == ROWS


def test_flower(run):
    """a flower is built by dragging components onto others"""
    open_flower(run)
    studio = run.studio
    studio.drag(studio.middle("tool:phiball"), studio.middle("box:stem"))
    studio.wait()
    assert studio.state()["selected"].endswith("phiball:phiball"), studio.state()
    studio.drag(studio.middle("tool:leaf"), studio.middle("box:phiball"))
    studio.wait()
    state = studio.state()
    assert state["steps"] == 2 and state["leaves"] > 1, state
    assert state["problems"] == 0, state
    run.picture("flower-dragged")


def test_link(run):
    """a component dragged onto another is linked, onto itself repeated"""
    studio = run.studio
    before = studio.state()["steps"]
    studio.drag(studio.middle("tool:horn"), studio.middle("tool:horn", down=-6))
    studio.wait()
    assert studio.state()["steps"] == before + 1, "a horn that nothing leads to"
    studio.drag(studio.middle("box:horn"), studio.middle("box:stem"))
    studio.wait()
    assert studio.state()["steps"] == before + 2, studio.state()
    studio.drag(studio.middle("box:root"), studio.middle("box:stem"))
    studio.wait()
    assert studio.state()["steps"] == before + 2, "nothing may lead to the camera"
    run.picture("flower-linked")


def is_left(studio, before):
    """Nothing is left of a drag that was cancelled."""
    studio.wait()
    after = studio.state()
    assert after["digest"] == before["digest"] and after["steps"] == before["steps"], after


def test_escape(run):
    """a component that is dragged goes back by Escape, and names that are taken are refused"""
    studio = run.studio
    before = studio.state()
    begin, end = studio.middle("tool:leaf"), studio.middle("box:stem")
    studio.go(begin)
    studio.pointer("mousedown", 1)
    for step in range(1, 7):
        studio.go([a + (b - a) * step / 6 for a, b in zip(begin, end)])
    studio.wait()
    studio.pointer("key", "Escape")
    studio.go([end[0] + 1, end[1]])
    studio.pointer("mouseup", 1)
    studio.wait()
    assert studio.state()["digest"] == before["digest"], "it was dropped all the same"
    studio.ask("do select::stem")
    for name, why in (("leaf", "called leaf"), ("9x", "A name is")):
        studio.click(studio.middle("element-id"))
        studio.pointer("key", "ctrl+a")
        studio.pointer("type", name)
        studio.pointer("key", "Return")
        studio.wait()
        assert why in studio.ask("said"), studio.ask("said")
        run.picture("flower-name")
    assert studio.state()["digest"] == before["digest"]


def test_repeat(run):
    """a recursion ends at its first component once more, which stands for it"""
    studio = run.studio
    for name, first, other in (("chestnut-recursive", "wood", "shoot"), ("figure2", "D", "B")):
        studio.ask(f"open {SOURCE / 'examples' / name}.frond")
        studio.wait()
        studio.click(studio.middle("box:" + other))
        assert studio.state()["selected"].endswith(":" + other)
        assert studio.where("again:" + first)[1] > studio.where("box:" + first)[1]
        studio.click(studio.middle("again:" + first))
        assert studio.state()["selected"].endswith(":" + first), studio.state()
        run.picture("recursion-" + name)
        assert studio.state()["saved"]


def test_preset(run):
    """a part of a plant is kept as a preset, and put in again as one step"""
    studio = run.studio
    before = studio.state()
    studio.ask("do select::phiball")
    studio.ask("do save-preset")
    studio.wait()
    studio.ask(f"picture-of-dialog {PICTURES / 'preset-keep.png'}")
    studio.ask("close-dialog")
    studio.ask("do save-preset-as::a head")
    kept = os.path.join(run.home, "data", "frond", "presets", "a head")
    assert os.path.exists(kept + ".frond")
    studio.drag(studio.middle("tool:preset"), studio.middle("box:stem"))
    for _ in range(600):  # it is drawn meanwhile
        if os.path.exists(kept + ".png"):
            break
        time.sleep(0.1)
    assert os.path.exists(kept + ".png"), "it has no picture"
    time.sleep(0.5)
    studio.ask(f"picture-of-dialog {PICTURES / 'preset-insert.png'}")
    studio.ask("close-dialog")
    studio.ask("do select::stem")
    studio.ask("do insert-preset-named::a head")
    studio.wait()
    after = studio.state()
    assert after["steps"] == before["steps"] + 1 and after["problems"] == 0, after
    assert after["leaves"] == 2 * before["leaves"], after
    assert after["selected"].endswith("phiball:phiball2"), after
    studio.ask("do undo")
    studio.click(studio.middle("box:phiball"))
    studio.pointer("key", "ctrl+c")
    studio.click(studio.middle("box:stem"))
    studio.pointer("key", "ctrl+v")
    studio.wait()
    pasted = studio.state()
    assert pasted["steps"] == before["steps"] + 1 and pasted["leaves"] == after["leaves"], pasted
    studio.ask("do undo")
    studio.wait()
    assert studio.state()["digest"] == before["digest"]


def test_slider(run):
    """a slider that is dragged is one step"""
    studio = run.studio
    studio.ask("do select::stem")
    studio.wait()
    before = studio.state()
    x, y, width, height = studio.where("length-scale")
    share = 0.6 / 2  # of the range, 0 to 2 m
    studio.drag([x + 8 + share * (width - 16), y + height / 2], [x + 0.8 * width, y + height / 2],
                is_cancelled=True)
    is_left(studio, before)
    studio.drag([x + 8 + share * (width - 16), y + height / 2], [x + 0.8 * width, y + height / 2])
    studio.wait()
    after = studio.state()
    assert after["digest"] != before["digest"], "the slider does nothing"
    assert after["steps"] == before["steps"] + 1, after
    run.picture("flower-slider")


def popped_up(studio, button, name):
    """Where something is that a button lets pop up."""
    for _ in range(20):
        studio.click(studio.middle(button))
        time.sleep(0.4)
        try:
            return studio.middle(name)
        except AssertionError:
            continue  # the last one was just going away
    raise AssertionError(f"{button} shows no {name}")


def test_material(run):
    """a material is chosen by its look, copied, named, and given a picture that is missed"""
    studio = run.studio
    before = studio.state()
    studio.ask("do select::stem")
    studio.wait()
    studio.click(popped_up(studio, "material-picker", "material:green"))
    studio.wait()
    stem = studio.text(run.home).split('id="stem"')[1].split("/>")[0]
    assert 'material="green"' in stem, stem
    studio.click(popped_up(studio, "material-picker", "material-copy"))
    studio.wait()
    state = studio.state()
    assert state["selected"].endswith("green2") and state["steps"] == before["steps"] + 2, state
    run.picture("flower-material")
    studio.click(studio.middle("element-id"))
    studio.pointer("key", "ctrl+a")
    studio.pointer("type", "rind")
    studio.pointer("key", "Return")
    studio.wait()
    assert 'material="rind"' in studio.text(run.home) and studio.state()["problems"] == 0
    whole = studio.state()["digest"]
    studio.ask("do remove")
    assert studio.ask("said") == "Removed rind, which 1 place still uses", studio.ask("said")
    run.picture("flower-removed")
    studio.ask("do undo")
    assert studio.state()["digest"] == whole
    studio.ask("do set::rind.picture=no-such.png")
    studio.wait()
    assert studio.state()["problems"] == 1, "a picture that is not there is not missed"
    run.picture("flower-missing")
    for _ in range(4):
        studio.ask("do undo")
    studio.wait()
    assert studio.state()["digest"] == before["digest"]


def test_wind(run):
    """a wind is set, moves the picture and leaves the document alone"""
    studio = run.studio
    before = studio.state()
    studio.click(studio.middle("wind-menu"))
    time.sleep(0.4)
    studio.click(studio.middle("wind-strength", 0.6))
    run.picture("flower-wind")
    studio.pointer("key", "Escape")
    studio.ask("do wind-direction(90.0)")
    studio.ask("do wind-speed(2.0)")
    studio.wait()
    studio.ask("do wind(false)")
    studio.wait()
    state = studio.state()
    assert state["digest"] == before["digest"] and state["steps"] == before["steps"], state


def test_own_wind(run):
    """the wind that a plant is bent by is set by the wind's menu, each drag as a step"""
    studio = run.studio
    file = os.path.join(run.home, "bent.frond")
    with open(file, "w", encoding="utf-8") as out:
        out.write(BEGINNING.replace("</pgraph>", '</pgraph><nurbs wind="0, 0.2, 0"/>'))
    studio.ask(f"open {file}")
    studio.wait()
    before = studio.state()
    studio.click(studio.middle("wind-menu"))
    time.sleep(0.4)
    studio.drag(studio.middle("wind-strength", 0.2), studio.middle("wind-strength", 0.6))
    assert studio.state()["steps"] == 1, "one drag is one step"
    studio.drag(studio.middle("wind-direction", 0.1), studio.middle("wind-direction", 0.2))
    run.picture("bent-wind")
    state = studio.state()
    assert state["steps"] == 2 and state["problems"] == 0, state
    east, north = re.search('wind="([0-9.-]+), *([0-9.-]+), *0"', studio.text(run.home)).groups()
    assert float(east) > 0.1 and float(north) > 0.1, (east, north)
    studio.pointer("key", "Escape")
    studio.undo_all()
    assert studio.state()["digest"] == before["digest"]
    studio.ask("do wind(false)")
    studio.ask(f"open {run.file}")
    studio.wait()


def test_curve(run):
    """a curve is drawn by its points"""
    studio = run.studio
    studio.ask("do select::thick")
    studio.wait()
    before = studio.state()
    studio.drag(studio.middle("points-curve", 0.5, 0.45), studio.middle("points-curve", 0.55, 0.1))
    studio.wait()
    assert studio.state()["steps"] == before["steps"] + 1, studio.state()
    studio.click(studio.middle("points-curve", 0.3, 0.6))
    studio.wait()
    assert studio.state()["digest"] != before["digest"]
    run.picture("flower-curve")


def test_keys(run):
    """key frames are set by a button and a slider, dragged along the clock and removed"""
    studio = run.studio
    studio.ask("do select::stem")
    studio.wait()
    before = studio.state()
    studio.click(studio.middle("length-key"))
    studio.click(studio.middle("clock", 0.5))
    studio.wait()
    assert studio.state()["steps"] == before["steps"] + 1, studio.state()
    x, y, width, height = studio.where("length-scale")
    studio.drag([x + width * 0.4, y + height / 2], [x + width * 0.6, y + height / 2])
    studio.wait()
    assert studio.state()["steps"] == before["steps"] + 2, "a drag is one step"
    set_at = re.search('length="keys 0,[0-9.]+ ([0-9.]+),[0-9.]+"', studio.text(run.home))
    assert set_at is not None and 4.5 < float(set_at.group(1)) < 5.5, studio.text(run.home)
    now = studio.state()
    studio.drag(studio.middle("keys", 0.5), studio.middle("keys", 0.7), is_cancelled=True)
    is_left(studio, now)
    studio.drag(studio.middle("keys", 0.5), studio.middle("keys", 0.7))
    studio.click(studio.middle("The key before"))
    studio.click(studio.middle("The next key"))
    run.picture("flower-keys")
    moved_to = re.search('length="keys 0,[0-9.]+ ([0-9.]+),[0-9.]+"', studio.text(run.home))
    assert float(moved_to.group(1)) > float(set_at.group(1)) + 1, studio.text(run.home)
    assert studio.state()["steps"] == before["steps"] + 3, studio.state()
    studio.click(studio.middle("length-key"))  # it is at the key
    studio.wait()
    assert re.search('length="keys 0,[0-9.]+"', studio.text(run.home)), studio.text(run.home)
    for _ in range(4):
        studio.ask("do undo")
    studio.wait()
    assert studio.state()["digest"] == before["digest"]


def test_view(run):
    """the view turns, zooms and picks"""
    studio = run.studio
    studio.drag([600, 500], [760, 540])
    studio.go([640, 480])
    studio.pointer("click", "--repeat", 3, 4)
    studio.wait()
    run.picture("flower-turned")
    for mode in ("wireframe", "skeleton", "shaded"):
        studio.ask(f"do mode('{mode}')")
        run.picture("flower-" + mode)
    studio.ask("do frame")
    studio.wait()


def test_hand(run):
    """a leaf that is clicked can be pruned"""
    studio = run.studio
    studio.ask("do frame")
    studio.wait()
    before = studio.state()
    x, y, width, height = studio.where("viewport")
    for k in range(40):  # somewhere along the middle there is a leaf
        studio.click([x + width / 2 + 12, y + height * (0.1 + 0.02 * k)])
        if studio.state()["selected"].endswith("leaf:leaf"):
            break
    assert studio.state()["selected"].endswith("leaf:leaf"), studio.state()
    run.picture("flower-picked")
    studio.ask("do prune")
    studio.wait()
    after = studio.state()
    assert after["leaves"] == before["leaves"] - 1, after
    studio.ask("do undo")
    studio.wait()
    assert studio.state()["digest"] == before["digest"]


def test_lsystem(run):
    """an L-system is typed and stepped"""
    studio = run.studio
    weed = os.path.join(run.home, "weed.frond")
    with open(weed, "w", encoding="utf-8") as file:
        file.write(WEED)
    studio.ask(f"open {weed}")
    studio.wait()
    first = studio.state()
    run.picture("lsystem")
    x, y, _, _ = studio.where("string")
    studio.go([x + 68, y + 14])  # behind F(0.02) a bracket opens
    studio.wait()
    assert studio.ask("pointed") == "[+(25)F(0.02)] by F(x)", studio.ask("pointed")
    run.picture("lsystem-branch")
    studio.go(studio.point(0, 0, 0.3))
    studio.wait()
    assert studio.ask("pointed") == "F(0.02) by F(x)", studio.ask("pointed")
    run.picture("lsystem-pointed")
    studio.go(studio.middle("A step less"))
    studio.wait()
    assert studio.ask("pointed") == "nothing"
    studio.click(studio.middle("A step less"))
    studio.wait()
    fewer = studio.state()
    assert fewer["triangles"] < first["triangles"] and fewer["steps"] == 1, fewer
    x, y, width, height = studio.where("steps")
    studio.click([x + width - 48, y + height / 2])  # one less
    studio.wait()
    assert studio.state()["triangles"] < fewer["triangles"], studio.state()
    studio.click(studio.middle("frond-lsystem", 0.5, 0.3))
    studio.pointer("key", "ctrl+Home")
    studio.pointer("type", "/* a */")
    studio.wait()
    typed = studio.state()
    assert typed["digest"] != first["digest"] and typed["problems"] == 0, typed
    studio.pointer("type", "oops(")
    studio.wait()
    assert studio.state()["problems"] > 0
    run.picture("lsystem-mistake")
    studio.undo_all()
    studio.wait()
    assert studio.state()["digest"] == first["digest"]
    studio.ask(f"open {run.file}")
    studio.wait()


def test_light(run):
    """a lamp is dragged and another hung up, rays, cells and the field are shown, all is undone"""
    studio = run.studio
    file = os.path.join(run.home, "room.frond")
    with open(file, "w", encoding="utf-8") as out:
        out.write(ROOM)
    studio.ask(f"open {file}")
    studio.ask("do side('light')")
    studio.wait()
    before = studio.state()["digest"]
    bulb = studio.middle("at:0,0,0.9")
    studio.drag(bulb, (bulb[0] + 60, bulb[1] - 20))
    studio.wait()
    state = studio.state()
    assert state["steps"] == 1 and state["selected"].endswith("lamp:bulb"), state
    studio.pointer("key", "Delete")
    studio.wait()
    assert studio.state()["steps"] == 2
    studio.ask("do undo")
    studio.ask("do add-lamp::spot")
    for show in ("show-rays", "show-cells", "show-sun"):
        studio.ask("do " + show)
    studio.ask("do light-field::x")
    run.picture("light")
    studio.ask("do light-field::points")
    run.picture("light-points")
    for show in ("show-rays", "show-cells", "show-sun", "light-field::none"):
        studio.ask("do " + show)
    studio.ask("do undo")
    studio.ask("do undo")
    studio.wait()
    state = studio.state()
    assert state["digest"] == before and state["steps"] == 0, state


def test_lamps(run):
    """lamps of the document light the picture from where they hang"""
    studio = run.studio
    file = os.path.join(run.home, "bulbs.frond")
    with open(file, "w", encoding="utf-8") as out:
        out.write(BULBS)
    studio.ask("size 900 600")
    studio.ask(f"open {file}")
    run.picture("lamps")
    left, right = (studio.colour(studio.point(x, 0, 0.3)) for x in (-0.03, 0.03))
    assert left[0] > left[2] + 20, f"the left is not red: {left}"
    assert right[2] > right[0] + 20, f"the right is not blue: {right}"
    studio.ask("do set::red.power=0")
    studio.wait()
    assert max(studio.colour(studio.point(-0.03, 0, 0.3))) < max(left), "no lamp, and as bright"
    studio.ask("size 1440 900")


def test_patch(run):
    """control points of a Hyperpatch are dragged, mirrored and put back"""
    studio = run.studio
    file = os.path.join(run.home, "patch.frond")
    with open(file, "w", encoding="utf-8") as out:
        out.write(PATCH)
    studio.ask(f"open {file}")
    studio.ask("do select::patch")
    studio.wait()
    before = studio.state()
    corner = studio.point(0.2, -0.2, 0.6)
    studio.drag(corner, [corner[0] + 70, corner[1] - 50], is_cancelled=True)
    is_left(studio, before)
    studio.drag(corner, [corner[0] + 70, corner[1] - 50])
    studio.wait()
    run.picture("patch-dragged")
    state = studio.state()
    assert state["steps"] == 1 and state["problems"] == 0, state
    assert 'points="2,0,2:' in studio.text(run.home)
    studio.ask("do patch-reset")
    studio.wait()
    assert "points=" not in studio.text(run.home)
    studio.pointer("keydown", "ctrl")
    studio.drag(corner, [corner[0] + 60, corner[1] + 20])
    studio.pointer("keyup", "ctrl")
    studio.wait()
    assert 'points="0,0,2:' in studio.text(run.home) and " 2,0,2:" in studio.text(run.home)
    run.picture("patch-mirrored")
    studio.undo_all()
    studio.wait()
    assert studio.state()["digest"] == before["digest"]


def sketched(run):
    return json.loads(run.studio.ask("sketch"))


def test_sketch(run):
    """branches are chosen and drawn in depth, and what comes of it stands in the scene"""
    studio = run.studio
    shutil.copy(SOURCE / "examples" / "strokes.frond", run.home)
    studio.ask(f"open {os.path.join(run.home, 'strokes.frond')}")
    studio.wait()
    first = studio.state()
    studio.ask("do sketch")
    studio.wait()
    assert sketched(run)["varied"] == "wave", sketched(run)
    x, y, width, height = studio.where("sketch-skeleton")
    for k in range(30):  # somewhere near the middle of its foot the stem stands
        studio.drag([x + width * (0.35 + 0.01 * k), y + height * 0.88],
                    [x + width * (0.35 + 0.01 * k), y + height * 0.8], steps=2)
        if sketched(run)["selected"] > 0:
            break
    assert sketched(run)["selected"] == 1, sketched(run)
    before = sketched(run)
    studio.go(studio.middle("sketch-board", 0.5, 0.9))
    studio.pointer("mousedown", 1)
    for step in range(1, 13):
        studio.go(studio.middle("sketch-board", 0.5 + 0.03 * step, 0.9 - 0.06 * step))
        studio.pointer("click", 5)  # the wheel: farther away
    run.picture("sketch-drawing")
    studio.pointer("mouseup", 1)
    studio.wait()
    after = sketched(run)
    assert after["height"] < before["height"], "the wheel does not move the board"
    assert studio.state()["steps"] == 1, studio.state()
    studio.ask("do sketch-clear")
    studio.ask("do sketch-pen('wind')")
    studio.drag(studio.middle("sketch-board", 0.2, 0.5), studio.middle("sketch-board", 0.8, 0.5))
    studio.wait()
    assert studio.state()["steps"] == 2, studio.state()
    studio.ask("do sketch-play")
    studio.ask("do sketch-page('sheet')")
    studio.wait()
    assert sketched(run)["instances"] == 7, sketched(run)
    run.picture("sketch-sheet")
    studio.ask("do sketch-whole")
    run.picture("sketch-whole")
    studio.ask("do sketch-whole")
    studio.ask("do sketch-page('strokes')")
    studio.ask("do sketch-place")
    studio.ask("do sketch")
    studio.wait()
    state = studio.state()
    assert state["problems"] == 0 and state["triangles"] > first["triangles"], state
    studio.undo_all()
    studio.wait()
    assert studio.state()["digest"] == first["digest"]
    studio.ask(f"open {run.file}")
    studio.wait()


def test_device(run):
    """a device draws by lines of text, and keys choose and draw as the pointer does, in little room"""
    studio = run.studio
    studio.ask("size 1024 768")
    studio.ask(f"open {os.path.join(run.home, 'strokes.frond')}")
    studio.wait()
    studio.ask("do sketch")
    studio.wait()
    left, _, width, height = studio.where("sketch-skeleton")
    assert left + width <= 1024 and width > 200 and height > 300, (left, width, height)
    run.picture("sketch-small")
    studio.click(studio.middle("sketch-skeleton", 0.15, 0.06))
    studio.pointer("key", "Home")
    studio.wait()
    assert sketched(run)["selected"] == 1, sketched(run)
    lines = os.path.join(run.home, "lines.txt")
    with open(lines, "w", encoding="utf-8") as file:
        file.write("height 0 0\ndown\n")
        for step in range(20):
            file.write(f"move {0.02 * step} {0.1 * step} 1 {0.05 * step}\nheight {0.01 * step} {0.05 * step}\n")
        file.write("up\n")
    studio.ask(f"do sketch-listen('{lines}')")
    for _ in range(50):
        studio.wait()
        if studio.state()["steps"] > 0:
            break
    assert studio.state()["steps"] == 1, studio.state()
    studio.click(studio.middle("sketch-board", 0.5, 0.5))
    for key in ("space", "Up", "Up", "Right", "Page_Up", "Up", "space"):
        studio.pointer("key", key)
    studio.wait()
    assert studio.state()["steps"] == 2, studio.state()
    studio.ask("do sketch")
    studio.ask("size 1440 900")
    studio.undo_all()
    studio.ask(f"open {run.file}")
    studio.wait()


def test_mistake(run):
    """a mistake is shown at its place and the last good plant stays"""
    studio = run.studio
    triangles = studio.state()["triangles"]
    studio.ask("do set::stem.length=0.5 +")
    studio.wait()
    state = studio.state()
    assert state["problems"] == 1 and state["triangles"] == triangles, state
    studio.ask("do problem")
    run.picture("flower-mistake")
    assert studio.state()["selected"].endswith("horn:stem"), studio.state()
    studio.ask("do undo")
    studio.wait()
    assert studio.state()["problems"] == 0


def test_undo(run):
    """undoing all leads back to the first byte"""
    studio = run.studio
    last = studio.state()
    studio.undo_all()
    studio.wait()
    state = studio.state()
    assert state["digest"] == run.first and state["saved"], state
    for _ in range(last["steps"]):
        studio.ask("do redo")
    studio.wait()
    assert studio.state()["digest"] == last["digest"]


def test_save(run):
    """what is saved is what is opened again"""
    studio = run.studio
    digest = studio.state()["digest"]
    copy = os.path.join(run.home, "copy.frond")
    studio.ask(f"do save-to('{copy}')")
    assert studio.state()["saved"]
    studio.ask(f"open {copy}")
    studio.wait()
    state = studio.state()
    assert state["digest"] == digest and state["steps"] == 0, state


def test_export(run):
    """a model is written for another program"""
    model = os.path.join(run.home, "flower.glb")
    run.studio.ask(f"do export-to('{model}')")
    run.studio.wait()
    with open(model, "rb") as file:
        assert file.read(4) == b"glTF"


def glb_nodes(path):
    """Of each node of a model: how many vertices its parts have and where they end; where it stands."""
    with open(path, "rb") as file:
        content = file.read()
    scene = json.loads(content[20:20 + int.from_bytes(content[12:16], "little")])
    parts = [[scene["accessors"][part["attributes"]["POSITION"]] for part in mesh["primitives"]]
             for mesh in scene["meshes"]]
    return [([(part["count"], part["max"]) for part in parts[node["mesh"]]], node.get("translation"))
            for node in scene["nodes"]]


def test_export_one(run):
    """one plant of a grown scene is a model of its own, at the step that is seen"""
    open_grove(run)
    studio = run.studio
    studio.ask("do scene-tool::plant")
    for place in ((1.5, -0.5, 0), (-1.5, 0, 0)):
        studio.click(studio.point(*place))
        studio.wait()
    for _ in range(6):
        studio.click(studio.middle("A step"))
        studio.wait()
    studio.ask("do scene-tool::select")
    studio.ask("do select::")
    studio.wait()
    model = os.path.join(run.home, "one.glb")
    studio.ask(f"do export-one-to('{model}')")
    assert studio.ask("said").startswith("Click a plant first"), studio.ask("said")
    assert not os.path.exists(model)
    studio.ask("do scene-tool::move")
    studio.click(studio.point(1.5, -0.5, 0))
    studio.wait()
    run.picture("export-one")
    studio.ask(f"do export-one-to('{model}')")
    whole = os.path.join(run.home, "whole.glb")
    studio.ask(f"do export-to('{whole}')")
    studio.wait()
    all_plants, one = glb_nodes(whole), glb_nodes(model)
    assert len(all_plants) == 3 and len(one) == 1, (all_plants, one)
    assert one[0][1] is None and all_plants[1] == (one[0][0], [1.5, 0, 0.5]), (all_plants, one)
    assert max(top[1] for _, top in one[0][0]) > 0.2, "it has grown"
    studio.click(studio.middle("export-one"))
    studio.wait()
    studio.ask(f"picture-of-dialog {PICTURES / 'export-one-dialog'}.png")
    studio.ask("close-dialog")
    studio.ask("do scene-tool::select")


def test_dialogs(run):
    """every dialog opens and closes"""
    for action in ("export", "preferences", "shortcuts", "about"):
        run.studio.ask("do " + action)
        run.studio.wait()
        run.studio.ask(f"picture-of-dialog {PICTURES / action}.png")
        run.studio.ask("close-dialog")


def test_killed(run):
    """what was not saved is offered again after a crash"""
    studio = run.studio
    studio.ask("do set::stem.length=0.77")
    studio.ask("keep")
    studio.kill()
    run.studio = driver.Studio(run.display, run.home)
    run.picture("recovery")
    run.studio.ask("restore")
    run.studio.wait()
    state = run.studio.state()
    assert not state["saved"], state
    run.studio.ask("do undo")
    assert run.studio.state()["steps"] == 0
    assert run.studio.quit() == 0



TESTS = [test_welcome, test_repeat, test_examples, test_broken, test_lsystem, test_grove, test_levels, test_arrange, test_rows, test_export_one,
         test_light, test_lamps, test_patch, test_own_wind, test_sketch,
         test_device, test_flower, test_link, test_escape, test_preset, test_slider, test_material, test_keys, test_wind, test_curve, test_view, test_hand,
         test_mistake, test_undo, test_save, test_export, test_dialogs, test_killed]


def main():
    reason = driver.why_not()
    if reason is not None:
        print(f"1..0 # SKIP {reason}")
        return
    # A word leaves out the tests that have it in their names.
    tests = [test for test in TESTS if not any(word in test.__name__ for word in sys.argv[1:])]
    driver.run_tests(tests, Run())


if __name__ == "__main__":
    main()
