"""Prints what a screen reader is told of a program, as JSON: run by Debian's Python, which has its library."""

import json
import sys

import gi

gi.require_version("Atspi", "2.0")
from gi.repository import Atspi  # noqa: E402, the version is set above


def told(node):
    states = node.get_state_set()
    children = [node.get_child_at_index(i) for i in range(node.get_child_count())]
    return {
        "role": node.get_role_name(),
        "name": node.get_name(),
        "description": node.get_description(),
        "focusable": states.contains(Atspi.StateType.FOCUSABLE),
        "children": [told(child) for child in children if child is not None],
    }


desktop = Atspi.get_desktop(0)
programs = [desktop.get_child_at_index(i) for i in range(desktop.get_child_count())]
json.dump([told(program) for program in programs if program is not None], sys.stdout)
