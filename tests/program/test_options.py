"""Sequences of pictures, paths for edits, the clock: what render and info do with their options."""

import json
import sys

import frond_tap as tap

GROWING = """<frond version="1">
  <plant id="tree" season="= frac(time)">
    <pgraph>
      <camera id="root"/>
      <tree id="trunk" length="2" radius="0.05" growth="4" number="5"/>
      <horn id="twig" length="0.5" radius="0.02" growth="2"/>
      <hydra id="star" number="3" radius="0"/>
      <leaf id="leaf" length="0.3" width="0.1" growth="1"/>
      <link from="root" to="trunk"/>
      <link from="trunk" to="twig" kind="branch"/>
      <link from="twig" to="star"/>
      <link from="star" to="leaf"/>
    </pgraph>
  </plant>
  <scene frame-time="1"/>
</frond>
"""
SMALL = ("-q", "--size", "16x20", "--samples", 1)


def growing(folder, edits=""):
    path = folder / "growing.frond"
    path.write_text(GROWING.replace("  </plant>", f"{edits}  </plant>"))
    return path


def frames(folder, document, text, *options):
    """The pictures of a sequence by their names."""
    folder.mkdir()
    tap.run("render", document, "-o", folder / "grow.png", "--frames", text, *SMALL, *options)
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def frames_are_named(folder):
    found = frames(folder / "out", growing(folder), "3..6")
    assert sorted(found) == [f"grow-{i:04}.png" for i in range(3, 7)], sorted(found)
    assert len(set(found.values())) == 4, "the plant does not grow"
    assert list(frames(folder / "one", growing(folder), "12345..12345")) == ["grow-12345.png"]


def frames_for_any_threads(folder):
    document = growing(folder)
    assert frames(folder / "1", document, "1..3", "--threads", 1) == \
        frames(folder / "2", document, "1..3", "--threads", 2)


def wrong_frames(folder):
    document = growing(folder)
    for text in ("", "..", "2..1", "-1..2", "1..", "..3", "a..b", "1..2..3", "1.5..2", "0..1000000", "1-3"):
        error = tap.run("render", document, "-o", folder / "grow.png", f"--frames={text}", *SMALL, status=2).stderr
        assert "--frames takes FIRST..LAST" in error, error
    tap.run("render", document, "-o", folder / "none" / "grow.png", "--frames", "0..1", *SMALL, status=4)
    assert [path.name for path in folder.iterdir()] == ["growing.frond"]


def one_warning(folder):
    document = growing(folder, '<edits><edit at="trunk/twig[99]" hide="yes"/></edits>\n')
    error = tap.run("render", document, "-o", folder / "grow.png", "--frames", "1..3", *SMALL[1:]).stderr
    assert error.count("[edit-without-place]") == 1, error


def paths(document, component, *options):
    """The printed paths of the instances of a component."""
    lines = tap.run("info", document, "--paths", component, *options).stdout.splitlines()
    found = [line.strip() for line in lines if "/" in line or line.strip() == component]
    plants = json.loads(tap.run("info", document, "--paths", component, "--json", *options).stdout)["plants"]
    told = [path for plant in plants for path in plant["paths"]]
    assert told and all(path in found for path in told), (told, found)
    return told


def paths_have_places(folder):
    for component, count in (("trunk", 1), ("twig", 5), ("star", 5), ("leaf", 15)):
        told = paths(growing(folder), component, "--time", 9)
        assert len(set(told)) == count, told
        edits = "".join(f'<edit at="{path}" scale="0.5"/>' for path in told)
        edited = growing(folder, f"<edits>{edits}</edits>\n")
        done = tap.run("info", edited, "--json", "--time", 9)
        assert done.stderr == "", done.stderr
        listed = json.loads(done.stdout)["plants"][0]["edits"]
        assert [edit["at"] for edit in listed] == told
        assert all(edit["has_place"] for edit in listed), listed


def one_path_is_one_instance(folder):
    told = paths(growing(folder), "leaf", "--time", 9)
    for path in (told[0], told[-1]):
        edited = growing(folder, f'<edits><edit at="{path}" prune="yes"/></edits>\n')
        rest = paths(edited, "leaf", "--time", 9)
        assert len(rest) == len(told) - 1 and path not in rest


def forked_paths_have_places(folder):
    document = folder / "forked.frond"
    text = GROWING.replace('number="5"', 'number="5" forks="2"')
    document.write_text(text)
    told = paths(document, "twig", "--time", 9)
    assert any("~" in path for path in told), told
    edits = "".join(f'<edit at="{path}" bend="20"/>' for path in told)
    document.write_text(text.replace("  </plant>", f"<edits>{edits}</edits></plant>"))
    listed = json.loads(tap.run("info", document, "--json", "--time", 9).stdout)["plants"][0]["edits"]
    assert len(listed) == len(told) and all(edit["has_place"] for edit in listed), listed


def unknown_component(folder):
    error = tap.run("info", growing(folder), "--paths", "laef", status=2).stderr
    assert "did you mean 'leaf'?" in error, error


def time_is_the_age(folder):
    document = growing(folder)
    digests = [tap.statistics(document, "--time", years)["digest"] for years in (1, 2, 3)]
    assert len(set(digests)) == 3, digests
    by_age = [tap.statistics(document, "--set", f"tree.age={years}", "--set", "tree.season=0")["digest"]
              for years in (1, 2, 3)]
    assert by_age == digests


def frames_begin_at_time(folder):
    document = growing(folder)
    later = frames(folder / "a", document, "0..2", "--time", 2)
    whole = frames(folder / "b", document, "2..4")
    assert [later[f"grow-{i:04}.png"] for i in range(3)] == [whole[f"grow-{i:04}.png"] for i in range(2, 5)]


def wrong_times(folder):
    document = growing(folder)
    for text in ("", "-1", "nan", "inf", "2years", "1e7", "1,5"):
        error = tap.run("info", document, f"--time={text}", status=2).stderr
        assert "--time takes years" in error, (text, error)


TESTS = [
    ("/program/options/frames are named after their numbers", frames_are_named),
    ("/program/options/frames have the same bytes for any number of threads", frames_for_any_threads),
    ("/program/options/a wrong range of frames is refused and leaves nothing", wrong_frames),
    ("/program/options/what all frames lack is warned of once", one_warning),
    ("/program/options/every printed path is a place of an edit", paths_have_places),
    ("/program/options/a path is that of one instance", one_path_is_one_instance),
    ("/program/options/paths on the arms of forks are places of edits", forked_paths_have_places),
    ("/program/options/an unknown component has no paths", unknown_component),
    ("/program/options/time adds to the age of a plant", time_is_the_age),
    ("/program/options/frame 0 stands at the time", frames_begin_at_time),
    ("/program/options/a wrong time is refused", wrong_times),
]

if __name__ == "__main__":
    sys.exit(tap.main(TESTS))
