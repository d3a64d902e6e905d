"""The properties of an entity by type, in SI units and radians, and those never read."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from gazelle.errors import did_you_mean
from gazelle.formats.reading import Reading
from gazelle.stage.description.models import StageColor, StagePose, StageSize
from gazelle.stage.format.colors import color_of
from gazelle.stage.format.entity import Entity, Property
from gazelle.stage.format.lexer import Value

LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
ANGLES = {"degrees": math.pi / 180.0, "radians": 1.0}

MAX_NUMBER = 1e9
"""Greatest length, angle or count that makes sense; files hold 999999 for 'very much'."""


@dataclass(slots=True)
class Units:
    """Metres and radians in the units of a file."""

    length: float = LENGTHS["m"]
    angle: float = ANGLES["degrees"]

    def factor(self, code: str) -> float:
        """Return a field's factor.

        ``l`` is a length, ``a`` an angle, ``d`` always degrees, ``f`` a number.
        """
        return {"l": self.length, "a": self.angle, "d": ANGLES["degrees"]}.get(code, 1.0)


@dataclass(slots=True)
class Properties:
    """Reads the properties of one entity; requested names are recorded.

    Attributes:
        entity: Owner.
        reading: Takes remarks.
        units: Of the file.
        own: Read only what stands in the entity itself, not in its macros.
    """

    entity: Entity
    reading: Reading
    units: Units
    own: bool = False
    _all: Mapping[str, Property] = field(init=False)
    _known: set[str] = field(default_factory=set, init=False)

    def __post_init__(self) -> None:
        self._all = self.entity.own if self.own else self.entity.properties

    def has(self, name: str) -> bool:
        """Return whether there is one of this name."""
        return self.get(name) is not None

    def get(self, name: str) -> Property | None:
        """Return a property by name."""
        self._known.add(name)
        return self._all.get(name)

    def matching(self, prefix: str) -> list[Property]:
        """Return all properties with this prefix."""
        found = [each for name, each in self._all.items() if name.startswith(prefix)]
        self._known.update(each.name for each in found)
        return found

    def number(self, name: str, default: float, code: str = "f") -> float:
        """Return a number; ``code`` is that of its unit, see ``Units``."""
        entry = self.get(name)
        return default if entry is None else _number(entry, entry.value) * self.units.factor(code)

    def length(self, name: str, default: float) -> float:
        """Return a length [m]; not negative."""
        entry = self.get(name)
        if entry is None:
            return default
        value = self.number(name, default, "l")
        if value < 0.0:
            raise entry.fail(f"'{name}' must not be negative, found {value:g}")
        return value

    def angle(self, name: str, default: float) -> float:
        """Return an angle [rad]."""
        return self.number(name, default, "a")

    def whole(self, name: str, default: int, least: int | None = None) -> int:
        """Return an int; a fraction is cut off, as in Stage."""
        entry = self.get(name)
        if entry is None:
            return default
        value = int(_number(entry, entry.value))
        if least is not None and value < least:
            raise entry.fail(f"'{name}' must be at least {least}, found {value}")
        return value

    def flag(self, name: str, *, default: bool) -> bool:
        """Return whether a number is not 0."""
        return bool(self.whole(name, int(default)))

    def text(self, name: str, default: str = "") -> str:
        """Return a string."""
        entry = self.get(name)
        if entry is None:
            return default
        value = entry.value
        if not isinstance(value, str):
            raise entry.fail(f"'{name}' must be a string in quotes, found {entry.token.text}")
        return value

    def choice(self, name: str, options: tuple[str, ...], default: str) -> str:
        """Return one of some strings."""
        value = self.text(name, default)
        entry = self.get(name)
        if value not in options and entry is not None:
            raise entry.fail(f"'{name}' cannot be '{value}'", did_you_mean(value, options))
        return value

    def numbers(self, name: str, codes: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return a tuple of numbers, one for each code of a unit; more are left out, as in Stage.

        Raises:
            FormatError: It is shorter, or holds something else.
        """
        entry = self.get(name)
        if entry is None:
            return default
        items = items_of(entry, entry.value)
        if len(items) < len(codes):
            raise entry.fail(
                f"'{name}' must have {len(codes)} numbers, found {entry.token.text}",
                hint="Stage 4 rejects this too",
            )
        return tuple(
            _number(entry, item) * self.units.factor(code)
            for item, code in zip(items, codes, strict=False)
        )

    def pose(self, name: str, default: StagePose | None = None) -> StagePose:
        """Return x, y, z and heading."""
        return StagePose(*self.numbers(name, "llla", default or StagePose()))

    def size(self, name: str, default: StageSize) -> StageSize:
        """Return three lengths, none negative."""
        values = self.numbers(name, "lll", default)
        entry = self.get(name)
        if entry is not None and min(values) < 0.0:
            raise entry.fail(f"'{name}' must not be negative, found {entry.token.text}")
        return StageSize(*values)

    def color(self) -> StageColor | None:
        """Return (red, green, blue, alpha), ``random``, or None; a name precedes numbers."""
        named, mixed = self.get("color"), self.get("color_rgba")
        if mixed is not None and named is None:
            red, green, blue, alpha = self.numbers("color_rgba", "ffff", (0.0,) * 4)
            return (red, green, blue, alpha)
        if named is None:
            return None
        name = self.text("color")
        if not name:
            return None
        if name == "random":
            return "random"
        found = color_of(name)
        if found is None:
            self.reading.remark(f"'{name}' is not an X11 color; using red", named.source)
        return found or (1.0, 0.0, 0.0, 1.0)

    def note(self, name: str, message: str, hint: str | None = None) -> None:
        """Warn of a property if it is present."""
        entry = self.get(name)
        if entry is not None:
            self.reading.remark(message, entry.source, hint)

    def report_unknown(self) -> None:
        """Warn of each property that was never read."""
        for name, entry in self._all.items():
            if name not in self._known:
                self.reading.remark(
                    f"'{name}' is not a property of a {self.entity.type}, and ignored",
                    entry.source,
                    _suggestion(name, self._known),
                )


def _suggestion(name: str, known: set[str]) -> str | None:
    hint = did_you_mean(name, known)
    return hint if hint.startswith("did you") else None


def items_of(entry: Property, value: Value) -> tuple[float | str, ...]:
    """Return the items of a tuple.

    Raises:
        FormatError: It is none.
    """
    if not isinstance(value, tuple):
        raise entry.fail(f"'{entry.name}' must be a tuple in brackets, found {entry.token.text}")
    return value


def _number(entry: Property, value: Value) -> float:
    if not isinstance(value, float):
        raise entry.fail(f"expected a number in '{entry.name}', found {entry.token.text}")
    if not abs(value) <= MAX_NUMBER:
        raise entry.fail(f"'{entry.name}' is out of range: {value:g}")
    return value
