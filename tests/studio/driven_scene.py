"""Scenes with a person's hands: planting, growing, moving, rows, lamps, one plant as a model."""

import json
import math
import os
import re

from driven_run import PICTURES, is_left


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


def open_grove(run):
    studio = run.studio
    studio.ask("size 1440 900")
    run.open_text("grove.frond", GROVE)
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
    run.open_text("rows.frond", ROWS)
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
    at = re.search(r'<place plant="tree" at="(\S+), (\S+), 0"', studio.text(run.home))
    moved = (float(at[1]), float(at[2]), 0)
    assert math.dist(moved, (2.5, -1.5, 0)) < 0.1, moved
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
    studio.click(studio.point(moved[0], moved[1], 0.8))
    studio.wait()
    for key, end in (("alt", (4, -2, 0)), ("shift", (6, -3, 0))):
        begin = moved if key == "alt" else (4, -2, 0)
        studio.pointer("keydown", key)
        studio.drag(studio.point(*begin), studio.point(*end))
        studio.pointer("keyup", key)
        studio.wait()
    text = studio.text(run.home)
    assert at[0] in text and text.count("<place") == 2, text
    copy = re.search(r'at="(\S+), (\S+), 0" seed=', text.replace(at[0], ""))
    assert float(copy[1]) > 5 and abs(float(copy[2]) + 2) < 0.1, "not along one axis: " + text
    assert studio.state()["steps"] == 6, studio.state()
    with run.messages_stay():
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


def test_light(run):
    """a lamp is dragged and another hung up, rays, cells and the field are shown, all is undone"""
    studio = run.studio
    run.open_text("room.frond", ROOM)
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
    studio.ask("size 900 600")
    run.open_text("bulbs.frond", BULBS)
    run.picture("lamps")
    left, right = (studio.colour(studio.point(x, 0, 0.3)) for x in (-0.03, 0.03))
    assert left[0] > left[2] + 20, f"the left is not red: {left}"
    assert right[2] > right[0] + 20, f"the right is not blue: {right}"
    studio.ask("do set::red.power=0")
    studio.wait()
    assert max(studio.colour(studio.point(-0.03, 0, 0.3))) < max(left), "no lamp, and as bright"
    studio.ask("size 1440 900")


def glb_nodes(path):
    """Of each node of a model: how many vertices its parts have and where they end; where it stands."""
    with open(path, "rb") as file:
        content = file.read()
    scene = json.loads(content[20:20 + int.from_bytes(content[12:16], "little")])
    parts = [[scene["accessors"][part["attributes"]["POSITION"]] for part in mesh["primitives"]]
             for mesh in scene["meshes"]]
    return [([(part["count"], part["max"]) for part in parts[node["mesh"]]], node.get("translation"))
            for node in scene["nodes"]]


def test_export_changed(run):
    """a model has what grew before and after a change between two steps, as it is seen"""
    wall = '<obstacle id="wall" at="{}, 0, 0" size="0.1, 2, 3"/></scene>'
    studio = run.studio
    studio.ask("size 1440 900")
    run.open_text("walled.frond", GROVE.replace("</scene>", wall.format(5)))

    def grow(steps):
        for _ in range(steps):
            studio.click(studio.middle("A step"))
            studio.wait()

    def export(name):
        model = os.path.join(run.home, name)
        with run.messages_stay():
            studio.ask(f"do export-to('{model}')")
            studio.wait()
            assert studio.ask("said").startswith("Wrote"), studio.ask("said")
        return glb_nodes(model)

    studio.ask("turn 0 20 4")
    studio.wait()
    grow(4)
    studio.ask("do set::wall.at=0.15, 0, 0")
    grow(3)
    run.picture("export-changed")
    assert studio.state()["problems"] == 0, studio.state()
    changed = export("changed.glb")
    assert export("again.glb") == changed
    # The same document grown from the beginning is another plant.
    run.open_text("anew.frond", studio.text(run.home).replace('steps="0"', 'steps="7"'))
    run.picture("export-anew")
    assert export("anew.glb") != changed, changed


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
    with run.messages_stay():
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
    assert one[0][1] is None and all_plants[1][0] == one[0][0], (all_plants, one)
    assert math.dist(all_plants[1][1], (1.5, 0, 0.5)) < 0.1, all_plants[1][1]
    assert max(top[1] for _, top in one[0][0]) > 0.2, "it has grown"
    studio.click(studio.middle("export-one"))
    studio.wait()
    studio.ask(f"picture-of-dialog {PICTURES / 'export-one-dialog'}.png")
    studio.ask("close-dialog")
    studio.ask("do scene-tool::select")
