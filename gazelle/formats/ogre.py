"""OGRE's material scripts, as far as Gazebo's models use them: colours, transparency, one picture.

Format: https://ogrecave.github.io/ogre/api/latest/_material-_scripts.html. Of a material the first
technique, its first pass and the first of its texture units count.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from gazelle.description import Color

MAX_BYTES = 4 * 2**20
_DEPTH = 20
_TOKEN = re.compile(r'"[^"\n]*"|[{}]|[^\s{}]+')
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_PICTURES = "textures"


@dataclass(frozen=True, slots=True)
class ScriptMaterial:
    """Surface appearance given by a script; None for values it does not give.

    Attributes:
        ambient: Colour in ambient light.
        diffuse: Colour in direct light.
        specular: Colour of highlights.
        emissive: Colour it glows with.
        texture: Name of the picture on it; empty for none.
        blended: Whether what is behind shows through, by the diffuse colour's alpha.
    """

    ambient: Color | None = None
    diffuse: Color | None = None
    specular: Color | None = None
    emissive: Color | None = None
    texture: str = ""
    blended: bool = False


@dataclass(frozen=True, slots=True)
class ScriptBlock:
    """A block of a script: words before the brace, and lines and blocks within."""

    head: tuple[str, ...]
    lines: list[tuple[str, ...]] = field(default_factory=list)
    blocks: list[ScriptBlock] = field(default_factory=list)

    def first(self, kind: str) -> ScriptBlock | None:
        """Return the first block of a kind."""
        return next((each for each in self.blocks if each.head[:1] == (kind,)), None)


def find_material(name: str, places: tuple[Path, ...]) -> tuple[ScriptMaterial, Path | None] | None:
    """Return a material by its name, and its picture if there is one.

    Args:
        name: Such as ``Beer/Diffuse``.
        places: Scripts, folders of scripts and folders of pictures, as a file names them.
    """
    for script in _scripts(places):
        found = read_scripts(script).get(name)
        if found is not None:
            return found, _picture(found.texture, script, places)
    return None


def read_scripts(path: Path) -> dict[str, ScriptMaterial]:
    """Read all materials of a script by name; empty for an unreadable file."""
    try:
        about = path.stat()
        return {} if about.st_size > MAX_BYTES else _read(path, about.st_mtime_ns)
    except OSError:
        return {}


@functools.lru_cache(maxsize=64)
def _read(path: Path, _changed: int) -> dict[str, ScriptMaterial]:
    return parse_scripts(path.read_text("utf-8", errors="replace"))


def parse_scripts(text: str) -> dict[str, ScriptMaterial]:
    """Parse all materials of a script's text by name; unknown parts are skipped."""
    blocks = {}
    for block in _parse(text):
        words = [word for word in block.head if word != "abstract"]
        if words[:1] == ["material"] and len(words) > 1:
            name, _, base = " ".join(words[1:]).partition(":")
            blocks[name.strip()] = block, base.strip()
    made: dict[str, ScriptMaterial] = {}
    for name in blocks:
        chain = [name]
        while (base := blocks[chain[-1]][1]) in blocks and base not in chain:
            chain.append(base)
        material = ScriptMaterial()
        for each in reversed(chain):
            material = _refined(material, blocks[each][0])
        made[name] = material
    return made


def _refined(material: ScriptMaterial, block: ScriptBlock) -> ScriptMaterial:
    """Return the material with a block's values over those of its base."""
    values = {line[1]: line[2] for line in block.lines if line[0] == "set" and len(line) > 2}
    technique = block.first("technique")
    shown = technique.first("pass") if technique is not None else None
    for line in block.lines:  # set_texture_alias NAME PICTURE
        if line[0] == "set_texture_alias" and len(line) > 2:
            material = replace(material, texture=line[2])
    if shown is None:
        return material
    for key, *words in shown.lines:
        replaced = [values.get(word, word) for word in words]
        if key in {"ambient", "diffuse", "specular", "emissive"}:
            material = _colored(material, key, _color(key, replaced))
        elif key == "scene_blend":
            material = replace(material, blended=replaced[:1] != ["replace"])
    unit = shown.first("texture_unit")
    for key, *words in unit.lines if unit is not None else ():
        if key == "texture" and words:
            material = replace(material, texture=values.get(words[0], words[0]))
    return material


def _colored(material: ScriptMaterial, key: str, color: Color | None) -> ScriptMaterial:
    if color is None:
        return material
    if key == "ambient":
        return replace(material, ambient=color)
    if key == "diffuse":
        return replace(material, diffuse=color)
    if key == "specular":
        return replace(material, specular=color)
    return replace(material, emissive=color)


def _color(key: str, words: list[str]) -> Color | None:
    """Return three or four numbers.

    Those of a specular colour may be followed by the shininess.
    """
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return None  # vertexcolour, or a word that OGRE would not know either
    if key == "specular" and len(numbers) == len("rgbs"):
        numbers.pop()
    if len(numbers) < len("rgb") or not all(0.0 <= number <= 1e6 for number in numbers):
        return None
    red, green, blue, alpha = (min(1.0, number) for number in (*numbers[:4], 1.0)[:4])
    return (red, green, blue, alpha)


def _parse(text: str) -> list[ScriptBlock]:
    """Return the blocks of a text; braces that do not match end what they can."""
    root = ScriptBlock(())
    stack = [root]
    words: list[str] = []

    def end_line() -> None:
        if words:
            stack[-1].lines.append(tuple(words))
            words.clear()

    for line in _COMMENT.sub(" ", text).splitlines():
        for token in _TOKEN.findall(line):
            if token == "{":  # noqa: S105  # a brace
                head = tuple(words) or (stack[-1].lines.pop() if stack[-1].lines else ())
                words.clear()
                block = ScriptBlock(head)
                if len(stack) < _DEPTH:
                    stack[-1].blocks.append(block)
                stack.append(block)
            elif token == "}":  # noqa: S105  # a brace
                end_line()
                if len(stack) > 1:
                    stack.pop()
            else:
                words.append(token.strip('"'))
        end_line()
    return root.blocks


def _scripts(places: tuple[Path, ...]) -> Iterator[Path]:
    for place in places:
        if place.is_dir():
            yield from sorted(place.glob("*.material"))
        elif place.suffix == ".material":
            yield place


def _picture(name: str, script: Path, places: tuple[Path, ...]) -> Path | None:
    """Return a picture in the named folders, or beside the script as Gazebo's models have it."""
    plain = Path(name).name
    if not plain:
        return None
    folders = [place for place in places if place.is_dir()]
    beside = script.parent, script.parent.parent / _PICTURES, script.parent / _PICTURES
    for folder in (*folders, *beside):
        found = folder / plain
        if found.is_file():
            return found
    return None
