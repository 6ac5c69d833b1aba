"""The studio on screens of other kinds: with twice as many pixels across, small, with large letters."""

import os
import shutil

import studio_driver as driver
from driven_run import Home, SOURCE

POLES = """<frond version="1">
  <curve id="thick" points="0,1 0.5,0.6 1,0.2"/>
  <plant id="p"><pgraph>
    <camera id="root"/>
    <horn id="pole" length="1" radius="0.05" profile="thick"/>
    <link from="root" to="pole"/>
  </pgraph></plant>
  <scene><place plant="p" at="0, 0, 0"/><place plant="p" at="1, 0, 0"/></scene>
</frond>
"""


class Run(Home):
    def __init__(self):
        super().__init__()
        self.file = self.write("poles.frond", POLES)
        self.display = None

    def on(self, width, height, dense=1):
        """A display of that size, with a studio that fills it."""
        self.close_display()
        self.display = driver.Display(dense * width, dense * height)
        self.studio = driver.Studio(self.display, self.home, variables={"GDK_SCALE": str(dense)})
        self.studio.ask(f"size {width} {height}")
        return self.studio

    def open_at(self, file, selected):
        self.open(file)
        self.studio.ask("do select::" + selected)
        self.studio.wait()

    def close_display(self):
        if self.studio is not None:
            self.studio.kill()
            self.display.close()

    def close(self):
        self.close_display()
        super().close()


def test_pick(run):
    """with two pixels for one, what is clicked is what is seen"""
    studio = run.on(1440, 900, dense=2)
    run.open_at(run.file, "root")
    studio.click(studio.point(1, 0, 0.5))
    studio.wait()
    assert studio.state()["selected"].endswith("horn:pole"), studio.state()
    run.picture("dense")
    studio.click(studio.point(0.5, 0, 0.5))
    studio.wait()
    assert studio.state()["selected"] == "", studio.state()
    studio.click(studio.middle("box:root"))
    studio.wait()
    assert studio.state()["selected"].endswith("camera:root"), studio.state()


def test_handles(run):
    """and handles are where they are drawn"""
    studio = run.studio
    studio.click(studio.middle("tool-move"))
    studio.click(studio.point(1, 0, 0))
    studio.wait()
    assert studio.state()["selected"].endswith("place#1"), studio.state()
    foot, goal = studio.point(1, 0, 0), studio.point(1, -1, 0)
    studio.drag(foot, goal)
    studio.wait()
    at = studio.text(run.home).split('<place plant="p" at="')[2].split('"')[0]
    x, y, z = [float(number) for number in at.split(",")]
    assert abs(x - 1) < 0.05 and abs(y + 1) < 0.05 and z == 0, at
    studio.undo_all()
    studio.ask("do select::thick")
    studio.wait()
    studio.drag(studio.middle("points-curve", 0.5, 0.45), studio.middle("points-curve", 0.5, 0.1))
    studio.wait()
    points = studio.text(run.home).split('<curve id="thick" points="')[1].split('"')[0].split()
    x, y = [float(number) for number in points[1].split(",")]
    assert len(points) == 3 and abs(x - 0.5) < 0.02 and y > 0.9, points


def test_stroke(run):
    """and a stroke is drawn under the pointer"""
    studio = run.studio
    shutil.copy(SOURCE / "examples" / "strokes.frond", run.home)
    run.open_at(os.path.join(run.home, "strokes.frond"), "stem")
    studio.ask("do sketch")
    studio.wait()
    studio.click(studio.middle("sketch-skeleton", 0.15, 0.06))
    studio.pointer("key", "Home")
    studio.drag(studio.middle("sketch-board", 0.3, 0.9), studio.middle("sketch-board", 0.7, 0.4))
    studio.wait()
    run.picture("dense-sketch")
    assert studio.state()["steps"] == 1, studio.state()


def fits(run, width, height):
    """Whether the window stays on its display."""
    _, _, *size = run.studio.where("window")
    assert size[0] <= width and size[1] <= height, (size, width, height)


def test_small(run):
    """a window of 1280 by 720 shows every mode whole"""
    studio = run.on(1280, 720)
    fits(run, 1280, 720)
    run.open_at(SOURCE / "examples" / "sunflower.frond", "petal")
    fits(run, 1280, 720)
    run.picture("small")
    studio.ask("do scene-tool('paint')")
    run.picture("small-paint")
    fits(run, 1280, 720)
    run.open_at(os.path.join(run.home, "strokes.frond"), "stem")
    studio.ask("do sketch")
    run.picture("small-sketch")
    fits(run, 1280, 720)


def is_shown(run, pane):
    """Whether a pane is unfolded."""
    try:
        return run.studio.where(pane + "-pane")[2] > 0
    except AssertionError:
        return False


def test_netbook(run):
    """a window of 1024 by 600 has room for picture, graph and inspector, and for every mode"""
    studio = run.on(1024, 600)
    run.picture("netbook-welcome")
    fits(run, 1024, 600)
    run.open_at(SOURCE / "examples" / "sunflower.frond", "petal")
    assert is_shown(run, "side") and is_shown(run, "inspector")
    for name, do in {"petal": "select::petal", "paint": "scene-tool('paint')",
                     "light": "side('light')", "text": "side('text')",
                     "sketch": "sketch"}.items():
        studio.ask("do " + do)
        run.picture("netbook-" + name)
        fits(run, 1024, 600)
        assert int(studio.ask("needs window").split()[0]) <= 1000, name
    studio.ask("do sketch")
    run.open_at(SOURCE / "examples" / "lsystems" / "bush.l", "")
    run.picture("netbook-lsystem")
    fits(run, 1024, 600)


def test_fold(run):
    """panes fold by key and by button, and what was folded comes back as wide as it was"""
    studio = run.on(1400, 800)
    run.open_at(SOURCE / "examples" / "sunflower.frond", "petal")
    before = {pane: studio.where(pane + "-pane") for pane in ("side", "inspector", "picture")}
    studio.pointer("key", "F9")
    studio.wait()
    assert not is_shown(run, "side") and is_shown(run, "inspector")
    studio.click(studio.middle("win.show-inspector"))
    studio.wait()
    assert not is_shown(run, "inspector")
    assert studio.where("picture-pane")[2] == studio.where("window")[2]
    run.picture("folded")
    studio.pointer("key", "shift+F9")
    studio.click(studio.middle("win.show-panel"))
    studio.wait()
    after = {pane: studio.where(pane + "-pane") for pane in before}
    assert after == before, (before, after)
    studio.pointer("key", "F9")
    studio.pointer("key", "alt+3")  # a page of it unfolds it
    studio.wait()
    assert is_shown(run, "side")


def test_narrow(run):
    """where one pane alone has room, it is the one that was asked for last"""
    studio = run.on(800, 600)
    run.open_at(SOURCE / "examples" / "sunflower.frond", "petal")
    assert is_shown(run, "side") and not is_shown(run, "inspector")
    run.picture("narrow-panel")
    studio.pointer("key", "shift+F9")
    studio.wait()
    assert is_shown(run, "inspector") and not is_shown(run, "side")
    run.picture("narrow-inspector")
    studio.click(studio.middle("win.show-panel"))
    studio.wait()
    assert is_shown(run, "side") and not is_shown(run, "inspector")
    studio.click(studio.middle("modes"))
    studio.pointer("key", "Down", "Down", "Return")
    studio.wait()
    run.picture("narrow-wireframe")
    fits(run, 800, 600)


def test_letters(run):
    """letters half as large again have room, in the graph, too"""
    studio = run.on(1600, 1000)
    run.open_at(SOURCE / "examples" / "sunflower.frond", "petal")
    before = studio.where("box:root")
    studio.ask("letters 1.5")
    studio.wait()
    fits(run, 1600, 1000)
    assert studio.where("box:root")[3] > before[3], "the boxes of the graph stay small"
    run.picture("large-letters")
    assert studio.where("element-id")[3] > 30


TESTS = [test_pick, test_handles, test_stroke, test_small, test_netbook, test_fold, test_narrow,
         test_letters]


if __name__ == "__main__":
    driver.main(TESTS, Run, driver.why_not())
