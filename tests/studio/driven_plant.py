"""Plants with a person's hands: components, links, presets, numbers, materials, L-systems."""

import os
import re
import shutil

from driven_run import BEGINNING, PICTURES, SOURCE, is_left


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


def open_flower(run):
    run.studio.ask("size 1440 900")
    run.open(run.file)
    run.first = run.studio.state()["digest"]


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
    with run.messages_stay():
        for name, why in (("leaf", "called leaf"), ("9x", "A name is")):
            studio.click(studio.middle("element-id"))
            studio.pointer("key", "ctrl+a")
            studio.pointer("type", name)
            studio.pointer("key", "Return")
            studio.wait()
            assert why in studio.ask("said"), studio.ask("said")
            run.picture("flower-name")
    assert studio.state()["digest"] == before["digest"]


def test_elsewhere(run):
    """a component that is dropped outside the graph is none"""
    studio = run.studio
    before = studio.state()
    for tool in ("leaf", "preset"):
        studio.drag(studio.middle("tool:" + tool), studio.middle("viewport"), steps=4)
        is_left(studio, before)
    assert studio.ask("dialog") == "nothing"


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
    run.look("dialog", lambda answer: os.path.exists(kept + ".png"))  # it is drawn meanwhile
    studio.ask("hear")
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


DRESSED = """<frond version="1">
  <material id="painted" picture="pictures/bark.png"/>
  <plant id="post"><pgraph>
    <horn id="pole" material="painted" length="1" radius="0.2"/>
  </pgraph></plant>
</frond>
"""


def test_preset_files(run):
    """a part with a picture is kept with it, and brings it to another document"""
    studio = run.studio
    here, there = (os.path.join(run.home, name) for name in ("here", "there"))
    for folder in (os.path.join(here, "pictures"), there):
        os.makedirs(folder, exist_ok=True)
    shutil.copy(SOURCE / "data" / "presets" / "oak.png", os.path.join(here, "pictures", "bark.png"))
    run.open(run.write("here/post.frond", DRESSED))
    studio.ask("do select::pole")
    with run.messages_stay():
        studio.ask("do save-preset-as::a post")
        assert studio.ask("said") == "Kept as the preset a post", studio.ask("said")
    shutil.rmtree(here)
    run.open(run.write("there/plain.frond", DRESSED.replace("picture", "colour").replace(
        "colours/bark.png", "#884422")))
    studio.ask("do select::pole")
    studio.ask("do insert-preset-named::a post")
    studio.wait()
    assert studio.state()["problems"] == 0, studio.state()
    assert os.path.exists(os.path.join(there, "bark.png"))
    text = studio.text(run.home)
    assert 'picture="bark.png"' in text and 'to="pole2"' in text, text
    run.picture("preset-files")
    studio.ask("do undo")
    studio.wait()


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


def test_material(run):
    """a material is chosen by its look, copied, named, and given a picture that is missed"""
    studio = run.studio
    before = studio.state()
    studio.ask("do select::stem")
    studio.wait()
    run.opens("material-picker", "material:green")
    run.click("material:green")
    studio.wait()
    stem = studio.text(run.home).split('id="stem"')[1].split("/>")[0]
    assert 'material="green"' in stem, stem
    run.opens("material-picker", "material-copy")
    run.click("material-copy")
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
    with run.messages_stay():
        studio.ask("do remove")
        assert studio.ask("said") == "Removed rind, which stem still uses", studio.ask("said")
        run.appears("AdwToastWidget")
        _, y, _, height = studio.where("AdwToastWidget")
        assert y + height <= studio.where("clock")[1], "what is said leaves the strip for time free"
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
    run.opens("wind-menu", "wind-strength")
    run.appears("wind-strength")
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
    run.open_text("bent.frond", BEGINNING.replace("</pgraph>", '</pgraph><nurbs wind="0, 0.2, 0"/>'))
    before = studio.state()
    run.opens("wind-menu", "wind-strength")
    run.appears("wind-strength")
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
    run.open(run.file)


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
    run.open_text("weed.frond", WEED)
    first = studio.state()
    run.picture("lsystem")
    x, y, width, _ = studio.where("string")
    for across in range(0, int(width), 4):  # behind F(0.02) a bracket opens
        studio.go([x + across, y + 14])
        if studio.ask("pointed").startswith("["):
            break
    assert studio.ask("pointed") == "[+(25)F(0.02)] by F(x)", studio.ask("pointed")
    run.picture("lsystem-branch")
    studio.go(studio.point(0, 0, 0.3))
    run.look("pointed", lambda answer: answer == "F(0.02) by F(x)")
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
    run.open(run.file)


def test_patch(run):
    """control points of a Hyperpatch are dragged, mirrored and put back"""
    studio = run.studio
    run.open_text("patch.frond", PATCH)
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
