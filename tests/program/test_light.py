"""Plants that grow in the light: what derive, check and --stats tell of them."""

import json
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


TESTS = [
    ("/program/light/--stats tells photons, rays and every step", stats_tell_the_light),
    ("/program/light/derive uses the light of the scene", derive_uses_the_light),
    ("/program/light/check does not grow what grows in the light", check_does_not_grow),
    ("/program/light/lamps can be set", lamps_can_be_set),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
