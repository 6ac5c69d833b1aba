"""The studio for those who see little or use no pointer: what is told to screen readers, and keys."""

import re
import time

import studio_driver as driver
from driven_run import Home, SOURCE

PLANT = """<frond version="1">
  <curve id="thick" points="0,1 0.5,0.6 1,0.2"/>
  <plant id="p" seed="1">
    <pgraph>
      <camera id="root"/>
      <horn id="stem" length="0.6" radius="0.01" profile="thick"/>
      <horn id="twig" length="0.2"/>
      <link from="root" to="stem"/>
    </pgraph>
  </plant>
</frond>
"""


class Run(Home):
    def __init__(self):
        super().__init__()
        self.display = driver.Display()
        self.bus = driver.Bus(self.display, self.home)
        self.studio = driver.Studio(self.display, self.home, bus=self.bus)
        self.studio.ask("size 1440 900")
        self.file = self.write("plant.frond", PLANT)

    def close(self):
        self.studio.kill()
        self.bus.close()
        self.display.close()
        super().close()

    def keys(self, *keys):
        for key in keys:
            self.studio.pointer("key", key)
        self.studio.wait()


def nodes(tree, path=()):
    """All that is told, each with the way to it."""
    for node in tree:
        here = path + (f"{node['role']} '{node['name']}'",)
        yield node, here
        yield from nodes(node["children"], here)


def is_named(node):
    # Where there is no name GTK tells the name of the type.
    return node["name"] != "" and not re.fullmatch(r"(Gtk|Adw|Studio)[A-Z]\w+", node["name"])


def is_container(node):
    """Parts of GTK: they hand the keyboard on to what is in them, and are read by that."""
    inner = [child for child, _ in nodes(node["children"])]
    return node["role"] == "scroll pane" or node["role"] in ("list", "list item", "filler") and (
        any(is_named(child) for child in inner) or not any(child["focusable"] for child in inner))


def read_until(run, is_told):
    """What is told: what has just come gets its words a moment later."""
    for _ in range(40):
        tree = run.bus.read()
        if is_told(tree):
            break
        time.sleep(0.25)
    return tree


def nameless(run, but="nothing"):
    """Paths of what keeps having no name; without those that hold a word."""
    def left(tree):
        return {" / ".join(path[-5:]) for node, path in nodes(tree)
                if node["focusable"] and not is_named(node) and not is_container(node)
                and but not in " / ".join(path[-5:])}
    return left(read_until(run, lambda tree: not left(tree)))


def told_of(run, name):
    def called(tree):
        return [node for node, _ in nodes(tree) if node["name"] == name]
    found = called(read_until(run, called))
    assert found, f"nothing is called {name}"
    return found[0]


def test_names(run):
    """whatever can have the keyboard has a name, in every mode"""
    studio = run.studio
    found = nameless(run)
    run.open(run.file)
    studio.ask("do select::thick")
    studio.wait()
    found |= nameless(run)
    for dialog in ("export", "preferences"):
        studio.ask("do " + dialog)
        studio.wait()
        found |= nameless(run, but="GtkSearchEntry")
        studio.ask("close-dialog")
    for example in ("strokes", "room-bushes"):
        run.open(SOURCE / "examples" / f"{example}.frond")
        if example == "strokes":
            studio.ask("do sketch")
            studio.wait()
        found |= nameless(run)
        if example == "strokes":
            studio.ask("do sketch")
    assert not found, "\n".join(sorted(found))


def test_roles(run):
    """what Frond draws itself tells what it is and what it shows"""
    studio = run.studio
    run.open(run.file)
    studio.ask("do select::stem")
    studio.wait()
    graph, picture = told_of(run, "Graph of components"), told_of(run, "Picture of the plants")
    assert graph["role"] == "panel" and graph["description"] == "stem, horn, 1 in the plant", graph
    assert picture["role"] == "image" and "triangles" in picture["description"], picture
    studio.ask("do select::thick")
    studio.wait()
    curve = [node for node, _ in nodes(run.bus.read())
             if node["description"] == "3 points; Page Down chooses one"]
    assert len(curve) == 1 and curve[0]["name"] == "Points", curve


def test_tab(run):
    """Tab comes to all that can have the keyboard, and to nothing that is not seen"""
    studio = run.studio
    run.open(run.file)
    studio.ask("do select::root")
    studio.wait()
    studio.click(studio.middle("viewport", 0.5, 0.05))
    studio.ask("do select::root")
    studio.wait()
    seen = []
    while len(seen) < 150 and (focus := studio.ask("focus")) not in seen:
        seen.append(focus)
        studio.pointer("key", "Tab")
        studio.ask("state")
    left = [word for word in studio.ask("focus all").split() if word not in seen]
    # Other keys lead to these: Shift+F8 to dividers, arrows to rows.
    left = [word for word in left
            if word.split(":")[1] not in ("GtkPaned", "GtkScrolledWindow", "GtkListBoxRow")]
    assert len(seen) > 25 and not left, (len(seen), left)


def focus_graph(run):
    run.studio.click(run.studio.middle("box:stem"))
    assert "GraphPanel" in run.studio.ask("focus")


def test_graph(run):
    """a graph is walked, linked and changed by keys alone"""
    studio = run.studio
    run.open(run.file)
    first = studio.state()["digest"]
    focus_graph(run)
    run.keys("Up")
    assert studio.state()["selected"].endswith("camera:root"), studio.state()
    run.keys("Page_Down")
    assert told_of(run, "Graph of components")["description"].startswith("Link: stem"), \
        told_of(run, "Graph of components")
    run.keys("Down")
    assert studio.state()["selected"].endswith("horn:stem"), studio.state()
    run.keys("Right", "l", "Left", "Down")
    assert told_of(run, "Graph of components")["description"].endswith("of stem")
    run.picture("graph-carried")
    run.keys("Return")
    state = studio.state()
    assert state["steps"] == 1 and state["problems"] == 0, state
    assert 'from="stem" to="twig"' in studio.text(run.home)
    run.keys("l", "Up", "Escape")
    assert studio.state()["steps"] == 1, "Escape puts it back"
    run.keys("Return")
    assert "element-id" in studio.ask("focus"), studio.ask("focus")
    focus_graph(run)
    run.keys("Menu", "Down", "Down", "Down", "Return")  # the fourth line: Enable or Disable
    assert studio.state()["steps"] == 2, studio.state()
    focus_graph(run)
    run.keys("Delete")
    assert studio.state()["steps"] == 3, studio.state()
    studio.undo_all()
    studio.wait()
    assert studio.state()["digest"] == first


def test_curve(run):
    """a curve is drawn by keys alone"""
    studio = run.studio
    run.open(run.file)
    studio.ask("do select::thick")
    studio.wait()
    studio.click(studio.middle("points-curve", 0.5, 0.45))
    studio.undo_all()
    studio.wait()
    run.keys("Home", "Page_Down", "Up")
    state = studio.state()
    assert state["steps"] == 1, state
    assert 'points="0,1 0.5,0.61 1,0.2"' in studio.text(run.home), studio.text(run.home)
    run.keys("Insert")
    assert studio.state()["steps"] == 2
    assert 'points="0,1 0.5,0.61 0.75,0.405 1,0.2"' in studio.text(run.home), studio.text(run.home)
    run.picture("curve-keys")
    run.keys("Delete")
    assert 'points="0,1 0.5,0.61 1,0.2"' in studio.text(run.home), studio.text(run.home)
    studio.undo_all()
    assert studio.text(run.home) == PLANT


def test_dividers(run):
    """the panes are made wider by keys"""
    studio = run.studio
    run.open(run.file)
    before = studio.where("viewport")[2]
    studio.click(studio.middle("viewport", 0.5, 0.05))
    run.keys("shift+F8", "Left", "Left", "Left", "Return")
    after = studio.where("viewport")[2]
    assert after != before, (before, after)


TESTS = [test_names, test_roles, test_tab, test_graph, test_curve, test_dividers]


if __name__ == "__main__":
    driver.main(TESTS, Run, driver.why_not() or driver.Bus.why_not())
