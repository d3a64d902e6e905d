"""Write the constructor of a message class."""

from __future__ import annotations

from gazelle_ros.messages.base import Message
from gazelle_ros.messages.emit import GeneratedCode
from gazelle_ros.messages.spec import FLOATS, INTEGER_BITS, OCTETS, Field, MessageSpec

HEAD = "def __init__(self, *args, **kwds):"


def write_constructor(
    spec: MessageSpec, code: GeneratedCode, known: dict[str, type[Message]]
) -> str:
    """Write the source of ``__init__``; without arguments it takes the shortest way."""
    names = [field.attribute for field in spec.fields]
    defaults = [default(field, code, known) for field in spec.fields]
    with code.block("if kwds:"):
        with code.block("if args:"):
            code.line(
                "raise TypeError('Message constructor may only use args OR keywords, not both')"
            )
        with code.block("for k in kwds:"), code.block("if k not in _slots:"):
            code.line(
                "raise AttributeError(f'{k} is not an attribute of {self.__class__.__name__}')"
            )
        code.line("get = kwds.get")
        for name, value in zip(names, defaults, strict=True):
            code.line(f"v = get({name!r})")
            code.line(f"self.{name} = {value} if v is None else v")
    with code.block("elif args:"):
        with code.block(f"if len(args) != {len(names)}:"):
            code.line(
                "raise TypeError(f'Invalid number of arguments, args should be "
                "{_slots} args are{args}')"
            )
        for index, (name, value) in enumerate(zip(names, defaults, strict=True)):
            code.line(f"v = args[{index}]")
            code.line(f"self.{name} = {value} if v is None else v")
    with code.block("else:"):
        for field in spec.fields:
            _assign_default(field, f"self.{field.attribute}", code, known)
    return code.source(HEAD)


def default(field: Field, code: GeneratedCode, known: dict[str, type[Message]]) -> str:
    """Return an expression for the default of a field."""
    if not field.is_array:
        return _element_default(field.base, code, known)
    if field.base in OCTETS:
        return f"bytes({field.length})" if field.length else "b''"
    if field.length is None:
        return "[]"
    element = _element_default(field.base, code, known)
    if field.is_message or field.base in {"time", "duration"}:
        return f"[{element} for _ in range({field.length})]"
    return f"[{element}] * {field.length}"


def _element_default(base: str, code: GeneratedCode, known: dict[str, type[Message]]) -> str:
    if base in INTEGER_BITS:
        return "0"
    if base in FLOATS:
        return "0.0"
    if base == "string":
        return "''"
    if base == "bool":
        return "False"
    if base == "time":
        return "_Time()"
    if base == "duration":
        return "_Duration()"
    return f"{code.message_class(base, known)}()"


def _assign_default(
    field: Field, target: str, code: GeneratedCode, known: dict[str, type[Message]]
) -> None:
    """Set a field to its default, without a call for times and messages of plain numbers."""
    if field.is_array:
        code.line(f"{target} = {default(field, code, known)}")
        return
    if field.base in {"time", "duration"}:
        variable = code.variable()
        code.line(f"{variable} = {target} = _new(_{field.base.capitalize()})")
        code.line(f"{variable}.secs = {variable}.nsecs = 0")
        return
    spec = known[field.base]._spec if field.is_message else None
    if spec is None or any(each.is_message or each.is_array for each in spec.fields):
        code.line(f"{target} = {default(field, code, known)}")
        return
    variable = code.variable()
    code.line(f"{variable} = {target} = _new({code.message_class(field.base, known)})")
    for each in spec.fields:
        _assign_default(each, f"{variable}.{each.attribute}", code, known)
