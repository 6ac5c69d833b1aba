"""One studio for all driven tests, and the folders they use."""

import os
import pathlib
import shutil
import tempfile

import studio_driver as driver

SOURCE = pathlib.Path(os.environ.get("FROND_SOURCE", "."))
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
    """A folder that is gone in the end, with a studio in it and pictures of what that shows."""

    def __init__(self):
        self.home = tempfile.mkdtemp(prefix="frond-studio-")
        self.studio = None
        PICTURES.mkdir(parents=True, exist_ok=True)

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
