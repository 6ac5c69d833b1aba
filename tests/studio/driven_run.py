"""One studio for all driven tests, and the folders they use."""

import contextlib
import os
import pathlib
import shutil
import tempfile

import studio_driver as driver

SOURCE = pathlib.Path(os.environ.get("FROND_SOURCE", "."))
MOST_LOOKS = 600  # at what has yet to appear, each after pictures that the program has drawn
PICTURES = pathlib.Path(os.environ.get("FROND_PICTURES", "build/studio-pictures"))


BEGINNING = """<?xml version="1.0" encoding="UTF-8"?>
<frond version="1">
  <!-- a stem -->
  <material id="green" texture="leaf" colour="#4f7a2c" size="64"/>
  <curve id="thick" points="0,1 0.5,0.6 1,0.2"/>
  <plant id="flower" seed="1">
    <pgraph>
      <camera id="root"/>
      <horn id="stem" length="0.6" radius="0.01"/>
      <link from="root" to="stem"/>
    </pgraph>
  </plant>
</frond>
"""


class Home:
    """A folder that is gone in the end, with a studio in it and pictures of what that shows. Nothing
    moves by itself: what is there can be clicked."""

    def __init__(self):
        self.home = tempfile.mkdtemp(prefix="frond-studio-")
        self.studio = None
        PICTURES.mkdir(parents=True, exist_ok=True)
        settings = os.path.join(self.home, "config", "gtk-4.0")
        os.makedirs(settings)
        with open(os.path.join(settings, "settings.ini"), "w", encoding="utf-8") as file:
            file.write("[Settings]\ngtk-enable-animations=0\n")

    def write(self, name, text):
        """Writes a document, and returns its file."""
        path = os.path.join(self.home, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def open(self, path):
        self.studio.ask(f"open {path}")
        self.studio.wait()

    def open_text(self, name, text):
        self.open(self.write(name, text))

    def picture(self, name):
        self.studio.wait()
        self.studio.ask(f"picture {PICTURES / name}.png")

    def look(self, command, is_it):
        """Asks until the answer is right, and returns it."""
        for _ in range(MOST_LOOKS):
            try:
                answer = self.studio.ask(command)
            except AssertionError as error:
                answer = str(error)
            if is_it(answer):
                return answer
            self.studio.ask("hear")
        raise AssertionError(f"'{command}' is still answered with '{answer}'")

    def appears(self, name):
        """Where something is, once it is there and stays at its place."""
        last = self.look(f"where {name}", lambda answer: "error" not in answer)
        for _ in range(MOST_LOOKS):
            self.studio.ask("hear")
            now = self.look(f"where {name}", lambda answer: "error" not in answer)
            if now == last:
                return self.studio.middle(name)
            last = now
        raise AssertionError(f"{name} does not come to rest")

    def click(self, name):
        """A hand is not as fast as xdotool, whose press and release are one for GTK's menus."""
        self.studio.go(self.appears(name))
        self.studio.pointer("mousedown", 1)
        self.studio.pointer("mouseup", 1)

    def is_there(self, name):
        try:
            return bool(self.studio.where(name))
        except AssertionError:
            return False

    def opens(self, button, name):
        """Lets a button pop something up, again if the click met what was just going away."""
        for _ in range(20):
            self.click(button)
            for _ in range(20):
                if self.is_there(name):
                    return
                self.studio.ask("hear")
        raise AssertionError(f"{button} shows no {name}")

    @contextlib.contextmanager
    def messages_stay(self):
        """What is said meanwhile stays, as a busy machine would not read it in time."""
        self.studio.ask("stay")
        yield
        self.studio.ask("stay no")

    def close(self):
        shutil.rmtree(self.home)


class Run(Home):
    """One studio for all tests, as a person has one."""

    def __init__(self):
        super().__init__()
        self.display = driver.Display()
        self.studio = driver.Studio(self.display, self.home)
        self.file = self.write("flower.frond", BEGINNING)

    def close(self):
        self.studio.kill()
        self.display.close()
        super().close()


def is_left(studio, before):
    """Nothing is left of a drag that was cancelled."""
    studio.wait()
    after = studio.state()
    assert after["digest"] == before["digest"] and after["steps"] == before["steps"], after
