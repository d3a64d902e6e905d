"""Write the functions that turn bytes into a message.

Every length is checked against the bytes at hand before anything is made from it; slices cannot
run over the end, so one check after the last of them is enough.
"""

from __future__ import annotations

import struct

from gazelle_ros.messages.base import Message
from gazelle_ros.messages.emit import GeneratedCode, fixed_codes
from gazelle_ros.messages.encode import LazyFunction
from gazelle_ros.messages.spec import OCTETS, STRUCT_CODES, Field, MessageSpec

_TIME_CODES = {"time": "I", "duration": "i"}
MODES = ("plain", "numpy", "arrays", "lossy")
"""``plain``: tuples and bytes; ``numpy``: numpy arrays, but bytes for octets, as genpy; ``arrays``:
numpy arrays for octets too; ``lossy``: as plain, replacing what is not UTF-8."""

_MOST_EMPTY_ELEMENTS = 1 << 16


class DecoderWriter:
    """Writes the body of a decoder that reads from ``data``, of ``size`` bytes.

    Args:
        code: Takes the lines.
        known: The class of each message type in the fields, at any depth.
        mode: One of `MODES`.
        start: Local that holds where the message begins; empty for 0.
    """

    def __init__(
        self, code: GeneratedCode, known: dict[str, type[Message]], mode: str, start: str = ""
    ) -> None:
        self._code = code
        self._known = known
        self._mode = mode
        self._base = start
        self._offset = 0
        self._codes = ""
        self._targets: list[str] = []
        self.sliced = False
        """True if the last thing read was a slice, which may run over the end unnoticed."""

    def position(self, extra: int = 0) -> str:
        """Return an expression for the position of the next byte, plus ``extra``."""
        offset = self._offset + extra
        if not self._base:
            return str(offset)
        return f"{self._base} + {offset}" if offset else self._base

    def message(self, spec: MessageSpec, owner: str) -> None:
        """Decode all fields of the message in the local ``owner``."""
        for field in spec.fields:
            self._field(field, f"{owner}.{field.attribute}")

    def flush(self) -> None:
        """Unpack the numbers that are pending."""
        if not self._codes:
            return
        unpack = self._code.struct(self._codes, "unpack_from")
        self._code.line(f"({', '.join(self._targets)},) = {unpack}(data, {self.position()})")
        self._offset += struct.calcsize("<" + self._codes)
        self._codes, self._targets = "", []
        self.sliced = False

    def _number(self, codes: str, *targets: str) -> None:
        self._codes += codes
        self._targets.extend(targets)

    def _length(self) -> str:
        """Read a length now, and return the local that holds it."""
        length = self._code.variable("n")
        self._number("I", length)
        self.flush()
        return length

    def _slice(self, length: str) -> str:
        """Move on by a length that only the message knows; returns the slice's expression."""
        end = self._code.variable("p")
        begin = self.position()
        self._code.line(f"{end} = {begin} + {length}")
        self._base, self._offset = end, 0
        self.sliced = True
        return f"data[{begin}:{end}]"

    def _field(self, field: Field, target: str) -> None:
        if field.is_array:
            self._array(field, target)
        elif field.base == "string":
            piece = self._slice(self._length())
            self._code.line(f"{target} = {self._text(piece)}")
        elif field.base in _TIME_CODES:
            local = self._code.variable()
            self._code.line(f"{local} = {target} = _new(_{field.base.capitalize()})")
            self._number(_TIME_CODES[field.base] * 2, f"{local}.secs", f"{local}.nsecs")
        elif field.is_message:
            local = self._code.variable()
            cls = self._code.message_class(field.base, self._known)
            self._code.line(f"{local} = {target} = _new({cls})")
            self.message(self._known[field.base]._spec, local)
        else:
            self._number(_read_code(field.base), target)

    def _text(self, piece: str) -> str:
        if self._mode == "plain":
            return f"{piece}.decode()"
        if self._mode == "lossy":
            return f"{piece}.decode(errors='replace')"
        return f"bytes({piece}).decode(errors='replace')"

    def _array(self, field: Field, target: str) -> None:
        if field.base in OCTETS:
            self._octets(field, target)
        elif field.base in STRUCT_CODES:
            self._numbers(field, target)
        elif field.base == "string":
            self._strings(field, target)
        else:
            self._elements(field, target)

    def _octets(self, field: Field, target: str) -> None:
        self.flush()
        length = str(field.length) if field.length is not None else self._length()
        if self._mode == "arrays":
            self._array_view(target, "uint8", length, 1)
            return
        piece = self._slice(length)
        self._code.line(f"{target} = {piece if self._mode != 'numpy' else f'bytes({piece})'}")

    def _numbers(self, field: Field, target: str) -> None:
        code = _read_code(field.base)
        width = struct.calcsize("<" + code)
        self.flush()
        length = str(field.length) if field.length is not None else self._length()
        if self._mode in {"numpy", "arrays"}:
            self._array_view(target, field.base, length, width)
            return
        if field.length is None:
            begin = self.position()
            self._advance(length, width)
            value = f"_unpackers_{_word(code)}[{length}](data, {begin})"
        else:
            unpack = self._code.struct(f"{length}{code}", "unpack_from")
            value = f"{unpack}(data, {self.position()})"
            self._offset += field.length * width
            self.sliced = False
        self._code.line(f"{target} = {f'[*{value}]' if field.base == 'bool' else value}")

    def _array_view(self, target: str, base: str, length: str, width: int) -> None:
        begin = self.position()
        self._advance(length, width)
        self._code.line(f"{target} = _view(data, {base!r}, {length}, {begin})")

    def _advance(self, length: str, width: int) -> None:
        """Move on by an array, and check that its bytes are there."""
        end = self._code.variable("p")
        factor = f"{width} * {length}" if width != 1 else length
        self._code.line(f"{end} = {self.position()} + {factor}")
        self._code.line(f"if {end} > size: _too_short({end}, size)")
        self._base, self._offset = end, 0
        self.sliced = False

    def _loop_over(self, field: Field, target: str) -> tuple[str, str, str]:
        """Return locals for the list, the number of elements, and the position in a loop."""
        self.flush()
        length = str(field.length) if field.length is not None else self._length()
        values = self._code.variable()
        self._code.line(f"{values} = {target} = []")
        return values, length, self._code.variable("p")

    def _strings(self, field: Field, target: str) -> None:
        values, length, place = self._loop_over(field, target)
        unpack = self._code.struct("I", "unpack_from")
        self._code.line(f"{place} = {self.position()}")
        with self._code.block(f"for _ in range({length}):"):
            self._code.line(f"(n,) = {unpack}(data, {place})")
            self._code.line(f"q = {place} + 4")
            self._code.line(f"{place} = q + n")
            self._code.line(f"{values}.append({self._text(f'data[q:{place}]')})")
        self._base, self._offset, self.sliced = place, 0, True

    def _elements(self, field: Field, target: str) -> None:
        values, length, place = self._loop_over(field, target)
        codes = self._element_codes(field)
        if codes == "":
            self._code.line(f"if {length} > {_MOST_EMPTY_ELEMENTS}: _too_many({length})")
        if codes is None:
            self._varying_elements(field, values, length, place)
            return
        width = struct.calcsize("<" + codes)
        begin = self.position()
        self._advance(length, width)
        if not width:
            cls = self._code.message_class(field.base, self._known)
            self._code.line(f"{values} += [{cls}() for _ in range({length})]")
            return
        unpack = self._code.struct(codes, "iter_unpack")
        with self._code.block(f"for t in {unpack}(data[{begin}:{self._base}]):"):
            targets: list[str] = []
            self._make_element(field, "m", targets)
            self._code.line(f"({', '.join(targets)},) = t")
            self._code.line(f"{values}.append(m)")

    def _varying_elements(self, field: Field, values: str, length: str, place: str) -> None:
        self._code.line(f"{place} = {self.position()}")
        cls = self._code.message_class(field.base, self._known)
        name = f"_reader_{self._mode}_{field.base.replace('/', '__')}"
        later = LazyFunction(self._known[field.base], f"_read_{self._mode}", self._code, name)
        self._code.names.setdefault(name, later)
        with self._code.block(f"for _ in range({length}):"):
            self._code.line(f"m = _new({cls})")
            self._code.line(f"{place} = {name}(m, data, {place}, size)")
            self._code.line(f"{values}.append(m)")
        self._base, self._offset, self.sliced = place, 0, True

    def _element_codes(self, field: Field) -> str | None:
        if field.base in _TIME_CODES:
            return _TIME_CODES[field.base] * 2
        spec = self._known[field.base]._spec
        if _has_octets(spec, self._known):
            return None
        codes = fixed_codes(spec, self._known)
        return codes if codes is None else _read_codes(spec, self._known)

    def _make_element(self, field: Field, local: str, targets: list[str]) -> None:
        """Create the objects of an element, and collect the targets of its numbers."""
        if field.base in _TIME_CODES:
            self._code.line(f"{local} = _new(_{field.base.capitalize()})")
            targets += [f"{local}.secs", f"{local}.nsecs"]
            return
        cls = self._code.message_class(field.base, self._known)
        self._code.line(f"{local} = _new({cls})")
        for each in self._known[field.base]._spec.fields:
            if each.is_message or each.base in _TIME_CODES:
                inner = self._code.variable("m")
                self._make_element(each, inner, targets)
                self._code.line(f"{local}.{each.attribute} = {inner}")
            else:
                targets.append(f"{local}.{each.attribute}")


def write_deserialize(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]]
) -> str:
    """Write the source of ``deserialize(self, data, numpy=False)``, by default plain."""
    code.line("if numpy: return self._decode_arrays(data)")
    code.line("if type(data) is not bytes: data = bytes(data)")
    _write_guarded(spec, code, known, "plain")
    return code.source("def deserialize(self, data, numpy=False):")


def write_decoder(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]], mode: str
) -> str:
    """Write the source of ``_decode_MODE(self, data)``, which returns the message."""
    _write_guarded(spec, code, known, mode)
    return code.source(f"def _decode_{mode}(self, data):")


def _write_guarded(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]], mode: str
) -> None:
    with code.block("try:"):
        _write_body(spec, code, known, mode)
    if mode == "plain":
        with code.block("except UnicodeDecodeError:"):
            code.line("_warn_once(self._type)")
            code.line("return self._decode_lossy(data)")
    with code.block("except _struct_error as err:"):
        code.line("raise _DeserializationError(str(err)) from err")


def _write_body(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]], mode: str
) -> None:
    code.line("size = len(data)")
    decoder = DecoderWriter(code, known, mode)
    decoder.message(spec, "self")
    decoder.flush()
    if decoder.sliced:
        code.line(f"if {decoder.position()} > size: _too_short({decoder.position()}, size)")
    for field in spec.fields:
        if not field.is_array and field.base in _TIME_CODES:
            time = f"self.{field.attribute}"
            code.line(f"if not 0 <= {time}.nsecs < 1000000000: {time}.canon()")
    code.line("return self")


def write_element_decoder(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]], mode: str
) -> str:
    """Write the source of ``_read_MODE(self, data, place, size)``.

    It returns the message's end.
    """
    decoder = DecoderWriter(code, known, mode, start="place")
    decoder.message(spec, "self")
    decoder.flush()
    code.line(f"return {decoder.position()}")
    return code.source(f"def _read_{mode}(self, data, place, size):")


def _read_code(base: str) -> str:
    return "?" if base == "bool" else STRUCT_CODES[base]


def _read_codes(spec: MessageSpec, known: dict[str, type[Message]]) -> str:
    codes = ""
    for field in spec.fields:
        if field.base in _TIME_CODES:
            codes += _TIME_CODES[field.base] * 2
        elif field.is_message:
            codes += _read_codes(known[field.base]._spec, known)
        else:
            codes += _read_code(field.base)
    return codes


def _has_octets(spec: MessageSpec, known: dict[str, type[Message]]) -> bool:
    return any(
        field.is_array or (field.is_message and _has_octets(known[field.base]._spec, known))
        for field in spec.fields
    )


def _word(code: str) -> str:
    """Return a struct code as part of a name."""
    return "bool" if code == "?" else code
