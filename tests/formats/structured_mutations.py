"""Ways to break files that keep their structure: elements, entries, numbers, arrays, encodings.

A way takes the content and a ``random.Random`` and returns other content. ``mutations`` has those that
take any bytes.
"""

from __future__ import annotations

import copy
import io
import json
import random
import re
import struct
import zipfile
from collections.abc import Callable
from typing import Any
from xml.dom import Node, minidom

import mutations
import yaml

Way = Callable[[bytes, random.Random], bytes]

NUMBERS = [
    "nan",
    "-inf",
    "inf",
    "1e308",
    "-1e308",
    "1e-320",
    "0",
    "-1",
    "1e400",
    "9" * 400,
    "",
    "a",
]
NUMBERS += ["2147483648", "18446744073709551616", "1e12", "-0.0", "0x10", "1_000", "1,5", "½", " "]
DEPTHS = [3, 60, 3000]
COPIES = [1, 3, 40]
ENCODINGS = ["utf-16", "utf-32", "utf-8-sig", "cp037", "utf-7", "shift_jis"]
DECLARED = [b"utf-16", b"utf-7", b"ebcdic", b"base64", b"idna", b"latin-1", b"x" * 300]
_NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")
_FACTORS = [1000.0, 0.001, 57.29577951308232, -1.0, 1e150]
_MOST_NODES = 20_000


def scaled(text: str, chance: random.Random) -> str:
    """Return text whose numbers are in another unit."""
    factor = chance.choice(_FACTORS)
    return _NUMBER.sub(lambda found: repr(float(found.group()) * factor), text)


def other_number(text: str, chance: random.Random) -> str:
    """Return text with another number in the place of one; all of it where there is none."""
    places = list(_NUMBER.finditer(text))
    if not places:
        return chance.choice(NUMBERS)
    place = chance.choice(places)
    return text[: place.start()] + chance.choice(NUMBERS) + text[place.end() :]


# -- XML -----------------------------------------------------------------------------------


def xml(data: bytes, chance: random.Random) -> bytes:
    """Change elements and attributes; bytes where this is no XML."""
    try:
        document = minidom.parseString(data)  # files of our own and of the corpus
    except Exception:  # noqa: BLE001  # expat, codecs: whatever says that this is none
        return mutations.mutated(data, chance)
    for _ in range(chance.randint(1, 3)):
        nodes = document.getElementsByTagName("*")
        if nodes and len(nodes) < _MOST_NODES:
            chance.choice(XML_WAYS)(document, chance.choice(nodes), nodes, chance)
    try:
        return bytes(document.documentElement.toxml().encode("utf-8", "surrogatepass"))
    except (AttributeError, RecursionError):  # no root is left, or one too deep for minidom
        return b""


def _delete(_document: Any, node: Any, _nodes: Any, _chance: random.Random) -> None:
    node.parentNode.removeChild(node)


def _copy(_document: Any, node: Any, _nodes: Any, chance: random.Random) -> None:
    if node.parentNode.nodeType == Node.DOCUMENT_NODE:
        return
    for _ in range(chance.choice(COPIES)):
        node.parentNode.insertBefore(node.cloneNode(deep=True), node)


def _exchange(_document: Any, node: Any, nodes: Any, chance: random.Random) -> None:
    """Replace one element by a copy of another, which may contain it."""
    if node.parentNode.nodeType != Node.DOCUMENT_NODE:
        node.parentNode.replaceChild(chance.choice(nodes).cloneNode(deep=True), node)


def _put_into(_document: Any, node: Any, nodes: Any, chance: random.Random) -> None:
    node.appendChild(chance.choice(nodes).cloneNode(deep=True))


def _nest(document: Any, node: Any, _nodes: Any, chance: random.Random) -> None:
    for _ in range(chance.choice(DEPTHS[:2])):
        child = document.createElement(node.tagName)
        for name, value in node.attributes.items():
            child.setAttribute(name, value)
        node.appendChild(child)
        node = child


def _retag(_document: Any, node: Any, nodes: Any, chance: random.Random) -> None:
    node.tagName = node.nodeName = chance.choice(nodes).tagName


def _attribute(_document: Any, node: Any, nodes: Any, chance: random.Random) -> None:
    """Remove an attribute, or set it to the value of another, or to an invalid number."""
    given = list(node.attributes.items())
    others = [pair for each in nodes[:500] for pair in each.attributes.items()]
    if not others:
        return
    name = chance.choice(given or others)[0]
    how = chance.randrange(4)
    if how == 0 and given:
        node.removeAttribute(name)
    elif how == 1:
        node.setAttribute(name, chance.choice([v for n, v in others if n == name]))
    elif how == 2:
        node.setAttribute(*chance.choice(others))
    else:
        node.setAttribute(name, _value(node.getAttribute(name), chance))


def _text(document: Any, node: Any, nodes: Any, chance: random.Random) -> None:
    """Change the text of an element."""
    texts = [each for each in node.childNodes if each.nodeType == Node.TEXT_NODE]
    if not texts:
        node.appendChild(document.createTextNode(chance.choice(NUMBERS)))
        return
    others = [
        t.data for each in nodes[:500] for t in each.childNodes if t.nodeType == Node.TEXT_NODE
    ]
    at = chance.choice(texts)
    at.data = chance.choice([_value(at.data, chance), chance.choice(others)])


def _value(text: str, chance: random.Random) -> str:
    ways: list[Callable[[], str]] = [
        lambda: other_number(text, chance),
        lambda: other_number(text, chance),
        lambda: scaled(text, chance),
        lambda: text + " " + text,
        lambda: " ".join(text.split()[1:]),
        lambda: "${" + text + "}",
        lambda: "$(arg " + text + ")",
        lambda: text * 2000,
    ]
    return chance.choice(ways)()


XML_WAYS = [_delete, _copy, _exchange, _put_into, _nest, _retag, *[_attribute] * 4, *[_text] * 4]


# -- YAML, JSON ----------------------------------------------------------------------------

VALUES: list[Any] = [
    None,
    True,
    [],
    {},
    "",
    "a",
    float("nan"),
    float("inf"),
    -float("inf"),
    1e308,
    -1,
    0,
]
VALUES += [10**30, 2**31, -(2**63), "1e5", "nan", [[1.0]], [None], {"a": 1}, "\u2028", 1e-320, 1.5]


def tree(root: Any, chance: random.Random) -> Any:
    """Change a tree of dicts and lists."""
    root = copy.deepcopy(root)
    for _ in range(chance.randint(1, 3)):
        places = list(_places(root))
        if not places:
            return chance.choice(VALUES)
        _change(*chance.choice(places), places, chance)
    return root


def _places(root: Any) -> Any:
    """Yield the container and the key or index of every value."""
    pairs = (
        root.items()
        if isinstance(root, dict)
        else enumerate(root)
        if isinstance(root, list)
        else ()
    )
    for key, value in list(pairs):
        yield root, key
        yield from _places(value)


def _change(parent: Any, key: Any, places: Any, chance: random.Random) -> None:
    if key not in parent and isinstance(parent, dict):
        return
    value, how = parent[key], chance.randrange(9)
    if how < 3:
        parent[key] = copy.deepcopy(chance.choice(VALUES))
    elif how == 3:
        other, at = chance.choice(places)
        parent[key] = copy.deepcopy(other[at])
    elif how == 4:
        del parent[key]
    elif how == 5:
        for _ in range(chance.choice(DEPTHS[:2])):
            value = [value]
        parent[key] = value
    elif how == 6 and isinstance(parent, dict):
        parent[chance.choice([at for _, at in places] + VALUES[5:])] = parent.pop(key)
    elif how == 7 and isinstance(value, int | float):
        parent[key] = value * chance.choice(_FACTORS)
    elif how == 8 and isinstance(value, list | str):
        parent[key] = value * chance.choice([0, *COPIES])


def yaml_tree(data: bytes, chance: random.Random) -> bytes:
    """Change the entries of YAML; lines where this is none."""
    try:
        root = yaml.safe_load(data)
        return yaml.safe_dump(tree(root, chance), allow_unicode=True).encode("utf-8", "replace")
    except Exception:  # noqa: BLE001  # whatever says that this is none
        return lines(data, chance)


def json_lines(data: bytes, chance: random.Random) -> bytes:
    """Change the entries of JSON: of all of it, or of one line."""
    try:
        return json.dumps(tree(json.loads(data), chance), default=str).encode()
    except (ValueError, RecursionError, TypeError):
        pass
    rows = data.split(b"\n")
    at = chance.randrange(len(rows))
    try:
        rows[at] = json.dumps(tree(json.loads(rows[at]), chance), default=str).encode()
    except (ValueError, RecursionError, TypeError):
        return lines(data, chance)
    return b"\n".join(rows)


def lines(data: bytes, chance: random.Random) -> bytes:
    """Delete, copy, move, indent or change lines."""
    rows = data.split(b"\n")
    for _ in range(chance.randint(1, 3)):
        at, other, how = (
            chance.randrange(len(rows)),
            chance.randrange(len(rows)),
            chance.randrange(6),
        )
        if how == 0 and len(rows) > 1:
            del rows[at]
        elif how == 1:
            rows[at:at] = [rows[other]] * chance.choice(COPIES)
        elif how == 2:
            rows[at], rows[other] = rows[other], rows[at]
        elif how == 3:
            rows[at] = b" " * chance.choice([1, 2, 5000]) + rows[at].lstrip()
        else:
            rows[at] = other_number(rows[at].decode("latin-1"), chance).encode("utf-8")
    return b"\n".join(rows)


YAML_TRICKS = [
    b"[" * 3000,
    b"{a: " * 500,
    b"&a [*a]",
    b"&a {b: *a}",
    b"!!python/object:os.system {}",
]
YAML_TRICKS += [
    b"!!binary zzz",
    b"!!float a",
    b"!!timestamp 1",
    b"2001-99-99",
    b"? [a, b]\n: 1",
    b"<<: 1",
]
YAML_TRICKS += [
    b"0b2",
    b"1:99:99",
    b"0o9",
    b"!!int ''",
    b"!!set {a}",
    b"<<: [*x]",
    b"%YAML 9.9\n---\n",
]


def yaml_trick(data: bytes, chance: random.Random) -> bytes:
    """Replace a value or a line by unusual YAML."""
    rows = data.split(b"\n")
    at = chance.randrange(len(rows))
    key, colon, _ = rows[at].partition(b":")
    rows[at] = key + b": " + chance.choice(YAML_TRICKS) if colon else chance.choice(YAML_TRICKS)
    return b"\n".join(rows)


# -- words, bytes, archives ----------------------------------------------------------------


def words(data: bytes, chance: random.Random) -> bytes:
    """Change words and numbers of a text without further structure."""
    parts = re.split(rb"([\s()\[\]\"]+)", data)
    for _ in range(chance.randint(1, 4)):
        at, other, how = (
            chance.randrange(len(parts)),
            chance.randrange(len(parts)),
            chance.randrange(5),
        )
        if how == 0:
            parts[at] = b""
        elif how == 1:
            parts[at] = parts[other]
        elif how == 2:
            parts[at:at] = parts[at : at + 6] * chance.choice(COPIES)
        else:
            parts[at] = other_number(parts[at].decode("latin-1"), chance).encode("utf-8")
    return b"".join(parts)


def integers(data: bytes, chance: random.Random) -> bytes:
    """Return overwrite lengths, counts and numbers of a binary file."""
    changed = bytearray(data)
    for _ in range(chance.randint(1, 3)):
        if len(changed) < 9:
            break
        at = min(chance.randrange(len(changed) - 8), chance.choice([100, len(changed)]))
        value = chance.choice(
            [
                struct.pack(
                    "<I", chance.choice([0, 1, 0x7FFFFFFF, 0xFFFFFFFF, 0x10000000, len(data)])
                ),
                struct.pack(">I", chance.choice([0, 1, 0x7FFFFFFF, 0xFFFFFFFF, 0x10000])),
                struct.pack("<f", chance.choice([float("nan"), float("inf"), 3e38, -1.0, 1e-45])),
                struct.pack("<d", chance.choice([float("nan"), float("inf"), 1e308, -1.0])),
            ]
        )
        changed[at : at + len(value)] = value
    return bytes(changed)


def archive(data: bytes, chance: random.Random) -> bytes:
    """Change the arrays of an npz file: a header, numbers, a member that is missing or there twice."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as old:
            members = {each: old.read(each) for each in old.namelist()}
    except (zipfile.BadZipFile, OSError):
        return mutations.mutated(data, chance)
    name, how = chance.choice(list(members)), chance.randrange(6)
    if how == 0:
        del members[name]
    elif how == 1:
        members[name] = members[chance.choice(list(members))]
    elif how == 2:
        members[name] = words(members[name][:128], chance) + members[name][128:]
    elif how == 3:
        members[name] = mutations.mutated(members[name], chance)
    else:
        members[name] = members[name][:128] + integers(members[name][128:], chance)
    file = io.BytesIO()
    with zipfile.ZipFile(
        file, "w", chance.choice([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
    ) as new:
        for each, content in members.items():
            new.writestr(each, content)
    return file.getvalue()


def encoding(data: bytes, chance: random.Random) -> bytes:
    """Write the text in another encoding, or declare another than it has."""
    how = chance.randrange(4)
    if how == 0:
        return data.decode("utf-8", "replace").encode(chance.choice(ENCODINGS), "replace")
    if how == 1:
        declaration = b"<?xml version='1.0' encoding='" + chance.choice(DECLARED) + b"'?>"
        return declaration + re.sub(rb"<\?xml.*?\?>", b"", data, count=1)
    if how == 2:
        at = chance.randrange(len(data) + 1)
        return (
            data[:at] + chance.choice([b"\x00", b"\xff\xfe", b"\xed\xa0\x80", b"\xc3"]) + data[at:]
        )
    return data.replace(b"\n", chance.choice([b"\r\n", b"\r", b"\x0c", b""]))


def truncated(data: bytes, chance: random.Random) -> bytes:
    """Cut the content off."""
    return data[: chance.randrange(len(data) + 1)]


FAMILIES: dict[str, list[Way]] = {
    "xml": [xml] * 8 + [mutations.mutated, encoding, truncated],
    "yaml": [yaml_tree] * 4 + [yaml_trick, lines, mutations.mutated, encoding, truncated],
    "json": [json_lines] * 6 + [mutations.mutated, encoding, truncated],
    "words": [words] * 5 + [lines, mutations.mutated, encoding, truncated],
    "bytes": [integers] * 4 + [mutations.mutated, truncated],
    "archive": [archive] * 5 + [mutations.mutated, truncated],
}


def broken(family: str, data: bytes, chance: random.Random) -> bytes:
    """Return the content, broken in a way that fits its family."""
    return chance.choice(FAMILIES[family])(data, chance)
