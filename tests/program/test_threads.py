"""The same bits for any number of threads: plants, files, pictures."""

import os
import sys

import frond_tap as tap

# Sanitizers make it some ten times slower, and look for other faults than differing bits: the
# models, which are grown as for their digests, are enough.
IS_SANITIZED = bool(os.environ.get("FROND_SANITIZED"))
THREADS = (1, 3) if IS_SANITIZED else (1, 2, 3, 8)


def same(results):
    assert len(set(results)) == 1, f"for {THREADS} threads: {results}"


def equal_digests(example):
    def test(folder):
        steps = tap.few_steps(example)
        same([tap.statistics(example, *steps, "--threads", n)["digest"] for n in THREADS])
    return test


def equal_models(example):
    # Textures take longest; three examples with them are enough, the others are written without.
    extension = ".glb" if example.stem in ("chestnut", "figure2", "sunflower") else ".ply"

    def test(folder):
        models = []
        for n in THREADS:
            path = folder / f"plant{extension}"
            tap.run("build", example, "-q", "--lod", 2, "--threads", n, "-o", path,
                    *tap.few_steps(example))
            models.append(hash(path.read_bytes()))
        same(models)
    return test


def equal_pictures(example):
    def test(folder):
        pictures = []
        for n in THREADS:
            path = folder / "plant.png"
            tap.run("render", example, "-q", "--size", "48x60", "--samples", 2, "--lod", 3,
                    "--threads", n, "-o", path)
            pictures.append(hash(path.read_bytes()))
        same(pictures)
    return test


def seeds_differ(example):
    def test(folder):
        steps = tap.few_steps(example)
        digests = {tap.statistics(example, *steps, "--seed", seed)["digest"] for seed in (1, 2)}
        assert len(digests) == 2
    return test


TESTS = [(f"/program/threads/{example.stem} has one digest", equal_digests(example))
         for example in tap.EXAMPLES if not IS_SANITIZED or example.stem == "figure2"]
TESTS += [(f"/program/threads/the model of {example.stem} has the same bytes", equal_models(example))
          for example in tap.EXAMPLES]
TESTS += [(f"/program/threads/the picture of {example.stem} has the same bytes", equal_pictures(example))
          for example in tap.EXAMPLES if example.stem in ("agave", "chestnut", "figure2", "sunflower")]
TESTS += [(f"/program/threads/another seed makes another {example.stem}", seeds_differ(example))
          for example in tap.EXAMPLES if example.stem == "chestnut"]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
