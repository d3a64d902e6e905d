"""Messages as YAML: to text as ``rostopic echo`` prints them, and from text as ``rostopic pub`` reads.

The forms are those of http://wiki.ros.org/ROS/YAMLCommandLine.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base import bounded_yaml
from gazelle_ros.messages.base import Message
from gazelle_ros.messages.errors import MessageException
from gazelle_ros.messages.spec import BUILTIN, OCTETS, Field
from gazelle_ros.time import Duration, Time, TVal

FieldFilter = Callable[[Message], Iterable[str]]
_PLAIN = re.compile(r"[ !#-\[\]-~]{1,60}")
"""Pattern of text that needs no escapes, and no second line, between double quotes."""


def strify_message(
    val: Any,
    indent: str = "",
    time_offset: Time | None = None,
    current_time: Time | None = None,
    field_filter: FieldFilter | None = None,
    fixed_numeric_width: int | None = None,
) -> str:
    """Return a message, or any value of a field, as YAML.

    Args:
        val: The value.
        indent: Put before each line; with it, the text begins with a new line.
        time_offset: Times are shown as what has passed since then.
        current_time: Has no effect.
        field_filter: Gives the names of the fields to show of a message.
        fixed_numeric_width: Characters for each number.
    """
    del current_time
    return _Writer(time_offset, field_filter, fixed_numeric_width).text(val, indent)


def to_yaml(message: Message) -> str:
    """Return a message as YAML, as ``rostopic echo`` prints it."""
    return strify_message(message)


def to_dict(value: Any) -> Any:
    """Return a message as plain dicts, lists, numbers and strings.

    Times as ``secs`` and ``nsecs``.
    """
    if isinstance(value, Message):
        return {name: to_dict(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, TVal):
        return {"secs": value.secs, "nsecs": value.nsecs}
    if isinstance(value, (list, tuple)):
        return [to_dict(each) for each in value]
    if isinstance(value, bytes):
        return list(value)
    return value.tolist() if hasattr(value, "tolist") else value


def from_yaml(message: type[Message] | Message, text: str, keys: Mapping[str, Any] = {}) -> Message:
    """Return a message from YAML: a mapping of fields, or a list of all of them.

    Args:
        message: The class, or a message to fill.
        text: The YAML.
        keys: Messages and times by the words that stand for them, such as ``now``.

    Raises:
        MessageException: A field does not exist, has a wrong form, or the text is not valid YAML.
    """
    import yaml

    try:
        value = bounded_yaml.safe_load(text)
    except yaml.YAMLError as err:
        raise MessageException(f"this is not valid YAML: {err}") from err
    return from_dict(message, value, keys)


def from_dict(
    message: type[Message] | Message, value: Any, keys: Mapping[str, Any] = {}
) -> Message:
    """Return a message from a mapping of fields, or from a list of all of them.

    Raises:
        MessageException: A field does not exist or has a wrong form.
    """
    filled = message() if isinstance(message, type) else message
    if value is None:
        return filled
    arguments = value if isinstance(value, (list, tuple)) else [value]
    fill_message_args(filled, list(arguments), keys)
    return filled


def fill_message_args(msg: Message | TVal, msg_args: Any, keys: Mapping[str, Any] = {}) -> None:
    """Fill a message from the arguments of a command line.

    Args:
        msg: The message.
        msg_args: A list of all fields in order, or of one mapping with some of them by name.
        keys: Messages and times by the words that stand for them, such as ``now``.

    Raises:
        MessageException: There are too many or too few, a field does not exist, or a value has
            a wrong form.
        ValueError: The arguments are neither a list nor a mapping.
    """
    if msg_args is None:
        msg_args = []
    if len(msg_args) == 1 and isinstance(msg_args, (list, tuple)) and isinstance(msg_args[0], dict):
        msg_args = msg_args[0]
    _fill(msg, msg_args, keys, "")


def get_printable_message_args(msg: Message, buff: Any = None, prefix: str = "") -> str:
    """Return the names of a message's fields, those of messages in it with dots between."""
    names = []
    for name in msg.__slots__:
        value = getattr(msg, name)
        if isinstance(value, Message):
            inner = get_printable_message_args(value, prefix=f"{prefix}{name}.")
            names += [inner] if inner else []
        else:
            names.append(prefix + name)
    text = " ".join(names)
    if buff is not None:
        buff.write(text + " " if text else "")
        return str(buff.getvalue()).rstrip()
    return text


@dataclass(frozen=True, slots=True)
class _Writer:
    time_offset: Time | None
    field_filter: FieldFilter | None
    width: int | None

    def text(self, val: Any, indent: str) -> str:
        kind = type(val)
        if kind in {int, float, bool}:
            return self._number(val)
        if isinstance(val, str):
            return _quoted(val)
        if isinstance(val, TVal):
            return self._time(val, indent)
        if kind in {list, tuple}:
            return self._sequence(val, indent)
        if isinstance(val, Message):
            return self._message(val, indent)
        return str(val)

    def _number(self, val: float) -> str:
        if self.width is None or isinstance(val, bool):
            return str(val)
        if isinstance(val, int):
            return f"{val:{self.width}d}"
        text = f"{val:.{self.width}f}"
        return text[: max(text.find("."), self.width)]

    def _time(self, val: TVal, indent: str) -> str:
        if self.time_offset is not None and isinstance(val, Time):
            val = val - self.time_offset
        if self.width is not None:
            secs, nsecs = f"{val.secs:{self.width}d}", f"{val.nsecs:{self.width}d}"
        else:
            secs, nsecs = str(val.secs), f"{val.nsecs:9d}"
        return f"\n{indent}secs: {secs}\n{indent}nsecs: {nsecs}"

    def _sequence(self, val: Sequence[Any], indent: str) -> str:
        if not val:
            return "[]"
        first = val[0]
        if type(first) in {int, float} and self.width is not None:
            inner = "".join(self.text(each, indent) + ", " for each in val).rstrip(", ")
            return f"[{inner}]"
        if isinstance(first, str):
            import yaml

            dumped = yaml.dump(list(val) if type(val) is tuple else val).rstrip("\n")
            return "\n" + "\n".join(indent + line for line in dumped.splitlines())
        if type(first) in {int, float, bool}:
            return str(list(val))
        lines = (f"{indent}- {self.text(each, indent + '  ')}" for each in val)
        return "\n" + "\n".join(lines)

    def _message(self, val: Message, indent: str) -> str:
        names = val.__slots__
        shown = names if self.field_filter is None else list(self.field_filter(val))
        lines = []
        for name, type_ in zip(names, val._slot_types, strict=True):
            if name in shown:
                value = getattr(val, name)
                if isinstance(value, bytes) and type_.partition("[")[0] in OCTETS:
                    value = list(value) if type_.startswith("uint8") else value
                lines.append(f"{indent}{name}: {self.text(value, '  ' + indent)}")
        return ("\n" if indent else "") + "\n".join(lines)


def _quoted(text: str) -> str:
    if not text:
        return "''"
    if _PLAIN.fullmatch(text):
        return f'"{text}"'
    import yaml

    return str(yaml.dump(text, default_style='"')).rstrip("\n")


def _fill(msg: Message | TVal, args: Any, keys: Mapping[str, Any], prefix: str) -> None:
    if not isinstance(msg, (Message, TVal)):
        raise ValueError(f"msg must be a Message instance: {msg}")  # noqa: TRY004  # as genpy does
    if isinstance(args, dict):
        for name, value in args.items():
            # YAML reads an empty value as none; it stands for an empty string.
            _fill_field(msg, name, "" if value is None else value, keys, prefix)
    elif isinstance(args, (list, tuple)):
        if len(args) != len(msg.__slots__):
            which = "many" if len(args) > len(msg.__slots__) else "few"
            amount = "Too many" if which == "many" else "Not enough"
            raise MessageException(
                f"{amount} arguments:\n * Given: {args}\n * Expected: {msg.__slots__}"
            )
        for name, value in zip(msg.__slots__, args, strict=True):
            _fill_field(msg, name, value, keys, prefix)
    else:
        raise ValueError(f"invalid msg_args type: {args}")  # noqa: TRY004  # as genpy does


def _fill_field(
    msg: Message | TVal, name: str, value: Any, keys: Mapping[str, Any], prefix: str
) -> None:
    if name not in msg.__slots__:
        raise MessageException(f"No field name [{prefix}{name}]")
    present = getattr(msg, name)
    if isinstance(present, (Message, TVal)):
        if isinstance(value, str):
            if value not in keys:
                raise MessageException(f"No key named [{value}]")
            setattr(msg, name, keys[value])
        elif isinstance(present, TVal) and type(value) is int:
            setattr(msg, name, type(present).from_sec(value / 1e9))
        else:
            _fill(present, value, keys, f"{prefix}{name}.")
    elif type(present) is list and isinstance(msg, Message):
        _fill_array(msg, name, value, keys, prefix)
    else:
        setattr(msg, name, value)


def _fill_array(msg: Message, name: str, value: Any, keys: Mapping[str, Any], prefix: str) -> None:
    if not isinstance(value, (list, tuple)):
        kind = type(value).__name__
        raise MessageException(f"Field [{prefix}{name}] must be a list or tuple instead of: {kind}")
    field = Field(msg._slot_types[msg.__slots__.index(name)], name)
    if field.length is not None and len(value) != field.length:
        raise MessageException(
            f"Field [{prefix}{name}] has incorrect number of elements: "
            f"{len(value)} != {field.length}"
        )
    if field.base in BUILTIN - {"time", "duration"}:
        setattr(msg, name, value)
    else:
        setattr(msg, name, [_element(msg, field, each, keys, prefix) for each in value])


def _element(
    msg: Message, field: Field, value: Any, keys: Mapping[str, Any], prefix: str
) -> Message | TVal:
    if field.base in {"time", "duration"}:
        kind = Time if field.base == "time" else Duration
        if type(value) is int:
            return kind.from_sec(value / 1e9)
        made: Message | TVal = kind()
    else:
        made = _class_in(msg, field.base)()
    _fill(made, value, keys, prefix)
    return made


def _class_in(msg: Message, base: str) -> type[Message]:
    known: dict[str, type[Message]] = getattr(msg, "_known", {})
    if base in known:
        return known[base]
    from gazelle_ros.messages.registry import load_message

    return load_message(base)
