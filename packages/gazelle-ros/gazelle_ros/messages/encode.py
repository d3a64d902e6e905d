"""Write the function that turns a message into bytes.

Numbers that follow each other are packed by one struct, and small pieces are joined before they
are written.
"""

from __future__ import annotations

from gazelle_ros.messages.base import Message
from gazelle_ros.messages.emit import GeneratedCode, fixed_codes
from gazelle_ros.messages.spec import OCTETS, STRUCT_CODES, Field, MessageSpec

_TIME_CODES = {"time": "I", "duration": "i"}


class EncoderWriter:
    """Writes the body of an encoder; the local ``w`` writes bytes.

    Args:
        code: Takes the lines.
        known: The class of each message type in the fields, at any depth.
    """

    def __init__(self, code: GeneratedCode, known: dict[str, type[Message]]) -> None:
        self._code = code
        self._known = known
        self._codes = ""
        self._values: list[str] = []
        self._pieces: list[str] = []

    def message(self, spec: MessageSpec, owner: str) -> None:
        """Encode all fields of the message in the local ``owner``."""
        for field in spec.fields:
            self._field(field, f"{owner}.{field.attribute}")

    def flush(self) -> None:
        """Write pending fields."""
        self._close_struct()
        if len(self._pieces) == 1:
            self._code.line(f"w({self._pieces[0]})")
        elif len(self._pieces) == 2:
            self._code.line(f"w({self._pieces[0]} + {self._pieces[1]})")
        elif self._pieces:
            self._code.line(f"w(b''.join(({', '.join(self._pieces)})))")
        self._pieces = []

    def _close_struct(self) -> None:
        if self._codes:
            pack = self._code.struct(self._codes, "pack")
            self._pieces.append(f"{pack}({', '.join(self._values)})")
        self._codes, self._values = "", []

    def _number(self, codes: str, *values: str) -> None:
        self._codes += codes
        self._values.extend(values)

    def _local(self, value: str) -> str:
        variable = self._code.variable()
        self._code.line(f"{variable} = {value}")
        return variable

    def _field(self, field: Field, value: str) -> None:
        if field.is_array:
            self._array(field, value)
        elif field.base == "string":
            encoded = self._local(f"{value}.encode()")
            self._number("I", f"len({encoded})")
            self._close_struct()
            self._pieces.append(encoded)
        elif field.base in _TIME_CODES:
            local = self._local(value)
            self._number(_TIME_CODES[field.base] * 2, f"{local}.secs", f"{local}.nsecs")
        elif field.is_message:
            self.message(self._known[field.base]._spec, self._local(value))
        else:
            self._number(STRUCT_CODES[field.base], value)

    def _array(self, field: Field, value: str) -> None:
        local = self._local(value)
        if field.base in OCTETS:
            self._octets(field, local)
        elif field.base in STRUCT_CODES:
            self._numbers(field, local)
        else:
            if field.length is None:
                self._number("I", f"len({local})")
            else:
                self._code.line(
                    f"if len({local}) != {field.length}: _wrong_length({field.length}, {local})"
                )
            if field.base == "string":
                self._strings(local)
            else:
                self._elements(field, local)

    def _octets(self, field: Field, local: str) -> None:
        self._code.line(
            f"if type({local}) is not bytes: {local} = _octets({local}, {field.length})"
        )
        if field.length is not None:
            self._number(f"{field.length}s", local)
            return
        self._number("I", f"len({local})")
        self.flush()
        self._code.line(f"w({local})")

    def _numbers(self, field: Field, local: str) -> None:
        """Pack lists and tuples by a struct of their length; leave other arrays to a function."""
        code = STRUCT_CODES[field.base]
        self.flush()
        with self._code.block(f"if type({local}) is _list or type({local}) is _tuple:"):
            if field.length is None:
                length = self._code.variable("n")
                self._code.line(f"{length} = len({local})")
                self._code.line(f"w(_packers_{code}[{length}]({length}, *{local}))")
            else:
                self._code.line(
                    f"w({self._code.struct(f'{field.length}{code}', 'pack')}(*{local}))"
                )
        with self._code.block("else:"):
            self._code.line(f"w(_numbers({local}, {field.base!r}, {field.length}))")

    def _strings(self, local: str) -> None:
        pack = self._code.struct("I", "pack")
        self._close_struct()
        self._pieces.append(
            f"b''.join([{pack}(len(e)) + e for s in {local} for e in (s.encode(),)])"
        )
        self.flush()

    def _elements(self, field: Field, local: str) -> None:
        """Pack elements of one size in a comprehension, others one by one."""
        codes, values = self._fixed_element(field)
        if codes is not None:
            self._close_struct()
            pack = self._code.struct(codes, "pack")
            self._pieces.append(f"b''.join([{pack}({', '.join(values)}) for m in {local}])")
            self.flush()
            return
        self.flush()
        name = f"_writer_{field.base.replace('/', '__')}"
        self._code.names.setdefault(
            name, LazyFunction(self._known[field.base], "_write", self._code, name)
        )
        with self._code.block(f"for m in {local}:"):
            self._code.line(f"{name}(m, w)")

    def _fixed_element(self, field: Field) -> tuple[str | None, list[str]]:
        if field.base in _TIME_CODES:
            return _TIME_CODES[field.base] * 2, ["m.secs", "m.nsecs"]
        spec = self._known[field.base]._spec
        values: list[str] = []
        if not _paths(spec, "m", self._known, values):
            return None, []
        return fixed_codes(spec, self._known), values


class LazyFunction:
    """A function of another class that is compiled at its first call.

    Args:
        owner: The class it belongs to.
        method: Its name.
        code: The code that calls it under ``name``; gets the function itself then.
        name: Its name there.
    """

    def __init__(self, owner: type[Message], method: str, code: GeneratedCode, name: str) -> None:
        self._owner = owner
        self._method = method
        self._names = code.names
        self._name = name

    def __call__(self, *args: object) -> object:
        """Compile it, put it in the place of this, and call it."""
        from gazelle_ros.messages.compile import compiled

        function = self._names[self._name] = compiled(self._owner, self._method)
        return function(*args)


def write_encoder(spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]]) -> str:
    """Write the source of ``serialize(self, buff)``."""
    with code.block("try:"):
        code.line("w = buff.write")
        encoder = EncoderWriter(code, known)
        encoder.message(spec, "self")
        encoder.flush()
    with code.block("except _struct_errors as err:"):
        code.line("self._check_types(err)")
    with code.block("except AttributeError:"):
        code.line("self._check_types()")
        code.line("raise")
    source = code.source("def serialize(self, buff):")
    if source.count(" w(") != 1 or " for " in source:
        return source
    return source.replace("        w = buff.write\n", "").replace(" w(", " buff.write(")


def write_element_encoder(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]]
) -> str:
    """Write the source of ``_write(self, w)``, for messages in arrays; errors are the caller's."""
    encoder = EncoderWriter(code, known)
    encoder.message(spec, "self")
    encoder.flush()
    return code.source("def _write(self, w):")


def _paths(
    spec: MessageSpec, owner: str, known: dict[str, type[Message]], values: list[str]
) -> bool:
    """Collect the expressions of all numbers in a message; False if it holds anything else."""
    for field in spec.fields:
        path = f"{owner}.{field.attribute}"
        if field.is_array or field.base == "string":
            return False
        if field.base in _TIME_CODES:
            values += [f"{path}.secs", f"{path}.nsecs"]
        elif field.is_message:
            if not _paths(known[field.base]._spec, path, known, values):
                return False
        else:
            values.append(path)
    return True
