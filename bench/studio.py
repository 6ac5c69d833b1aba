"""From an edit to its picture in the studio, on a display without a screen.

Prints, for the chestnut with its 207 000 leaves, how long reading, building, viewing, sending to the
graphics card and drawing take after edits of each kind; how long after the edit something of it was
first seen (the skeleton, where the rest takes longer) and when the plant was. Then, for it and two
scenes, how many pictures a second are drawn while the view turns, and how much processor time each
takes. Wall-clock where nothing else is said, the median of five edits; say how busy the machine was.
"""

import os
import pathlib
import statistics
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "tests" / "studio"))
os.environ.setdefault("FROND_STUDIO", str(SOURCE / "build/src/studio/frond-studio"))

import studio_driver  # noqa: E402, the path is set above

EDITS = {
    "leaf width": ("frond/plant:chestnut/pgraph/leaf:leaf.width", ["0.05", "0.052", "0.054", "0.056", "0.058"]),
    "leaf colour": ("frond/material:leaf.colour", ["#507a2c", "#517a2c", "#527a2c", "#537a2c", "#547a2c"]),
    "trunk length": ("trunk.length", ["10.6", "10.7", "10.8", "10.9", "11"]),
    "seed": ("frond/plant:chestnut.seed", ["12", "13", "14", "15", "16"]),
}
PARTS = ["read", "build", "view", "upload", "coarse", "first", "whole"]
TURNED = ["chestnut", "forest-road", "park"]
FRAMES = 60


def measure(studio, path, values):
    rows = []
    for value in values:
        studio.ask(f"do set::{path}={value}")
        studio.wait()
        state = studio.state()
        state["first"] = state["first"] or state["whole"]
        rows.append([1000 * state[part] for part in PARTS])
    return [statistics.median(column) for column in zip(*rows)]


def processor_seconds(program):
    """What all threads of a program have taken so far."""
    with open(f"/proc/{program.pid}/stat", encoding="ascii") as file:
        words = file.read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def turn(studio, name):
    studio.ask(f"open {SOURCE / 'examples' / name}.frond")
    studio.wait()
    studio.ask("orbit 20")  # it learns how fast the machine is
    began = processor_seconds(studio.program)
    seconds = float(studio.ask(f"orbit {FRAMES}"))
    each = (processor_seconds(studio.program) - began) / FRAMES
    drawn = studio.state()["coarse_triangles"]
    studio.wait()
    state = studio.state()
    print(f"turning {name}: {FRAMES / seconds:.1f} pictures a second of {drawn} triangles, "
          f"{1000 * each:.0f} ms of processor each; at rest {1000 * state['fine']:.0f} ms for "
          f"{state['triangles']}")


def main():
    reason = studio_driver.why_not()
    if reason is not None:
        sys.exit(f"bench/studio.py: {reason}")
    with studio_driver.Display() as display, tempfile.TemporaryDirectory() as home:
        studio = studio_driver.Studio(display, home)
        studio.ask("size 1440 900")
        studio.ask(f"open {SOURCE / 'examples/chestnut.frond'}")
        studio.wait()
        print(f"load {os.getloadavg()[0]:.1f}; milliseconds:")
        print(f"{'edit':14}" + "".join(f"{part:>9}" for part in PARTS))
        for name, (path, values) in EDITS.items():
            row = measure(studio, path, values)
            print(f"{name:14}" + "".join(f"{value:9.1f}" for value in row))
        for name in TURNED:
            turn(studio, name)
        studio.quit()


if __name__ == "__main__":
    main()
