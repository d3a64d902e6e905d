"""Read the text of ``.msg``, ``.srv`` and ``.action`` files.

The language is described at http://wiki.ros.org/msg, http://wiki.ros.org/srv and
http://wiki.ros.org/actionlib.
"""

from __future__ import annotations

import ast
import re

from gazelle_ros.messages.errors import InvalidDefinitionError
from gazelle_ros.messages.spec import (
    BUILTIN,
    CONSTANT_TYPES,
    FLOATS,
    INTEGER_BITS,
    UNSIGNED,
    Constant,
    Field,
    MessageSpec,
    ServiceSpec,
)

_FIELD_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
_FIELD_TYPE = re.compile(r"[A-Za-z]\w*(?:/[A-Za-z]\w*)?(?:\[(\d*)\])?", re.ASCII)
MOST_ELEMENTS = 1 << 24
"""Of arrays of fixed length in a message, which it has from the start."""


def parse_message(full_name: str, text: str, *, file: str | None = None) -> MessageSpec:
    """Parse a message definition.

    Args:
        full_name: The type's name with its package, such as ``std_msgs/String``.
        text: The definition.
        file: File of the text, for errors.

    Raises:
        InvalidDefinitionError: The text is malformed; names the line. Or the name holds what
            cannot be printed.
    """
    if not full_name.isprintable():  # Python's classes cannot be called so
        raise InvalidDefinitionError(f"{full_name!r} is not a name of a type")
    package = full_name.partition("/")[0]
    fields: list[Field] = []
    constants: list[Constant] = []
    for number, line in enumerate(text.split("\n"), start=1):
        content = line.partition("#")[0].strip()
        if not content:
            continue
        try:
            if "=" in content:
                constants.append(_parse_constant(line, content))
            else:
                fields.append(_parse_field(content, package))
        except ValueError as err:
            raise InvalidDefinitionError(
                str(err), file=file or full_name, line=number, element=content
            ) from err
    names = [field.name for field in fields] + [each.name for each in constants]
    if len(set(names)) != len(names):
        twice = sorted({name for name in names if names.count(name) > 1})
        raise InvalidDefinitionError(
            f"names occur twice: {', '.join(twice)}", file=file or full_name
        )
    return MessageSpec(full_name, tuple(fields), tuple(constants), text)


def parse_service(full_name: str, text: str, *, file: str | None = None) -> ServiceSpec:
    """Parse a service definition: request, a line of ``---``, response.

    Raises:
        InvalidDefinitionError: The text is malformed.
    """
    halves: tuple[list[str], list[str]] = ([], [])
    half = halves[0]
    for line in text.split("\n"):
        if line.startswith("---"):
            half = halves[1]
        else:
            half.append(line + "\n")
    request = parse_message(f"{full_name}Request", "".join(halves[0]), file=file)
    response = parse_message(f"{full_name}Response", "".join(halves[1]), file=file)
    return ServiceSpec(full_name, request, response, text)


def action_messages(name: str, text: str, *, file: str | None = None) -> dict[str, str]:
    """Return the texts of the seven messages that an action stands for.

    Args:
        name: The action's name without its package.
        text: Goal, result and feedback, with lines of ``---`` between them.
        file: File of the text, for errors.

    Returns:
        Texts by message name, such as ``FibonacciGoal``.

    Raises:
        InvalidDefinitionError: There are not three parts.
    """
    parts: list[list[str]] = [[]]
    for line in text.split("\n"):
        if line.startswith("---"):
            parts.append([])
        else:
            parts[-1].append(line)
    if len(parts) != 3:
        raise InvalidDefinitionError(
            f"an action has a goal, a result and a feedback, this has {len(parts)} part(s)",
            file=file or name,
        )
    goal, result, feedback = ("\n".join(part) for part in parts)
    status = "Header header\nactionlib_msgs/GoalStatus status\n"
    return {
        f"{name}Goal": goal,
        f"{name}Result": result,
        f"{name}Feedback": feedback,
        f"{name}ActionGoal": f"Header header\nactionlib_msgs/GoalID goal_id\n{name}Goal goal\n",
        f"{name}ActionResult": f"{status}{name}Result result\n",
        f"{name}ActionFeedback": f"{status}{name}Feedback feedback\n",
        f"{name}Action": f"{name}ActionGoal action_goal\n{name}ActionResult action_result\n"
        f"{name}ActionFeedback action_feedback\n",
    }


def _parse_field(content: str, package: str) -> Field:
    words = content.split()
    if len(words) != 2:
        raise ValueError("a field is a type and a name")
    type_, name = words
    if not _FIELD_NAME.fullmatch(name):
        raise ValueError(f"'{name}' is not a legal field name")
    match = _FIELD_TYPE.fullmatch(type_)
    if not match:
        raise ValueError(f"'{type_}' is not a legal type")
    if match[1] and int(match[1]) > MOST_ELEMENTS:
        raise ValueError(f"an array of {match[1]} elements is too long")
    if type_ in {"Header", "roslib/Header"}:
        return Field("std_msgs/Header", name)
    if "/" not in type_ and type_.partition("[")[0] not in BUILTIN:
        type_ = f"{package}/{type_}"
    return Field(type_, name)


def _parse_constant(line: str, content: str) -> Constant:
    type_ = content.split(maxsplit=1)[0].partition("=")[0]
    if type_ not in CONSTANT_TYPES:
        raise ValueError(f"'{type_}' is not a type for a constant")
    # A string continues to the end of the line: a # in it starts no comment.
    source = line if type_ == "string" else content
    before, _, value = source.partition("=")
    words = before.split()
    if len(words) != 2:
        raise ValueError("a constant is a type, a name, = and a value")
    value = value.strip()
    if type_ != "string":
        if "=" in value:
            raise ValueError("a constant has one =")
        value = " ".join(value.split())
    return Constant(type_, words[1], _constant_value(type_, value), value)


def _constant_value(type_: str, text: str) -> bool | int | float | str:
    if type_ == "string":
        return text
    if type_ == "bool":
        try:
            return bool(ast.literal_eval(text))
        except (SyntaxError, ValueError) as err:
            raise ValueError(f"'{text}' is not a bool") from err
    if type_ in FLOATS:
        return float(text)
    value = int(text)
    bits = INTEGER_BITS[type_]
    low, high = (0, 2**bits) if type_ in UNSIGNED else (-(2 ** (bits - 1)), 2 ** (bits - 1))
    if not low <= value < high:
        raise ValueError(f"{value} does not fit into {type_}")
    return value
