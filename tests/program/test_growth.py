"""Growth bud by bud: steps, saving, resuming, being killed, and the forest of Figure 8."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import frond_tap as tap

PLANTS = tap.SOURCE / "examples" / "close-plants.frond"
PARTS = tap.SOURCE / "examples" / "crown-parts.frond"
FOREST = tap.SOURCE / "examples" / "forest-road.frond"


def digests(*arguments):
    return [step["digest"] for step in tap.statistics(*arguments)["per_step"]]


def equal_steps(folder):
    results = [digests(PLANTS, "--steps", 12, "--threads", n) for n in (1, 2, 3, 8)]
    assert len(set(results[0])) == 12, "every step changes something"
    assert all(result == results[0] for result in results)


def resumed_at_every_step(folder):
    whole = tap.statistics(PARTS, "--steps", 9)
    saved = folder / "saved"
    for step in range(1, 9):
        tap.run("build", PARTS, "-q", "--steps", step, "--checkpoint", saved)
        stats = tap.statistics(PARTS, "--steps", 9, "--resume", saved)
        assert stats["digest"] == whole["digest"], step
        assert [s["digest"] for s in stats["per_step"]] == [s["digest"] for s in whole["per_step"]]


def killed(folder):
    """However a run is killed, its checkpoint is whole and no more than a step old."""
    whole = digests(PARTS, "--steps", 14)
    for k, wait in enumerate((0.15, 0.3, 0.5, 0.8, 1.2)):
        saved = folder / f"saved{k}"
        run = subprocess.Popen([tap.PROGRAM, "build", str(PARTS), "-q", "--steps", "400",
                                "--checkpoint", str(saved)], stderr=subprocess.DEVNULL)
        while not saved.exists():
            time.sleep(0.01)
        time.sleep(wait)
        os.kill(run.pid, signal.SIGKILL)
        run.wait()
        stats = tap.statistics(PARTS, "--steps", 0, "--resume", saved)
        reached = [step["digest"] for step in stats["per_step"]]
        assert reached, "a step at least was saved"
        assert reached[:14] == whole[:len(reached)]


# Two L-systems that ask for room, and a tree between them.
MIXED = """<frond version="1">
  <plant id="p"><lsystem><![CDATA[
derivation length: 40
w : D(?,?)A
p1 : D(d,a) < A : a > 0.2 -> F(0.1)[+(60)f(0.1)]D(?,?)A
  ]]></lsystem></plant>
  <plant id="t"><species model="open" step="0.2" auxin-reach="1" leaves="1"/></plant>
  <scene>
    <growth steps="40" min="-4, -4, -1" max="4, 4, 6" cell="0.05"/>
    <place plant="p" at="0.4, 0, 0"/>
    <place plant="p" at="-0.4, 0, 0"/>
    <place plant="t"/>
  </scene>
</frond>
"""


def killed_among(folder):
    """L-systems that ask go on from a checkpoint as if nothing had happened."""
    document = folder / "mixed.frond"
    document.write_text(MIXED)
    whole = tap.statistics(document)
    for k, wait in enumerate((0, 0.1, 0.3)):
        saved = folder / f"mixed{k}"
        run = subprocess.Popen([tap.PROGRAM, "build", str(document), "-q", "--checkpoint",
                                str(saved)], stderr=subprocess.DEVNULL, cwd=folder)
        while not saved.exists() and run.poll() is None:
            time.sleep(0.01)
        time.sleep(wait)
        os.kill(run.pid, signal.SIGKILL)
        run.wait()
        stats = tap.statistics(document, "--resume", saved)
        assert stats["digest"] == whole["digest"], (stats["digest"], whole["digest"])
    content = saved.read_bytes()
    broken = folder / "broken-mixed"
    for at in range(0, len(content), max(1, len(content) // 30)):
        broken.write_bytes(content[:at] + bytes([content[at] ^ 0x41]) + content[at + 1:])
        tap.run("build", document, "-q", "--resume", broken, status=1)


def resumed_among(folder):
    """Among plants that grow bud by bud --steps changes no L-system but stops it, so a growth in which
    some stand or grow goes on with other steps."""
    document, saved = folder / "stopped.frond", folder / "stopped"
    bush = """<plant id="b"><lsystem steps="3" unit="0.05"><![CDATA[w : F\nq : F -> F[+(40)F]F]]></lsystem></plant>
  <scene>"""
    stands = '<place plant="t"/>\n    <place plant="b" at="3, 0, 0"/>'
    document.write_text(MIXED.replace("<scene>", bush).replace('<place plant="t"/>', stands))
    whole = tap.statistics(document)
    assert tap.statistics(document, "--steps", 40)["digest"] == whole["digest"]
    for steps in (4, 9, 23):
        resume = ("--resume", saved) if saved.exists() else ()
        tap.run("build", document, "-q", "--steps", steps, "--checkpoint", saved, *resume)
    resumed = tap.statistics(document, "--resume", saved)
    assert (resumed["digest"], resumed["by_production"]) == (whole["digest"], whole["by_production"])
    longer = tap.statistics(document, "--set", "scene.growth.steps=5")
    assert len(longer["per_step"]) > 5 and longer["living"] == 1, longer
    assert longer["active_buds"] == longer["per_step"][4]["active_buds"]
    young = tap.statistics(document, "--steps", 4)
    assert young["by_production"]["q"] == whole["by_production"]["q"] > 20, young["by_production"]
    assert young["by_production"]["p1"] < whole["by_production"]["p1"], young["by_production"]
    strings = [tap.run("derive", document, "--plant", "b", "--steps", n).stdout for n in (1, 2)]
    assert len(strings[0]) < len(strings[1])


def told_otherwise(folder):
    """A comment or a blank between elements makes no other document."""
    document, saved = folder / "tree.frond", folder / "saved"
    text = """<frond version="1">
  <plant id="tree"><species model="open"/></plant>
  <scene><growth steps="5" min="-4,-4,0" max="4,4,6"/><place plant="tree"/></scene>
</frond>
"""
    document.write_text(text)
    whole = tap.statistics(document)["digest"]
    tap.run("build", document, "-q", "--steps", 2, "--checkpoint", saved)
    for other in (text + "<!-- c -->\n", text.replace("><", ">\n    <!-- a > b -->\n<"), text.replace("\n", "")):
        document.write_text(other)
        assert tap.statistics(document, "--resume", saved)["digest"] == whole, other
    document.write_text(text.replace("open", "rauh"))
    assert "[other-document]" in tap.run("build", document, "--resume", saved, status=1).stderr


def refused(folder):
    saved = folder / "saved"
    tap.run("build", PARTS, "-q", "--steps", 3, "--checkpoint", saved)
    cases = [((PLANTS, "--resume", saved), "other-document"),
             ((PARTS, "--seed", 5, "--resume", saved), "other-document"),
             ((PARTS, "--set", "left.species.step=0.3", "--resume", saved), "other-document"),
             ((PARTS, "--resume", PARTS), "not-a-checkpoint")]
    whole = saved.read_bytes()
    # The version stands behind sixteen bytes that say what the file is.
    other = folder / "other"
    other.write_bytes(whole[:16] + b"9.9.9\0" + whole[22:])
    cases.append(((PARTS, "--resume", other), "other-version"))
    older = folder / "older"
    older.write_bytes(whole[:10] + b"\x31" + whole[11:])
    cases.append(((PARTS, "--resume", older), "other-version"))
    for case, code in cases:
        said = tap.run("build", *case, status=1).stderr
        assert f"[{code}]" in said, said
        # The file is named, no line of it is shown, and what to do is said.
        assert said.startswith(str(case[-1]) + ":1:1: error: ") and said.count("\n") == 1, said
        assert code == "not-a-checkpoint" or "from the seeds again" in said, said
    nothing = tap.run("build", tap.SOURCE / "examples" / "figure2.frond", "--resume", saved, status=2)
    assert "grows step by step" in nothing.stderr


def damaged(folder):
    """Any byte that is wrong or missing is noticed."""
    saved, broken = folder / "saved", folder / "broken"
    tap.run("build", PARTS, "-q", "--steps", 2, "--checkpoint", saved)
    whole = saved.read_bytes()
    for at in range(0, len(whole), max(1, len(whole) // 60)):
        broken.write_bytes(whole[:at] + bytes([whole[at] ^ 0x41]) + whole[at + 1:])
        tap.run("build", PARTS, "-q", "--resume", broken, status=1)
        broken.write_bytes(whole[:at])
        tap.run("build", PARTS, "-q", "--resume", broken, status=1)


def frames(folder):
    tap.run("render", PARTS, "-q", "-o", folder / "grow.png", "--frames", "2..4", "--size", "40x30",
            "--samples", 1)
    pictures = sorted(path.name for path in folder.glob("*.png"))
    assert pictures == ["grow-0002.png", "grow-0003.png", "grow-0004.png"], pictures
    assert len({(folder / name).read_bytes() for name in pictures}) == 3


def one_growth(folder):
    """All frames come from one growth, and the last of many is that of the frame by itself."""
    told = []
    for range_ in ("2..5", "5..5"):
        stats = folder / "stats.json"
        tap.run("render", PARTS, "-q", "-o", folder / "grow.png", "--frames", range_, "--size", "8x6",
                "--samples", 1, "--stats", stats)
        told.append(json.loads(stats.read_text()))
    assert told[0]["digest"] == told[1]["digest"]
    steps = [[(step["digest"], step["living"], step["wood"]) for step in one["per_step"]] for one in told]
    assert len(steps[0]) == 5 and steps[0] == steps[1], steps


def forest(folder):
    stats = tap.statistics(FOREST)
    assert stats["steps"] == 14
    for key, least in (("plants", 140), ("active_buds", 50000), ("axes", 224000), ("organs", 238000)):
        assert least <= stats[key] <= 2 * least, (key, stats[key])
    last = stats["per_step"][-1]
    for key in ("seconds", "nodes", "active_buds", "shed", "collisions", "rays_recast"):
        assert key in last, key


def thinning(folder):
    """--stats counts the living and their wood after every step."""
    stand = tap.SOURCE / "examples" / "self-thinning.frond"
    stats = tap.statistics(stand, "--steps", 16)
    living = [step["living"] for step in stats["per_step"]]
    wood = [step["wood"] for step in stats["per_step"]]
    assert living[0] == 300 and 0 < living[-1] < 300, living
    assert all(a >= b for a, b in zip(living, living[1:])), living
    assert stats["living"] == living[-1] and abs(stats["wood"] / wood[-1] - 1) < 0.05


def resumed_later(folder):
    """A state that has more steps than are asked for is shown as it is, and told."""
    saved = folder / "saved"
    tap.run("build", PARTS, "-q", "--steps", 4, "--checkpoint", saved)
    said = tap.run("build", PARTS, "--steps", 2, "--resume", saved).stderr
    assert "[resumed-later]" in said and "4 steps" in said, said
    assert len(tap.statistics(PARTS, "--steps", 2, "--resume", saved)["per_step"]) == 4


def told_at_places(folder):
    """What stands where it cannot grow is told at what has placed it."""
    document = folder / "wrong.frond"
    document.write_text("""<frond version="1">
  <plant id="oak"><species envelope="0,-3 1,-2 0,-1"/></plant>
  <scene>
    <growth steps="1"/>
    <place plant="oak"/>
    <place plant="oak" at="500, 0, 0"/>
    <place plant="oak" at="3, 0, 0"/>
    <obstacle at="3, 0, 0" size="1, 1, 1"/>
  </scene>
</frond>
""")
    for command in ("build", "check"):
        said = tap.run(command, document, "--set", "oak.species.leaf-length=0.3").stderr
        assert "wrong.frond:5:6: warning: 1 of 3" in said and "[seed-envelope]" in said, said
        assert "wrong.frond:6:6: warning: 1 of 1 seeds have no place" in said and "outside the arena" in said, said
        assert "wrong.frond:7:6: warning: 1 of 1" in said and "the obstacle of line 8" in said, said
        assert said.count("[seed-place]") == 2 and "nothing grows" not in said, said
        said = tap.run(command, document, "--set", "growth.gravity=0,0,1").stderr
        assert "plants rise against `gravity` of <growth>, here towards 0,0,-1" in said, said


def open_obstacles(folder):
    """A mesh that encloses nothing is told where something grows."""
    (folder / "sheet.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    document = folder / "open.frond"
    document.write_text("""<frond version="1">
  <plant id="oak"><species/></plant>
  <scene>
    <growth steps="1" min="-4, -4, 0" max="4, 4, 4"/>
    <place plant="oak"/>
    <obstacle shape="mesh" file="sheet.obj" at="2, 0, 1"/>
  </scene>
</frond>
""")
    for command in ("build", "check"):
        said = tap.run(command, document).stderr
        assert said.count("[open-obstacle]") == 1 and "open.frond:6:6: warning" in said, said


def open_for_others(folder):
    """So is one that an L-system asks for room beside, and a form that has no outside."""
    (folder / "sheet.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    document = folder / "asking.frond"
    document.write_text("""<frond version="1">
  <plant id="p"><lsystem><![CDATA[
derivation length: 3
w : D(?,?)A
p1 : D(d,a) < A : a > 0.2 -> F(0.1)D(?,?)A
  ]]></lsystem></plant>
  <plant id="q"><pgraph>
    <camera id="root"/><tree id="stem" length="1"/>
    <force id="form" kind="mesh" file="sheet.obj" inverted="yes" solid="prune" strength="0"/>
    <link from="root" to="form"/><link from="form" to="stem"/>
  </pgraph></plant>
  <scene>
    <place plant="p"/>
    <obstacle shape="mesh" file="sheet.obj" at="2, 0, 1"/>
  </scene>
</frond>
""")
    for command in ("build", "check"):
        said = tap.run(command, document).stderr
        assert said.count("asking.frond:14:6: warning: 'sheet.obj' is not closed: where") == 1, said
    assert "asking.frond:9:16: warning: 'sheet.obj' is not closed: it has no outside" in said, said
    document.write_text(document.read_text().replace("D(?,?)", "D").replace("D(d,a)", "D").replace(": a > 0.2", ": *")
                        .replace(' inverted="yes"', ""))
    assert tap.run("check", document).stderr == ""


def low_room(folder):
    """A seed close below the top of the arena or an obstacle is told; what has room, or climbs, is not."""
    document = folder / "low.frond"

    def told(at, more="", species=""):
        document.write_text(f"""<frond version="1">
  <plant id="tree"><species model="open" step="0.4"{species}/></plant>
  <scene ground="no">
    <growth steps="4" min="-4, -4, -1" max="4, 4, 4" cell="0.05"/>
    {more}
    <place plant="tree" at="{at}"/>
  </scene>
</frond>
""")
        said = [tap.run(verb, document).stderr for verb in ("check", "build")]
        assert said[0] == said[1], said
        if said[0]:
            assert "low.frond:6:6: warning: 1 of 1" in said[0] and "[seed-room]" in said[0], said
        nodes = tap.statistics(document)["nodes"]
        return bool(said[0]), nodes

    lid = '<obstacle size="3, 3, 0.2" at="0, 0, {}"/>'
    assert told("0, 0, 3.9") == (True, 0)
    assert not told("0, 0, 3")[0]
    assert told("0, 0, 0", lid.format(0.2)) == (True, 0)
    for free in (told("0, 0, 0", lid.format(1.2)), told("3, 0, 0", lid.format(0.2)),
                 told("0, 0, 0.4", lid.format(0.2))):
        assert not free[0] and free[1] > 3, free
    assert not told("0, 0, 0", lid.format(0.2), ' collide="no"')[0]
    for example in sorted((tap.SOURCE / "examples").glob("*.frond")):
        if "<species" in example.read_text(encoding="utf-8"):
            assert "seed-room" not in tap.run("check", example).stderr, example


def on_obstacles(folder):
    """What stands on an obstacle grows; in it, or close beside it, it is told."""
    document = folder / "planter.frond"

    def stands(at, living, more=""):
        document.write_text(f"""<frond version="1">
  <plant id="tree"><species model="open" step="0.3"{more}/></plant>
  <scene>
    <growth steps="4" min="-8, -8, -1" max="8, 8, 8" cell="0.05"/>
    <obstacle size="1, 1, 1"/>
    <place plant="tree" at="{at}"/>
  </scene>
</frond>
""")
        said = [tap.run("check", document).stderr, tap.run("build", document).stderr]
        assert all(("[seed-place]" in text) == (living == 0) for text in said), (at, said)
        grown = tap.statistics(document)
        assert grown["living"] == living, (at, grown["living"])
        assert living == 0 or grown["nodes"] >= 4, (at, grown)

    for at in ("0, 0, 1", "0.3, 0.2, 1.01", "0.3, 0.2, 1.06", "0, 0, 0.999"):
        stands(at, 1)
    stands("0, 0, 1", 1, ' keeps-off="internode"')
    for at in ("0, 0, 0.9", "0, 0, 0.5", "0.52, 0, 0.3", "0, 0, 8"):
        stands(at, 0)


def without_internodes(folder):
    """Seeds on each other, in narrow envelopes and in low arenas are told, and so are those that made nothing."""
    document = folder / "bare.frond"
    (folder / "box.obj").write_text("".join(f"v {x} {y} {z}\n" for y in (0, 3) for z in (-1, 1) for x in (-1, 1)) +
                                    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")

    def told(species="", places=("0, 0, 0",), top=8):
        stands = "".join(f'\n    <place plant="tree" at="{at}"/>' for at in places)
        document.write_text(f"""<frond version="1">
  <plant id="tree"><species model="open" step="0.3"{species}/></plant>
  <scene>
    <growth steps="8" min="-8, -8, -1" max="8, 8, {top}" cell="0.03"/>{stands}
  </scene>
</frond>
""")
        codes = [re.findall(r"\[([a-z-]+)\]", tap.run(verb, document).stderr) for verb in ("check", "build")]
        return codes, tap.statistics(document)["nodes"]

    assert told()[0] == [[], []]
    for narrow in ("0.005,0 0.005,4", "3,0 3,0.05"):
        assert told(f' envelope="{narrow}"') == ([["seed-room"]] * 2, 0), narrow
    assert told(top=0.1) == ([["seed-room"]] * 2, 0)
    faces = told(' envelope-file="box.obj"')  # the seed is on its lower face
    assert faces[0] == [[], []] and faces[1] > 10, faces
    beside = told(' envelope-file="box.obj"', top=8, places=("3, 0, 0",))
    assert beside[0] == [[], []], beside
    three = told(places=["0, 0, 0"] * 3)
    assert three[0] == [["seeds-together"], ["seeds-together", "no-internode"]], three
    assert told(places=["0, 0, 0", "0.3, 0, 0"])[0] == [[], []]


def absent_species(folder):
    """A plant that stands nowhere does not change how wide cells are."""
    document = folder / "tree.frond"
    text = """<frond version="1">
  <plant id="tree"><species model="open" step="0.4"/></plant>
  <scene><growth steps="6" min="-10,-10,0" max="10,10,12"/><place plant="tree"/></scene>
</frond>
"""
    document.write_text(text)
    digest = tap.statistics(document)["digest"]
    document.write_text(text.replace("  <scene>", '  <plant id="never"><species step="0.05"/></plant>\n  <scene>'))
    assert tap.run("check", document).stderr == ""
    assert tap.statistics(document)["digest"] == digest


def more_suns_than_views(folder):
    document = folder / "suns.frond"
    document.write_text("""<frond version="1">
  <plant id="tree"><species/></plant>
  <scene><growth steps="2" suns="30" views="10"/><place plant="tree"/></scene>
</frond>
""")
    assert "[suns-views]" in tap.run("check", document).stderr
    assert tap.run("check", document, "--set", "growth.suns=10").stderr == ""


def sunken(folder):
    """A seed that the first internode does not bring out of the ground is told."""
    document = folder / "sunken.frond"
    document.write_text("""<frond version="1">
  <plant id="oak"><species/></plant>
  <scene>
    <growth steps="3" min="-4, -4, -2" max="4, 4, 4"/>
    <place plant="oak" at="0, 0, -0.1"/>
    <place plant="oak" at="2, 0, -0.5"/>
  </scene>
</frond>
""")
    for command in ("build", "check"):
        said = tap.run(command, document).stderr
        assert said.count("[seed-depth]") == 1 and "sunken.frond:6:6: warning: 1 of 1" in said, said
        assert "do not come out of it" in said, said
        assert tap.run(command, document, "--set", "scene.ground=no").stderr == ""


def floating(folder):
    """A seed that stands on nothing is told; on the ground, an obstacle or a wall, as a climber, or without any
    ground it is not."""
    document = folder / "floating.frond"

    def told(at, more="", species="", scene=""):
        document.write_text(f"""<frond version="1">
  <plant id="tree"><species step="0.4"{species}/></plant>
  <scene{scene}>
    <growth steps="1" min="-4, -4, -1" max="4, 4, 8" cell="0.05"/>
    <obstacle size="1, 1, 1"/>{more}
    <place plant="tree" at="{at}"/>
  </scene>
</frond>
""")
        said = [tap.run(verb, document).stderr for verb in ("check", "build")]
        assert said[0] == said[1], said
        assert not said[0] or "floating.frond:6:6: warning: 1 of 1 seeds stand in the air" in said[0], said
        return "[seed-height]" in said[0]

    assert told("3, 0, 2")
    assert told("0, 0, 2") and not told("0, 0, 1.1")
    assert not told("3, 0, 0.3") and not told("0.6, 0, 0.8")
    assert not told("3, 0, 2", species=' climb="0.5"') and not told("3, 0, 2", scene=' ground="no"')
    assert not told("3, 0, 2", '<obstacle at="3, 0, 1" size="1, 1, 1"/>')
    (folder / "hill.stl").write_text("solid\n" + "".join(
        "facet normal 0 0 1\nouter loop\nvertex -9 -9 1\n" + f"vertex {a} 1\nvertex {b} 1\nendloop\nendfacet\n"
        for a, b in (("9 -9", "9 9"), ("9 9", "-9 9"))) + "endsolid\n")
    hill = '<terrain file="hill.stl" size="1, 1, 1"/>'
    assert told("3, 0, 1", hill) and not told("3, 0, 0", hill)
    for example in sorted((tap.SOURCE / "examples").glob("*.frond")):
        if "<species" in example.read_text(encoding="utf-8"):
            assert "seed-height" not in tap.run("check", example).stderr, example


def too_wide(folder):
    """Small plants in a wide arena, whose cells are wide too, are told before they fail to grow."""
    document = folder / "wide.frond"
    document.write_text("""<frond version="1">
  <plant id="oak"><species/></plant>
  <plant id="herb"><species step="0.12"/></plant>
  <scene>
    <growth steps="12"/>
    <place plant="oak" at="9, 0, 0"/>
    <place plant="herb"/>
  </scene>
</frond>
""")
    for command in ("build", "check"):
        said = tap.run(command, document).stderr
        assert said.count("[wide-cells]") == 1 and "'herb' may hardly grow" in said, said
        assert "wide.frond:5:6: warning" in said and "make the arena smaller" in said, said
    for example in sorted((tap.SOURCE / "examples").glob("*.frond")):
        if "<species" in example.read_text(encoding="utf-8"):
            assert "wide-cells" not in tap.run("check", example).stderr, example
    near = document.read_text().replace("/>\n    <place", ' min="-4, -4, 0" max="13, 4, 9"/>\n    <place', 1)
    document.write_text(near)
    assert tap.run("check", document).stderr == ""
    given = document.read_text().replace("<growth", '<growth cell="0.3"')
    document.write_text(given)
    assert "make `cell` smaller" in tap.run("check", document).stderr


def checked_soon(folder):
    """What is wrong with a growth is said without growing it."""
    began = time.monotonic()
    tap.run("check", FOREST, "--limit", "bytes=30000000")
    assert time.monotonic() - began < 5


def one_bound(folder):
    """An option takes as many steps as the attribute."""
    said = tap.run("build", PARTS, "--steps", 100001, status=2).stderr
    assert "100000" in said, said
    tap.run("check", PARTS, "--set", "growth.steps=100001", status=1)


TESTS = [("/program/growth/--steps takes as many as the attribute", one_bound),
         ("/program/growth/every step has one digest for any number of threads", equal_steps),
         ("/program/growth/a run resumed at any step ends as one that was not broken off",
          resumed_at_every_step),
         ("/program/growth/a run that is killed loses a step at most", killed),
         ("/program/growth/so does one in which L-systems grow too", killed_among),
         ("/program/growth/and is resumed with more steps, whatever L-systems stand in it", resumed_among),
         ("/program/growth/comments make no other document", told_otherwise),
         ("/program/growth/checkpoints of other documents, seeds and versions are refused", refused),
         ("/program/growth/damaged checkpoints are refused", damaged),
         ("/program/growth/frames show the steps", frames),
         ("/program/growth/many frames grow as each does by itself", one_growth),
         ("/program/growth/the forest has the numbers of Figure 8", forest),
         ("/program/growth/the living and their wood are counted", thinning),
         ("/program/growth/a state with more steps than asked for is told", resumed_later),
         ("/program/growth/seeds that cannot grow are told at their places", told_at_places),
         ("/program/growth/what stands on an obstacle grows", on_obstacles),
         ("/program/growth/plants without an internode are told", without_internodes),
         ("/program/growth/only species that stand decide how wide cells are", absent_species),
         ("/program/growth/more suns than views are told", more_suns_than_views),
         ("/program/growth/seeds that the ground holds are told", sunken),
         ("/program/growth/seeds that stand on nothing are told", floating),
         ("/program/growth/obstacles that are not closed are told", open_obstacles),
         ("/program/growth/so are those beside L-systems and forms without an outside", open_for_others),
         ("/program/growth/seeds below something are told", low_room),
         ("/program/growth/cells that are too wide for a species are told", too_wide),
         ("/program/growth/checking does not grow", checked_soon)]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
