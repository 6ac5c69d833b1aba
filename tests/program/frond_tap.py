"""What the tests of the whole program share: running it, and TAP.

The environment names the program (FROND_PROGRAM) and the source folder (FROND_SOURCE).
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import traceback

PROGRAM = os.environ["FROND_PROGRAM"]
SOURCE = pathlib.Path(os.environ["FROND_SOURCE"])
os.environ.setdefault("FROND_DATA", str(SOURCE / "data"))  # the build may be anywhere
LIMIT = 900 if "FROND_SANITIZED" in os.environ else 300  # seconds; what takes longer hangs
EXAMPLES = sorted((SOURCE / "examples").glob("*.frond"))


class Skip(Exception):
    """Raised by a test that cannot run here, with the reason."""


def run(*arguments, status=0):
    """Runs the program, expects an exit status, returns the finished process."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=LIMIT)
    assert done.returncode == status, (
        f"frond {' '.join(map(str, arguments))}: exit {done.returncode}, not {status}\n{done.stderr}")
    return done


def statistics(*arguments):
    """The statistics of a build as a dict."""
    return json.loads(run("build", *arguments, "--stats", "-").stdout)


def few_steps(example):
    """Options with which a document that grows bud by bud is soon done."""
    return ("--steps", 7) if "<growth" in example.read_text(encoding="utf-8") else ()


def main(tests):
    """Runs (name, function of a folder) pairs, each in a folder of its own, and prints TAP."""
    print(f"1..{len(tests)}", flush=True)
    failed = 0
    for number, (name, test) in enumerate(tests, 1):
        with tempfile.TemporaryDirectory(prefix="frond-") as folder:
            try:
                test(pathlib.Path(folder))
                print(f"ok {number} {name}", flush=True)
            except Skip as reason:
                print(f"ok {number} {name} # SKIP {reason}", flush=True)
            except Exception:  # whatever goes wrong is the test's failure
                failed += 1
                print(f"not ok {number} {name}", flush=True)
                traceback.print_exc(file=sys.stderr)
    return 1 if failed else 0
