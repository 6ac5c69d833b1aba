"""frond vary: a folder of instances, a scene of all, a sheet of pictures."""

import struct
import sys

import frond_tap as tap

EXAMPLE = tap.SOURCE / "examples" / "collection.frond"
SMALL = ("-q", "--lod", 3, "--size", "12x15", "--samples", 1)


def size_of_png(path):
    return struct.unpack(">II", path.read_bytes()[16:24])


def seven_instances(folder):
    tap.run("vary", EXAMPLE, "-o", folder / "out", *SMALL)
    names = sorted(path.name for path in (folder / "out").iterdir())
    assert names == sorted([f"drawn-{i}.glb" for i in range(1, 8)] + ["drawn.glb", "drawn.png"]), names
    models = {(folder / "out" / f"drawn-{i}.glb").read_bytes() for i in range(1, 8)}
    assert len(models) == 7, "two instances are equal"
    assert size_of_png(folder / "out" / "drawn.png") == (7 * 12, 15)


def same_for_any_threads(folder):
    found = set()
    for threads in (1, 3, 8):
        out = folder / str(threads)
        tap.run("vary", EXAMPLE, "--count", 3, "--threads", threads, "-o", out, *SMALL)
        found.add(tuple(hash(path.read_bytes()) for path in sorted(out.iterdir())))
    assert len(found) == 1


def an_instance_is_that_of_its_seed(folder):
    tap.run("vary", EXAMPLE, "--count", 3, "--seed", 5, "-o", folder / "a", *SMALL)
    tap.run("vary", EXAMPLE, "--count", 1, "--seed", 7, "-o", folder / "b", *SMALL)
    third = (folder / "a" / "drawn-3.glb").read_bytes()
    # Pictures within a model are named after its file.
    assert third.replace(b"drawn-3-", b"drawn-1-") == (folder / "b" / "drawn-1.glb").read_bytes()


def plain_plants_vary_too(folder):
    tap.run("vary", EXAMPLE, "--plant", "tree", "--count", 2, "-o", folder, *SMALL)
    assert (folder / "tree-2.glb").exists()


def surfaces(folder):
    tap.run("vary", EXAMPLE, "--count", 1, "-o", folder / "plain", *SMALL)
    tap.run("vary", EXAMPLE, "--count", 1, "-o", folder / "round", *SMALL, "--nurbs", "foliage=no")
    for name in ("drawn-1.glb", "drawn.glb", "drawn.png"):
        assert (folder / "plain" / name).read_bytes() != (folder / "round" / name).read_bytes(), name


def mistakes(folder):
    assert "folder" in tap.run("vary", EXAMPLE, status=2).stderr
    assert "'drawn'" in tap.run("vary", EXAMPLE, "--plant", "drwn", "-o", folder, status=2).stderr
    tap.run("vary", EXAMPLE, "--count", 0, "-o", folder, status=2)
    tap.run("vary", EXAMPLE, "--limit", "plants=3", "-o", folder / "none", *SMALL, status=3)
    assert not (folder / "none").exists()
    (folder / "file").write_text("")
    tap.run("vary", EXAMPLE, "-o", folder / "file", *SMALL, status=4)


TESTS = [
    ("/program/vary/seven instances, a scene and a sheet", seven_instances),
    ("/program/vary/the same files for any number of threads", same_for_any_threads),
    ("/program/vary/an instance is that of its seed", an_instance_is_that_of_its_seed),
    ("/program/vary/a plant without strokes varies by the defaults", plain_plants_vary_too),
    ("/program/vary/instances are shown as surfaces if that is asked for", surfaces),
    ("/program/vary/mistakes leave nothing behind", mistakes),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
