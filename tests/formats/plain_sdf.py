"""SDF as a table of paths and values, by ElementTree alone: it shares no code with the package.

What libsdformat prints and what Gazelle writes are compared by it. Either may leave out what is
the default or say a pose in another frame; so defaults are taken from libsdformat's own schema,
and poses are resolved. Everything else of a file is in the table, known to the schema or not.
"""

import functools
import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

import numpy as np
import pytest

SCHEMA = Path("/usr/share/sdformat12/1.9")
ENDLESS = 1e16
# elements with a frame of their own in the model
FRAMED = {"link", "joint", "frame", "model"}
NOTHING = (None, None, {}, {})
# what Gazelle says in its own namespace is for itself
OWN = "{urn:gazelle}"
MANY = {"*", "+", "-1"}


@functools.cache
def schema(name):
    """Return the schema of an element: ``(type, default, defaults of attributes, children)``."""
    if not SCHEMA.is_dir():
        pytest.skip("libsdformat's schema is not installed (Debian: libsdformat-dev)")
    return _described(ET.parse(SCHEMA / f"{name}.sdf").getroot())


def _described(node):
    children = {
        child.get("name"): (
            functools.partial(schema, child.get("ref"))
            if "ref" in child.attrib
            else functools.partial(_described, child),
            child.get("required") in MANY,
        )
        for child in node.findall("element")
        if "name" in child.attrib
    }
    for include in node.findall("include"):
        file = SCHEMA / include.get("filename")
        if file.exists():
            name = ET.parse(file).getroot().get("name")
            children[name] = (functools.partial(schema, file.stem), include.get("required") in MANY)
    attributes = {a.get("name"): a.get("default") for a in node.findall("attribute")}
    return (node.get("type"), node.get("default"), attributes, children)


def table(text):
    """Return all values of an SDF text by path, except defaults."""
    rows = {}
    # libsdformat leaves a note to itself in plugins, whose name is no XML
    text = re.sub(r"<ignition::corrected_offsets>1</ignition::corrected_offsets>", "", text)
    for child, label in _labelled(ET.fromstring(text), schema("root")[3]):
        _fill(rows, child, label, _kind(child.tag, schema("root")[3]), None)
    return rows


def _kind(tag, below):
    return below[tag][0]() if tag in below else NOTHING


def _labelled(node, below):
    """Yield the children with unique names; of single ones the first counts."""
    seen = {}
    for child in node:
        if child.tag.startswith(OWN):
            continue
        kind = _kind(child.tag, below)
        usual = kind[2].get("name", "") not in {None, "", "__default__"}
        name = child.get("name", kind[2].get("name") if usual else None)
        label = child.tag if name is None else f"{child.tag}[{name}]"
        number = seen[label] = seen.get(label, -1) + 1
        if not number or below.get(child.tag, (None, True))[1]:
            yield child, f"{label}#{number}" if number else label


class Frames:
    """Places of the links, joints, frames and models in a model or world, in its own frame."""

    def __init__(self, node):
        self.parts = {part.get("name"): part for tag in FRAMED for part in node.findall(tag)}
        self.known = {"": np.eye(4), "__model__": np.eye(4), "world": np.eye(4)}

    def of(self, name):
        """Place of the frame with a name, which may be in a nested model."""
        if name not in self.known:
            outer, mark, inner = name.partition("::")
            if name in self.parts or not mark:
                self.known[name] = self.placed(self.parts[name])
            else:
                self.known[name] = self.of(outer) @ Frames(self.parts[outer]).of(inner)
        return self.known[name]

    def placed(self, part):
        """Place of one of the parts."""
        pose = part.find("pose")
        relative = "" if pose is None else pose.get("relative_to", "")
        if not relative and part.tag == "joint":
            relative = part.findtext("child", "").strip()
        return self.of(relative or part.get("attached_to", "")) @ matrix(pose)

    def body(self, name):
        """Return the link of a name, through frames attached to it."""
        part = self.parts.get(name)
        if part is not None and part.tag == "frame" and part.get("attached_to"):
            return self.body(part.get("attached_to"))
        return name


def matrix(pose):
    """Return a ``<pose>`` as a matrix of four by four."""
    place = np.eye(4)
    if pose is None or not (pose.text or "").strip():
        return place
    numbers = [float(word) for word in pose.text.split()]
    place[:3, 3] = numbers[:3]
    if pose.get("rotation_format") == "quat_xyzw":
        x, y, z, w = np.array(numbers[3:]) / math.hypot(*numbers[3:])
    else:
        scale = math.pi / 180 if pose.get("degrees") in {"true", "1"} else 1.0
        halves = [angle * scale / 2 for angle in numbers[3:]]
        (sr, sp, sy), (cr, cp, cy) = map(math.sin, halves), map(math.cos, halves)
        x, y = sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy
        z, w = cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy
    place[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return place


def _fill(rows, node, path, known, frames, link=""):
    """Fill rows of an element and all below it; ``frames`` are those of the model around it."""
    _plain(rows, node, path, known)
    if frames is not None and frames.parts.get(node.get("name")) is node:
        rows[f"{path}/pose"] = frames.placed(node)
    elif "pose" in known[3]:
        rows[f"{path}/pose"] = _within(node.find("pose"), link, frames)
    inner = Frames(node) if node.tag in {"model", "world"} else frames
    link = node.get("name") if node.tag == "link" else link
    for child, label in _labelled(node, known[3]):
        here = f"{path}/{label}"
        if child.tag == "pose" and "pose" in known[3]:
            continue
        if child.tag == "inertial" and node.tag == "link":
            _inertial(rows, child, here)
        elif child.tag in {"parent", "child"} and node.tag == "joint" and child.text:
            rows[here] = frames.body(child.text.strip())
        elif child.tag == "xyz" and node.tag in {"axis", "axis2"}:
            rows[here] = _direction(child, rows[f"{path.rpartition('/')[0]}/pose"], frames)
        else:
            _fill(rows, child, here, _kind(child.tag, known[3]), inner, link)


def _plain(rows, node, path, known):
    """Fill rows of an element itself."""
    kind, default, attributes, _ = known
    if path.endswith("]") or path.split("/")[-2:-1] == ["geometry"]:
        rows[path] = "there"  # which tells something though it holds no value
    for name, text in node.attrib.items():
        written = not name.startswith(OWN) and name not in {"name", "attached_to"}
        if written and text != attributes.get(name, ""):
            rows[f"{path}@{name}"] = value(text, None)
    if (node.text or "").strip():
        found = value(node.text, kind)
        if default is None or not same(found, value(default, kind)):
            rows[path] = found


def _within(pose, link, frames):
    """Return a pose of a part of a link, in the link's frame."""
    relative = "" if pose is None else pose.get("relative_to", "")
    if not relative:
        return matrix(pose)
    return np.linalg.inv(frames.of(link)) @ frames.of(relative) @ matrix(pose)


def _direction(xyz, joint, frames):
    """Return an axis in the joint's own frame, of length one."""
    direction = np.array([float(word) for word in xyz.text.split()])
    if xyz.get("expressed_in"):
        direction = joint[:3, :3].T @ frames.of(xyz.get("expressed_in"))[:3, :3] @ direction
    return direction / np.linalg.norm(direction)


def _inertial(rows, node, path):
    """Fill mass, centre, and the inertia about it in the axes of the link."""
    moments = dict.fromkeys(("ixy", "ixz", "iyz"), 0.0) | dict.fromkeys(("ixx", "iyy", "izz"), 1.0)
    moments |= {child.tag: float(child.text) for child in node.findall("inertia/*")}
    xx, yy, zz, xy, xz, yz = (moments[n] for n in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    place = matrix(node.find("pose"))
    turn = place[:3, :3]
    rows[f"{path}/mass"] = np.array([float(node.findtext("mass", "1"))])
    rows[f"{path}/centre"] = place[:3, 3]
    rows[f"{path}/inertia"] = turn @ [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] @ turn.T


def value(text, kind):
    """Return a text as numbers or bools if possible, with no limit as infinite."""
    text = " ".join(text.split())
    if kind == "bool" or text.lower() in {"true", "false"}:
        return text.lower() in {"true", "1"}
    try:
        if text.startswith("0x"):
            text = str(int(text, 16))
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        return text
    if kind == "color" and len(numbers) == 3:
        numbers = np.append(numbers, 1.0)
    return np.where(abs(numbers) >= ENDLESS, np.copysign(math.inf, numbers), numbers)


def same(one, other, digits=1e-6):
    """Return whether two values are the same up to the digits that printing costs."""
    if not (isinstance(one, np.ndarray) and isinstance(other, np.ndarray)):
        return type(one) is type(other) and bool(np.all(one == other))
    if one.shape != other.shape:
        return False
    if one.shape == (4, 4):  # angles pass through roll, pitch, yaw, bad near a right angle
        steep = abs(other[2, 0]) > 0.9999
        turned = np.allclose(one[:3, :3], other[:3, :3], rtol=0.0, atol=1e-4 if steep else digits)
        return turned and np.allclose(one[:3, 3], other[:3, 3], rtol=digits, atol=1e-7)
    scale = np.max(np.abs(other[np.isfinite(other)]), initial=0.0) if one.ndim == 2 else 0.0
    return np.allclose(one, other, rtol=digits, atol=digits * scale or 1e-9)


def as_urdf(node):
    """Return expanded xacro as URDF text."""
    attributes = "".join(f" {key}={quoteattr(value)}" for key, value in node.attributes.items())
    return f"<{node.tag}{attributes}>{escape(node.text)}{''.join(map(as_urdf, node.children))}</{node.tag}>"


def differences(ours, theirs):
    """Yield differences between two tables, as text."""
    for path in ours.keys() | theirs.keys():
        # what libsdformat moves with a lumped link it prints with six digits
        moved = "/sensor[" in path or "/projector[" in path or "Offset" in path
        if path not in theirs:
            yield f"more: {path} = {ours[path]}"
        elif path not in ours:
            yield f"missing: {path} = {theirs[path]}"
        elif not same(ours[path], theirs[path], 1e-5 if moved else 1e-6):
            yield f"{path}: {ours[path]} is not {theirs[path]}"
