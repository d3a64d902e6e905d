"""Stage files for tests, written where they are used."""

import numpy as np
from PIL import Image

from gazelle.stage.format import load_stage

SQUARE = "points 4 point[0] [0 0] point[1] [2 0] point[2] [2 1] point[3] [0 1]"


def write(folder, text, name="test.world"):
    """Write a file with this text, and return it."""
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    return file


def read(folder, text):
    """Return the world of a text."""
    return load_stage(write(folder, text))


def draw(folder, rows, name="map.png"):
    """Write a picture with walls where the rows have ``#``."""
    pixels = [[0 if mark == "#" else 255 for mark in row] for row in rows]
    Image.fromarray(np.array(pixels, np.uint8)).save(folder / name)
    return name
