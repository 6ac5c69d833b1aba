"""The studio's windows and dialogs, gone through by pointer and by keys."""

import json
import math
import os
import re
import shutil
import struct

import studio_driver as driver
from driven_run import BEGINNING, Home, PICTURES, SOURCE

class Run(Home):
    """A studio on a display of its own."""

    def __init__(self):
        super().__init__()
        self.display = driver.Display(1400, 900)
        self.start()
        self.file = self.write("flower.frond", BEGINNING)

    def start(self):
        self.studio = driver.Studio(self.display, self.home)
        self.studio.ask("size 1400 900")
        self.studio.ask("stay")  # else a busy machine would not read them in time

    def settings(self):
        """What the studio has kept; it writes that when a window goes."""
        with open(os.path.join(self.home, "config", "frond", "studio.ini"), encoding="utf-8") as file:
            lines = [line.strip().split("=", 1) for line in file if "=" in line]
        return dict(lines)

    def keys(self, *names):
        self.studio.pointer("key", *names)

    def fill(self, name, text):
        """Types a text over what is in an entry."""
        self.click(name)
        self.keys("ctrl+a", "Delete")
        self.studio.pointer("type", text)

    def dialog(self, name):
        self.look("dialog", lambda answer: answer == name)
        self.studio.ask("hear")

    def no_dialog(self):
        self.look("dialog", lambda answer: answer == "nothing")

    def picture_of_dialog(self, name):
        self.studio.ask(f"picture-of-dialog {PICTURES / name}.png")

    def close(self):
        self.studio.kill()
        self.display.close()
        super().close()


def test_views(run):
    """views are saved, gone to, renamed and removed, and are part of the document"""
    studio = run.studio
    run.open(run.file)
    studio.ask("do frame-all")
    studio.wait()
    first, before = studio.point(0, 0, 0.5), studio.state()
    run.opens("views", "new-view")
    run.fill("new-view", "front")
    run.keys("Return")
    studio.wait()
    run.look("said", lambda answer: answer == "Saved the view front")
    assert '<view name="front"' in studio.text(run.home) and studio.state()["steps"] == 1
    studio.ask("turn 50 30 2.5")
    studio.wait()
    turned = studio.point(0, 0, 0.5)
    assert turned != first
    run.opens("views", "new-view")
    run.click("Save View")  # under the name that is proposed
    studio.wait()
    run.opens("views", "new-view")
    run.click("view:front")
    studio.wait()
    assert max(abs(a - b) for a, b in zip(studio.point(0, 0, 0.5), first)) <= 1
    run.opens("views", "new-view")
    run.click("view:view 1")
    studio.wait()
    assert max(abs(a - b) for a, b in zip(studio.point(0, 0, 0.5), turned)) <= 1
    run.opens("views", "new-view")
    run.click("rename-view:view 1")
    run.keys("ctrl+a")
    studio.pointer("type", "front")
    run.keys("Return")
    assert studio.ask("said") == "Another view is called front", studio.ask("said")
    run.keys("ctrl+a")
    studio.pointer("type", "side & back")
    run.keys("Return")
    studio.wait()
    text = studio.text(run.home)
    assert 'name="side &amp; back"' in text and 'name="view 1"' not in text, text
    run.opens("views", "new-view")
    run.click("remove-view:front")
    studio.wait()
    assert studio.ask("said") == "Removed front" and 'name="front"' not in studio.text(run.home)
    run.picture("views")
    run.click("Undo")
    studio.wait()
    assert studio.text(run.home) == text
    studio.undo_all()
    assert studio.state()["digest"] == before["digest"]


def test_views_by_keys(run):
    """and all that by keys alone"""
    studio = run.studio
    run.open(run.file)
    run.opens("views", "new-view")
    run.keys("Tab")
    studio.pointer("type", "a")
    run.keys("Return")
    studio.wait()
    assert '<view name="a"' in studio.text(run.home), studio.text(run.home)
    run.opens("views", "new-view")
    run.appears("view:a")
    run.keys("Tab", "space")  # the pen
    run.appears("name-of-view:a")
    studio.pointer("type", "b")
    run.keys("Escape")
    assert studio.ask("focus").endswith("view:a"), studio.ask("focus")
    run.keys("Tab", "space")
    run.appears("name-of-view:a")
    run.keys("ctrl+a")
    studio.pointer("type", "b")
    run.keys("Return")
    studio.wait()
    assert '<view name="b"' in studio.text(run.home), studio.text(run.home)
    run.opens("views", "new-view")
    run.appears("view:b")
    run.keys("Tab", "Tab", "space")
    studio.wait()
    assert "<view" not in studio.text(run.home)
    run.keys("ctrl+z")
    assert '<view name="b"' in studio.text(run.home)
    studio.undo_all()


def test_removed(run):
    """what is removed though it is needed says by whom, and comes back by a click"""
    studio = run.studio
    run.open_text("used.frond", BEGINNING.replace('length="0.6"', 'length="0.6" profile="thick"')
                  .replace("</pgraph>", '<leaf id="blade"/><link from="stem" to="blade"/></pgraph>'))
    before = studio.state()["digest"]
    for name, words in {"thick": "Removed thick, which stem still uses",
                        "green": "Removed green",
                        "stem": "Removed stem; nothing leads to blade now",
                        "flower": "Removed flower"}.items():
        studio.ask(f"do select::{name}")
        studio.go(studio.point(0, 0, 0.3))
        studio.ask("do remove")
        studio.wait()
        assert studio.ask("said") == words, studio.ask("said")
        run.picture("removed-" + name)
        run.click("Undo")
        studio.wait()
        state = studio.state()
        assert state["digest"] == before and state["problems"] == 0, state
    assert studio.state()["steps"] == 0


def test_rename_preset(run):
    """a preset of one's own is renamed and removed by dialogs, which refuse what cannot be"""
    studio = run.studio
    folder = os.path.join(run.home, "data", "frond", "presets")
    studio.ask(f"open {SOURCE / 'examples' / 'sunflower.frond'}")
    studio.wait()
    for part in ("petal", "sepal"):
        studio.ask(f"do select::{part}")
        studio.ask(f"do save-preset-as::my {part}")
    studio.ask("do insert-preset")
    run.dialog("Insert a Preset")
    studio.ask("close-dialog")
    run.no_dialog()
    studio.ask("do rename-preset::my petal")
    run.dialog("Rename the Preset")
    run.fill("preset-name", "my sepal")
    assert studio.ask("text preset-note") == "Another preset is called so"
    run.keys("Return")
    assert studio.ask("dialog") == "Rename the Preset", "a name that is taken was accepted"
    run.fill("preset-name", "oak")
    assert "comes with the program" in studio.ask("text preset-note")
    run.fill("preset-name", "a/b")
    assert studio.ask("text preset-note") == "A name has no slashes"
    run.picture_of_dialog("preset-rename")
    run.fill("preset-name", "ray")
    assert studio.ask("text preset-note") == "nothing"
    run.keys("Escape")
    run.no_dialog()
    assert sorted(name for name in os.listdir(folder) if name.endswith(".frond")) == \
        ["my petal.frond", "my sepal.frond"]
    studio.ask("do rename-preset::my petal")
    run.dialog("Rename the Preset")
    run.fill("preset-name", "ray")
    run.click("Rename")
    run.no_dialog()
    assert os.path.exists(os.path.join(folder, "ray.frond"))
    assert not os.path.exists(os.path.join(folder, "my petal.frond"))
    studio.ask("do remove-preset::ray")
    run.dialog("Remove the Preset ray?")
    run.picture_of_dialog("preset-remove")
    run.keys("Return")  # what is proposed is to leave it
    run.no_dialog()
    assert os.path.exists(os.path.join(folder, "ray.frond"))
    studio.ask("do remove-preset::ray")
    run.dialog("Remove the Preset ray?")
    run.click("Remove")
    run.no_dialog()
    assert not os.path.exists(os.path.join(folder, "ray.frond"))


def test_broken_preset(run):
    """a preset that has become wrong is told with its line, and is not put in"""
    studio = run.studio
    folder = os.path.join(run.home, "data", "frond", "presets")
    with open(os.path.join(folder, "torn.frond"), "w", encoding="utf-8") as file:
        file.write('<frond version="1">\n  <plant id="p" sede="1"/>\n</frond>\n')
    before = studio.state()["digest"]
    studio.ask("do insert-preset-named::torn")
    assert "torn is not put in: line 2: " in studio.ask("said"), studio.ask("said")
    assert studio.state()["digest"] == before
    studio.ask("do insert-preset")
    run.dialog("Insert a Preset")
    run.appears("broken")
    run.picture_of_dialog("preset-broken")
    studio.ask("close-dialog")
    run.no_dialog()


def test_recent(run):
    """a new window offers the documents opened last, and opens one that is clicked"""
    studio = run.studio
    run.open(run.file)
    run.keys("ctrl+n")
    run.look("windows", lambda answer: answer == "1 2")
    studio.ask("window 2")
    run.look("text window", lambda answer: answer == "Frond Studio")
    run.appears("flower.frond")
    run.picture("recent")
    run.click("flower.frond")
    run.look("text window", lambda answer: answer == "flower.frond")
    studio.wait()
    run.look("state", lambda answer: json.loads(answer)["triangles"] > 0)
    run.keys("ctrl+n")
    run.look("windows", lambda answer: answer == "1 2 3")
    studio.ask("window 3")
    run.click("agave")  # a preset: a document without a file
    run.look("text window", lambda answer: answer == "agave")
    studio.wait()
    assert studio.state()["problems"] == 0, studio.state()
    run.keys("ctrl+w")  # nothing of it was changed
    run.look("windows", lambda answer: answer == "1 2")
    studio.ask("window 2")
    run.keys("ctrl+w")
    run.look("windows", lambda answer: answer == "1")
    studio.ask("window 1")


def test_preferences(run):
    """preferences are set by pointer and keys, act at once, and are kept"""
    studio = run.studio
    run.open(run.file)
    run.keys("ctrl+comma")
    run.dialog("Preferences")
    assert studio.ask("text budget") == "250000"
    run.click("Grid")
    run.click("Shadows")
    run.fill("budget", "0")
    run.keys("Tab")
    run.picture_of_dialog("preferences-set")
    run.click("Dark")
    studio.wait()
    run.picture("preferences-light")
    run.click("Dark")
    run.keys("Escape")
    run.no_dialog()
    assert run.studio.quit() == 0
    kept = run.settings()
    assert kept["grid"] == "0" and kept["shadow"] == "0" and kept["budget"] == "0", kept
    assert kept["dark"] == "1", kept
    run.start()
    studio = run.studio
    run.open(run.file)
    studio.ask("do preferences")
    run.dialog("Preferences")
    assert studio.ask("text budget") == "0"
    run.click("Grid")
    studio.ask("close-dialog")
    run.no_dialog()


def test_shortcuts(run):
    """the window of shortcuts tells the keys that the program has"""
    studio = run.studio
    run.keys("ctrl+question")
    run.dialog("GtkShortcutsWindow")
    for title in ("New window", "Save the picture", "Quit"):
        run.appears(title)
    run.picture_of_dialog("shortcuts")
    studio.pointer("type", "inspector")  # what is typed is looked for
    run.appears("Show or fold the inspector")
    run.picture_of_dialog("shortcuts-found")
    run.keys("Escape")
    run.keys("Escape")
    run.no_dialog()


def png(path):
    """Width, height and kind of colours of a PNG: 2 is opaque, 6 has alpha."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    return (*struct.unpack(">II", data[16:24]), data[25])


def test_picture(run):
    """the view is saved as a picture of the size that is asked for, and nothing is lost by it"""
    studio = run.studio
    run.open(run.file)

    def path(name):
        return os.path.join(run.home, name)

    def ask():
        run.keys("ctrl+shift+p")
        run.dialog("Save the Picture")

    ask()
    run.picture_of_dialog("picture-asked")
    run.keys("Escape")
    run.no_dialog()
    assert not os.path.exists(path("flower.png"))
    ask()
    run.fill("picture-width", "320")
    run.fill("picture-height", "200")
    run.fill("picture-name", "")
    run.keys("Return")  # it has no name
    run.fill("picture-name", "a/b")
    assert studio.ask("text picture-note").startswith("A name has no slashes")
    run.fill("picture-name", "flower")
    assert studio.ask("text picture-save") == "_Save"
    run.keys("Return")
    run.no_dialog()
    assert studio.ask("said") == "Saved " + path("flower.png"), studio.ask("said")
    assert png(path("flower.png")) == (320, 200, 2)
    studio.wait()
    run.picture("picture-saved")  # the view is as large as before
    ask()
    run.click("Transparent")
    run.click("picture-save")  # under the name that is proposed
    run.no_dialog()
    x, y, width, height = studio.where("viewport")
    assert png(path("flower 2.png")) == (width, height, 6)
    with open(path("flower.png"), "rb") as file:
        before = file.read()
    ask()
    run.fill("picture-name", "flower.png")
    assert studio.ask("text picture-save") == "_Replace"
    assert studio.ask("text picture-note") == "It takes the place of the one called so"
    run.picture_of_dialog("picture-replace")
    run.click("Cancel")
    run.no_dialog()
    with open(path("flower.png"), "rb") as file:
        assert file.read() == before
    ask()
    run.fill("picture-folder", path("flower.frond"))  # which is no folder
    run.fill("picture-name", "lost")
    run.click("picture-save")
    assert studio.ask("dialog") == "Save the Picture"
    assert studio.ask("text picture-note").startswith("It cannot be written: ")
    run.picture_of_dialog("picture-unwritten")
    run.fill("picture-folder", run.home)
    run.click("picture-save")
    run.no_dialog()
    assert png(path("lost.png")) == (width, height, 2)


def drawn(run, *touches):
    """Draws with so many touches of a pen: heights of the board meanwhile, and the points of the
    stroke that comes of it, each x, y, z and a pressure where it is not that of a mouse."""
    studio = run.studio
    heights = []
    for step, touch in enumerate(touches):  # a tenth of a second each
        x, y = studio.middle("sketch-board", 0.3 + 0.05 * step, 0.8 - 0.1 * step)
        studio.ask(f"pen {'move' if step else 'down'} {x} {y} {touch} {0.1 * step}")
        heights.append(json.loads(studio.ask("sketch"))["height"])
    studio.ask("pen up")
    studio.wait()
    stroke = re.findall("<stroke[^>]*>([^<]*)</stroke>", studio.text(run.home))[-1]
    return heights, [[float(number) for number in point.split(",")] for point in stroke.split()]


def test_pen(run):
    """a pen's pressure goes into the stroke, and its tilt moves the board if that is wished"""
    studio = run.studio
    run.open(run.file)
    first = studio.state()["digest"]
    studio.ask("do sketch")
    studio.wait()
    run.appears("sketch-skeleton")
    studio.click(studio.middle("sketch-skeleton", 0.15, 0.06))
    run.keys("Home")
    studio.wait()
    assert json.loads(studio.ask("sketch"))["selected"] == 1
    pressed = ("0.2 nan", "0.5 -0.6", "0.9 -1", "1.7 0", "nan 0.5")
    heights, stroke = drawn(run, *pressed)
    assert [point[3:] for point in stroke] == \
        [[0.2, 0], [0.5, 0.1], [0.9, 0.2], [1, 0.3], [1, 0.4]], stroke
    assert len(set(heights)) == 1, "a tilt that nobody asked for moves the board"
    along = math.hypot(*stroke[-1][:2])
    towards = stroke[-1][1] / along, -stroke[-1][0] / along  # who draws
    assert all(abs(x * towards[0] + y * towards[1]) < 1e-3 for x, y, *_ in stroke), stroke
    studio.ask("do sketch-tilt")
    heights, stroke = drawn(run, *pressed)
    reach = heights[2]  # leaning towards who draws as far as it can
    assert reach > 0 and heights[3] == 0, heights
    assert abs(heights[1] - 0.6 * reach) < 1e-5 and abs(heights[4] + 0.5 * reach) < 1e-5, heights
    # Where the board moves, the pen draws on with the pressure it had: more than one point a place.
    places = sorted({point[2] for point in stroke})
    came = [[point for point in stroke if point[2] == place][0] for place in places]
    assert [point[3] for point in came] == [0.2, 0.5, 0.9, 1, 1], stroke
    assert all(point[3] == came[places.index(point[2])][3] for point in stroke), stroke
    for point, height in zip(came, heights):
        depth = point[0] * towards[0] + point[1] * towards[1]
        assert abs(depth - height + heights[0]) < 1e-3, (depth, heights)
    run.picture("pen")
    studio.ask("do sketch-tilt")
    studio.ask("do sketch")
    studio.undo_all()
    assert studio.state()["digest"] == first


TESTS = [test_views, test_views_by_keys, test_removed, test_rename_preset, test_broken_preset,
         test_recent, test_preferences, test_shortcuts, test_picture, test_pen]


if __name__ == "__main__":
    driver.main(TESTS, Run, driver.why_not())
