"""Every glTF file we write passes the Khronos validator with no errors and no warnings."""

import json
import shutil
import subprocess
import sys

import frond_tap as tap

INTEROP = tap.SOURCE / "tests" / "interop"


def validate(path):
    if shutil.which("node") is None:
        raise tap.Skip("node is not installed")
    if not (INTEROP / "node_modules" / "gltf-validator").is_dir():
        raise tap.Skip("gltf-validator is not installed")
    done = subprocess.run(["node", str(INTEROP / "validate.mjs"), str(path)],
                          capture_output=True, text=True, check=True)
    report = json.loads(done.stdout)
    assert report["errors"] == 0 and report["warnings"] == 0, report
    return report


def valid(example, extension, leaves, lod):
    def test(folder):
        path = folder / f"plant{extension}"
        stats = tap.statistics(example, "--leaves", leaves, "--lod", lod, "-o", path,
                               *tap.few_steps(example))
        report = validate(path)
        # The validator counts a shared mesh once, the statistics as often as it is drawn.
        if leaves == "merged" and stats["plants"] == 1:
            assert report["triangles"] == stats["triangles"], (report, stats)
    return test


def broken_is_noticed(folder):
    """The validator itself works: it refuses a file that is cut off."""
    path = folder / "plant.glb"
    tap.run("build", tap.EXAMPLES[0], "-q", "--lod", 3, "-o", path)
    path.write_bytes(path.read_bytes()[:-8])
    try:
        validate(path)
    except AssertionError:
        return
    raise AssertionError("the validator passed a file that is cut off")


TESTS = [("/interop/validator/a file that is cut off is refused", broken_is_noticed)]
for example in tap.EXAMPLES:
    # The largest examples say at full detail what the chestnut says.
    lod = 2 if example.stem in ("maple", "willow") else 0
    TESTS.append((f"/interop/validator/{example.stem} at level of detail {lod} is valid",
                  valid(example, ".glb", "merged", lod)))
    if example.stem not in ("chestnut", "figure2", "sunflower"):
        continue
    for leaves in ("nodes", "gpu"):
        TESTS.append((f"/interop/validator/{example.stem} with leaves as {leaves} is valid",
                      valid(example, ".glb", leaves, 3)))
    TESTS.append((f"/interop/validator/{example.stem} as .gltf is valid",
                  valid(example, ".gltf", "merged", 3)))

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
