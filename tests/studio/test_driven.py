"""The studio with a person's hands: dragging, drawing, undoing, saving, on a real display."""

import os
import sys

import studio_driver as driver
from driven_plant import (
    test_curve, test_elsewhere, test_escape, test_flower, test_hand, test_keys, test_link, test_lsystem,
    test_material, test_own_wind, test_patch, test_preset, test_preset_files, test_repeat,
    test_slider, test_wind)
from driven_run import BEGINNING, PICTURES, Run, SOURCE
from driven_scene import (
    test_arrange, test_export_changed, test_export_one, test_grove, test_lamps, test_levels,
    test_light, test_rows)
from driven_sketch import test_device, test_sketch


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
    run.studio.ask("size 1440 900")


def test_broken(run):
    """a document that cannot be read shows no plant of the one before"""
    run.studio.ask(f"open {SOURCE / 'examples' / 'sunflower.frond'}")
    run.studio.wait()
    assert run.studio.state()["triangles"] > 0
    run.open_text("broken.frond", '<frond version="1"><plant id="p"')
    run.picture("broken")
    state = run.studio.state()
    assert state["problems"] == 1 and state["triangles"] == 0, state


def test_foreign(run):
    """a document that is not UTF-8 can be read but not typed over"""
    studio = run.studio
    foreign = BEGINNING.replace("a stem", "a caf\u00e9").encode("latin-1")
    file = os.path.join(run.home, "foreign.frond")
    with open(file, "wb") as copy:
        copy.write(foreign)
    run.open(file)
    before = studio.state()
    assert before["problems"] == 1 and "not UTF-8" in studio.ask("text text-note"), before
    studio.click(studio.middle("xml", 0.5, 0.2))
    studio.pointer("type", "a")
    studio.pointer("key", "Delete")
    studio.ask("do problem")
    run.picture("foreign")
    assert studio.state()["digest"] == before["digest"] and studio.state()["steps"] == 0
    studio.ask(f"do save-to('{file}')")
    with open(file, "rb") as copy:
        assert copy.read() == foreign
    run.open(run.file)
    try:
        words = studio.ask("text text-note")
    except AssertionError:
        words = "none"  # it is hidden
    assert words == "none", words


def test_welcome(run):
    """a new window welcomes with presets"""
    run.studio.ask("size 1440 900")
    run.picture("welcome")


def test_view(run):
    """the view turns, zooms and picks"""
    studio = run.studio
    studio.drag([600, 500], [700, 520], is_cancelled=True)
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


TESTS = [
    test_welcome, test_repeat, test_examples, test_broken, test_foreign, test_lsystem,
    test_preset_files,
    test_grove, test_levels, test_arrange, test_rows, test_export_changed, test_export_one,
    test_light, test_lamps, test_patch, test_own_wind, test_sketch, test_device, test_flower,
    test_link, test_elsewhere, test_escape, test_preset, test_slider, test_material, test_keys, test_wind,
    test_curve, test_view, test_hand, test_mistake, test_undo, test_save, test_export,
    test_dialogs, test_killed]


if __name__ == "__main__":
    # A word leaves out the tests that have it in their names.
    wanted = [test for test in TESTS if not any(word in test.__name__ for word in sys.argv[1:])]
    driver.main(wanted, Run, driver.why_not())
