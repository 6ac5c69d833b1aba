"""Sketch mode with a person's hands, and with a device."""

import json
import os
import shutil

from driven_run import SOURCE


def sketched(run):
    return json.loads(run.studio.ask("sketch"))


def test_sketch(run):
    """branches are chosen and drawn in depth, and what comes of it stands in the scene"""
    studio = run.studio
    shutil.copy(SOURCE / "examples" / "strokes.frond", run.home)
    run.open(os.path.join(run.home, 'strokes.frond'))
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
    run.open(run.file)


def test_device(run):
    """a device draws by lines of text, and keys choose and draw as the pointer does, in little room"""
    studio = run.studio
    studio.ask("size 1024 768")
    run.open(os.path.join(run.home, 'strokes.frond'))
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
    run.look("state", lambda answer: json.loads(answer)["steps"] > 0)
    studio.wait()
    assert studio.state()["steps"] == 1, studio.state()
    studio.click(studio.middle("sketch-board", 0.5, 0.5))
    for key in ("space", "Up", "Up", "Right", "Page_Up", "Up", "space"):
        studio.pointer("key", key)
    studio.wait()
    assert studio.state()["steps"] == 2, studio.state()
    studio.ask("do sketch")
    studio.ask("size 1440 900")
    studio.undo_all()
    run.open(run.file)
