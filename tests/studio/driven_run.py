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


class Run:
    """One studio for all tests, as a person has one."""

    def __init__(self):
        self.home = tempfile.mkdtemp(prefix="frond-studio-")
        self.display = driver.Display()
        self.studio = driver.Studio(self.display, self.home)
        self.file = os.path.join(self.home, "flower.frond")
        with open(self.file, "w", encoding="utf-8") as file:
            file.write(BEGINNING)
        PICTURES.mkdir(parents=True, exist_ok=True)

    def close(self):
        self.studio.kill()
        self.display.close()
        shutil.rmtree(self.home)

    def picture(self, name):
        self.studio.wait()
        self.studio.ask(f"picture {PICTURES / name}.png")


def is_left(studio, before):
    """Nothing is left of a drag that was cancelled."""
    studio.wait()
    after = studio.state()
    assert after["digest"] == before["digest"] and after["steps"] == before["steps"], after
