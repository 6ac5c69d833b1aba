"""Plants that grow in the light: what derive, check and --stats tell of them."""

import json
import signal
import subprocess
import sys
import time

import frond_tap as tap

FLOWERS = tap.SOURCE / "examples" / "room-flowers.frond"
FEW = ("--set", "light.photons=4000")


def stats(folder, *options):
    text = tap.run("build", FLOWERS, "-o", folder / "a.glb", "--stats", "-", *FEW, *options).stdout
    return json.loads(text)


def stats_tell_the_light(folder):
    told = stats(folder, "--steps", 5)
    assert told["photons"] == 4000, told["photons"]
    assert told["rays"] > 4000, told["rays"]
    assert 0 < told["seconds"]["light"] < told["seconds"]["build"], told["seconds"]
    assert told["steps"] == 5 == len(told["per_step"])
    steps = told["per_step"]
    assert [step["step"] for step in steps] == [1, 2, 3, 4, 5]
    assert sorted(steps[0]) == ["light", "nodes", "organs", "queries", "rays_recast", "seconds", "step"]
    assert all(0 < step["light"] <= step["seconds"] for step in steps)
    # In the first step all rays are new, later those that grown leaves cut; plants only grow.
    assert steps[0]["rays_recast"] >= told["rays"] * 0.9
    assert all(step["rays_recast"] < steps[0]["rays_recast"] / 10 for step in steps[1:])
    assert all(a["nodes"] <= b["nodes"] for a, b in zip(steps, steps[1:]))
    assert all(step["queries"] > 0 for step in steps)
    assert stats(folder, "--set", "light.by=views", "--set", "light.relative=no", "--steps", 1).get("photons") == 0


def derive_uses_the_light(folder):
    lines = tap.run("derive", FLOWERS, "--steps", 3, *FEW).stdout.splitlines()
    assert [line.split(":")[0] for line in lines] == ["0", "0'", "1", "1'", "2", "2'", "3"], lines
    assert "I(?)" in lines[2] and "?" not in lines[3].split("N(")[0], lines[3]
    brighter = tap.run("derive", FLOWERS, "--steps", 3, *FEW, "--set", "light.seed=2").stdout
    assert brighter.splitlines() != lines, "another light gives the same answers"
    count = int(tap.run("derive", FLOWERS, "--steps", 3, "--print", "count", *FEW).stdout)
    steps = tap.run("derive", FLOWERS, "--steps", 3, "--print", "steps", *FEW).stdout.splitlines()
    assert [int(line.split()[0]) for line in steps] == [0, 1, 2, 3], steps
    assert int(steps[-1].split()[1]) == count, (steps, count)


def check_does_not_grow(folder):
    began = time.monotonic()
    assert tap.run("check", FLOWERS, "--set", "light.photons=20000000").stderr == ""
    assert time.monotonic() - began < 5, "it has grown"
    error = tap.run("check", FLOWERS, "--set", "light.photons=20000001", status=3).stderr
    assert "room-flowers.frond:" in error and "[limit-photons]" in error, error


def lamps_can_be_set(folder):
    dark = ("--set", "lamp-1.power=0", "--set", "lamp-2.power=0")
    error = tap.run("build", FLOWERS, "-o", folder / "a.glb", *FEW, *dark, status=1).stderr
    assert "room-flowers.frond:" in error and "[dark-reference]" in error, error
    assert not list(folder.iterdir())


OPEN = """<frond version="1">
  <plant id="a"><lsystem unit="0.05" steps="4">
w : I(?)A
p1 : A -> F(3)R(?,8)I(?)A
p2 : R(r,p) -> \\(r)&amp;(p)/(r)
  </lsystem></plant>
  %s
</frond>
"""


def document(folder, rest):
    path = folder / "a.frond"
    path.write_text(OPEN % rest)
    return path


def steps_are_for_lsystems_beside_species(folder):
    for light in ("", "<light by='views'/>"):
        path = document(folder, f"<plant id='tree'><species/></plant><scene>{light}<place plant='a'/></scene>")
        strings = [tap.run("derive", path, "--steps", n).stdout.splitlines() for n in (1, 3)]
        assert [lines[-1].split(":")[0].rstrip("'") for lines in strings] == ["1", "3"], strings


def what_is_not_placed_is_derived_alone(folder):
    path = document(folder, "<plant id='b'><lsystem>w : A</lsystem></plant><scene><light/><place plant='b'/></scene>")
    did = tap.run("derive", path, "--plant", "a", "--steps", 2)
    assert did.stdout.splitlines()[-1].startswith("2"), did.stdout
    assert "a.frond:" in did.stderr and "[unplaced-plant]" in did.stderr, did.stderr


def grafts_in_the_dark_are_told(folder):
    graft = "<plant id='h'><pgraph><graft id='g' plant='a'/></pgraph></plant><scene>%s<place plant='h'/></scene>"
    assert "unlit-graft" not in tap.run("check", document(folder, graft % "")).stderr
    error = tap.run("check", document(folder, graft % "<light/>")).stderr
    assert "a.frond:7:" in error and "[unlit-graft]" in error, error


def what_is_set_is_checked_as_a_whole(folder):
    path = document(folder, "<scene><light by='views'/><lamp/><place plant='a'/></scene>")
    assert "unseen-lamp" not in tap.run("check", path).stderr
    assert "[unseen-lamp]" in tap.run("check", path, "--set", "light.by=shadows").stderr
    path = document(folder, "<scene><light by='shadows'/><lamp/><place plant='a'/></scene>")
    assert "[unseen-lamp]" in tap.run("check", path).stderr
    assert "unseen-lamp" not in tap.run("check", path, "--set", "light.by=views").stderr


WHITE = """<material id="m" colour="#ffffff"/><scene ground="no" sun-strength="0" sky-strength="0">
<light by="density" photons="1000" bounces="60000"/><lamp at="0.5,0,0.9"/>
<obstacle at="0,0,-0.1" size="2.2,2.2,0.1" material="m"/><obstacle at="0,0,2" size="2.2,2.2,0.1" material="m"/>
<obstacle at="1.05,0,0" size="0.1,2.2,2" material="m"/><obstacle at="-1.05,0,0" size="0.1,2.2,2" material="m"/>
<obstacle at="0,1.05,0" size="2.2,0.1,2" material="m"/><obstacle at="0,-1.05,0" size="2.2,0.1,2" material="m"/>
<place plant="a" at="-0.3,0,1"/></scene>"""


def long_paths_stop_at_the_limit(folder):
    path = document(folder, WHITE)
    told = set()
    for threads in (1, 2):
        told.add(tap.run("build", path, "-o", folder / "a.glb", "--limit", "bytes=10000000", "--threads", threads, status=3).stderr)
    assert len(told) == 1, told
    assert "is 10000000" in told.pop()


TRIANGLE = "mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"


def what_a_mesh_names_must_be_there(folder):
    path = document(folder, "<scene><obstacle shape='mesh' file='t.obj'/><place plant='a'/></scene>")
    (folder / "t.obj").write_text(TRIANGLE % "none.mtl")
    error = tap.run("check", path).stderr
    assert "a.frond:7:" in error and "'none.mtl'" in error and "[missing-file]" in error, error
    (folder / "t.obj").write_text(TRIANGLE % "u.mtl")
    (folder / "u.mtl").write_text("newmtl m\nKd 1 1 1\n")
    assert tap.run("check", path).stderr == ""
    (folder / "u.mtl").write_text("newmtl m\nKd nan 1 1\n")
    assert "[wrong-colour]" in tap.run("check", path).stderr
    (folder / "u.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd none.png\n")
    error = tap.run("check", path, status=1).stderr
    assert "a.frond:7:" in error and "[picture-missing]" in error, error


def long_paths_stop_at_once(folder):
    path = document(folder, WHITE.replace('photons="1000"', 'photons="400"'))
    command = [tap.PROGRAM, "build", path, "-o", folder / "a.glb", "--limit", "bytes=4000000000", "--threads", "1"]
    with subprocess.Popen(command, stderr=subprocess.PIPE) as process:
        time.sleep(0.4)
        process.send_signal(signal.SIGINT)
        began = time.monotonic()
        process.communicate()
        assert process.returncode == -signal.SIGINT, process.returncode
        assert time.monotonic() - began < 2, "it goes on"


TESTS = [
    ("/program/light/long paths stop at once", long_paths_stop_at_once),
    ("/program/light/what a mesh names must be there", what_a_mesh_names_must_be_there),
    ("/program/light/--steps is for L-systems beside species too", steps_are_for_lsystems_beside_species),
    ("/program/light/what is not placed is derived alone", what_is_not_placed_is_derived_alone),
    ("/program/light/grafts that see no light are told of", grafts_in_the_dark_are_told),
    ("/program/light/what is set is checked as a whole", what_is_set_is_checked_as_a_whole),
    ("/program/light/long paths stop at the limit", long_paths_stop_at_the_limit),
    ("/program/light/--stats tells photons, rays and every step", stats_tell_the_light),
    ("/program/light/derive uses the light of the scene", derive_uses_the_light),
    ("/program/light/check does not grow what grows in the light", check_does_not_grow),
    ("/program/light/lamps can be set", lamps_can_be_set),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
