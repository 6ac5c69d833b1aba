"""Drives frond-studio on a display without a screen: commands to its standard input, and a pointer."""

import json
import os
import select
import shutil
import subprocess
import sys
import time
import traceback

ANSWER_SECONDS = 240  # however busy the machine is
MOST_TRIES = 600  # to take a picture, a tenth of a second apart
STUDIO = os.environ.get("FROND_STUDIO", "build/src/studio/frond-studio")


def why_not():
    """Why the studio cannot be driven here, or None."""
    if not os.path.exists(STUDIO):
        return "frond-studio is not built"
    if os.environ.get("FROND_SANITIZED"):
        return "GTK and its drivers are not made for sanitizers"
    for tool in ("Xvfb", "xdotool"):
        if shutil.which(tool) is None:
            return f"{tool} is not installed"
    return None


class Display:
    """An X server of its own, on a number that it finds free."""

    def __init__(self, width=1600, height=1000):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24",
             "-nolisten", "tcp"],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as numbers:
            self.name = ":" + numbers.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *reason):
        self.close()

    def close(self):
        self.server.terminate()
        self.server.wait()


class Bus:
    """A session bus of its own, over which a program tells screen readers what it shows."""

    READER = "/usr/bin/python3"  # Debian's: it has the bindings

    @classmethod
    def why_not(cls):
        """Why nothing can be read here, or None."""
        if shutil.which("dbus-daemon") is None:
            return "dbus-daemon is not installed"
        bindings = "import gi; gi.require_version('Atspi', '2.0'); from gi.repository import Atspi"
        try:
            subprocess.run([cls.READER, "-c", bindings], check=True, stderr=subprocess.DEVNULL)
        except (OSError, subprocess.CalledProcessError):
            return "gir1.2-atspi-2.0 or python3-gi is not installed"
        if not os.path.exists("/usr/share/dbus-1/services/org.a11y.Bus.service"):
            return "at-spi2-core is not installed"
        return None

    def __init__(self, display, home):
        self.environment = dict(os.environ, DISPLAY=display.name, XDG_RUNTIME_DIR=home)
        self.daemon = subprocess.Popen(
            ["dbus-daemon", "--session", "--nofork", "--print-address=1"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=self.environment)
        self.environment["DBUS_SESSION_BUS_ADDRESS"] = self.daemon.stdout.readline().strip()

    def read(self):
        """What is told: a tree of dictionaries for each program."""
        reader = os.path.join(os.path.dirname(os.path.abspath(__file__)), "accessible_tree.py")
        answer = subprocess.run([self.READER, reader], check=True, capture_output=True, text=True,
                                timeout=120, env=self.environment)
        return json.loads(answer.stdout)

    def close(self):
        self.daemon.terminate()
        self.daemon.wait()


class Studio:
    """The program, with settings and recovery in a folder of its own. With a bus it tells screen
    readers what it shows; `variables` are of its environment."""

    def __init__(self, display, home, *arguments, bus=None, variables=None):
        self.environment = dict(
            os.environ, DISPLAY=display.name, GDK_BACKEND="x11", GTK_A11Y="none",
            GSETTINGS_BACKEND="memory", LIBGL_ALWAYS_SOFTWARE="1", LC_ALL="C.UTF-8",
            GSK_RENDERER="cairo", G_DEBUG="fatal-criticals", FROND_STUDIO_ALONE="yes",
            HOME=home, XDG_CONFIG_HOME=os.path.join(home, "config"),
            XDG_STATE_HOME=os.path.join(home, "state"),
            XDG_DATA_HOME=os.path.join(home, "data"))
        if bus is not None:
            self.environment.update(bus.environment, GTK_A11Y="atspi")
        self.environment.update(variables or {})
        self.dense = int(self.environment.get("GDK_SCALE", 1))  # pixels across one of the window
        self.program = subprocess.Popen(
            [STUDIO, "--drive", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True, env=self.environment)

    def ask(self, command):
        """Sends a command and returns its answer; an error is an exception."""
        for _ in range(MOST_TRIES):
            self.program.stdin.write(command + "\n")
            self.program.stdin.flush()
            answer = self.answer(command)
            if answer != "error no picture":
                break
            time.sleep(0.1)  # the window is about to be laid out anew
        if answer == "" or answer.startswith("error"):
            raise AssertionError(f"'{command}' was answered with '{answer}'{self.last_words()}")
        return answer

    def answer(self, command):
        """The next line that is told. Each command gives one, so none is left in the buffer."""
        if not select.select([self.program.stdout], [], [], ANSWER_SECONDS)[0]:
            self.kill()  # what it answers later would be taken for another's
            raise AssertionError(f"'{command}' had no answer within {ANSWER_SECONDS} s")
        return self.program.stdout.readline().strip()

    def last_words(self):
        if self.program.poll() is None:
            return ""
        return "; it ended with " + str(self.program.returncode) + ": " + \
            self.program.stderr.read()[-2000:]

    def wait(self):
        self.ask("wait")

    def state(self):
        return json.loads(self.ask("state"))

    def undo_all(self):
        """Goes back to the first state of the document."""
        while self.state()["steps"] > 0:
            self.ask("do undo")

    def where(self, name):
        return [float(number) for number in self.ask("where " + name).split()]

    def middle(self, name, across=0.5, down=0.5):
        x, y, width, height = self.where(name)
        return x + across * width, y + down * height

    def point(self, *place):
        """Where a point of the scene is seen."""
        return self.where("at:%g,%g,%g" % place)[:2]

    def colour(self, point):
        """Red, green and blue of what is shown there."""
        return [int(part) for part in self.ask("colour %d %d" % tuple(point)).split()]

    def text(self, home):
        """The document as it is now."""
        copy = os.path.join(home, "as-it-is.frond")
        self.ask(f"write {copy}")
        with open(copy, encoding="utf-8") as file:
            return file.read()

    def pointer(self, *words):
        """What a hand does; the program has heard of it afterwards."""
        subprocess.run(["xdotool", *[str(word) for word in words]], check=True,
                       env=self.environment)
        self.ask("hear")

    def go(self, point):
        self.pointer("mousemove", round(self.dense * point[0]), round(self.dense * point[1]))

    def click(self, point):
        self.go(point)
        self.pointer("click", 1)

    def drag(self, begin, end, button=1, steps=8, is_cancelled=False):
        """In steps: one jump may be no drag. Escape may cancel it half way."""
        self.go(begin)
        self.pointer("mousedown", button)
        for step in range(1, steps + 1):
            self.go([a + (b - a) * step / steps for a, b in zip(begin, end)])
            if is_cancelled and step == (steps + 1) // 2:
                self.wait()  # the change is seen
                self.pointer("key", "Escape")
        self.pointer("mouseup", button)

    def quit(self):
        self.ask("quit")
        self.program.stdin.close()
        return self.program.wait(timeout=ANSWER_SECONDS)

    def kill(self):
        self.program.kill()
        self.program.wait()


def main(tests, make_run, reason):
    """Runs the tests, or tells the reason why they cannot be; `make_run` makes what they share."""
    if reason is not None:
        print(f"1..0 # SKIP {reason}")
    else:
        run_tests(tests, make_run())


def run_tests(tests, run):
    """Tells in TAP how each test went; `run` is what they are handed."""
    print(f"1..{len(tests)}", flush=True)
    try:
        for number, test in enumerate(tests, 1):
            try:
                test(run)
                print(f"ok {number} {test.__doc__}", flush=True)
            except Exception:  # the next ones may well work
                print(f"not ok {number} {test.__doc__}")
                for line in traceback.format_exc().splitlines():
                    print("# " + line)
                sys.stdout.flush()
    finally:
        run.close()
