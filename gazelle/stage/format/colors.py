"""Colours of X11 by name, as far as files use them."""

from __future__ import annotations

import math
import re

from gazelle.description.material import Color

_NUMBERED = re.compile(r"([a-z]+?)(\d+)")
_SHADES = {1: 1.0, 2: 0.932, 3: 0.804, 4: 0.545}
"""Brightness of the numbered shades in X11's ``rgb.txt``."""
_UNLIKE_CSS = {
    "gray": "#bebebe",
    "grey": "#bebebe",
    "green": "#00ff00",
    "maroon": "#b03060",
    "purple": "#a020f0",
}
_ONLY_X11 = {
    "lightgoldenrod": "#eedd82",
    "lightslateblue": "#8470ff",
    "mediumforestgreen": "#32814b",
    "navyblue": "#000080",
    "violetred": "#d02090",
}


def color_of(name: str) -> Color | None:
    """Return (red, green, blue, alpha) of a name such as ``DarkRed`` or ``light blue``.

    Shades that X11 mixes by hand, such as ``red3``, mostly come out within some hundredths.
    """
    key = name.lower().replace(" ", "").replace("_", "")
    found = _plain(key)
    numbered = _NUMBERED.fullmatch(key)
    if found is not None or numbered is None:
        return found
    base, number = numbered[1], int(numbered[2])
    if base in {"gray", "grey"} and number <= 100:
        level = math.floor(number * 2.55 + 0.5) / 255.0
        return (level, level, level, 1.0)
    whole = _plain(base)
    if whole is None or number not in _SHADES:
        return None
    shade = _SHADES[number]
    return (whole[0] * shade, whole[1] * shade, whole[2] * shade, 1.0)


def _plain(key: str) -> Color | None:
    from PIL import ImageColor

    code = _UNLIKE_CSS.get(key) or _ONLY_X11.get(key) or ImageColor.colormap.get(key)
    if not isinstance(code, str):
        return None
    red, green, blue = ImageColor.getrgb(code)[:3]
    return (red / 255.0, green / 255.0, blue / 255.0, 1.0)
