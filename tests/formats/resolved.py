"""The oracle program ``resolved.cpp``: libsdformat's own resolved poses, axes and inertias."""

import math
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from gazelle.description import Inertial, Pose
from gazelle.formats import xml

SOURCE = Path(__file__).with_suffix(".cpp")


def build(folder):
    """Return the program compiled, or None where libsdformat's headers are not installed."""
    if shutil.which("g++") is None or shutil.which("pkg-config") is None:
        return None
    config = ["pkg-config", "--cflags", "--libs", "sdformat12"]
    flags = subprocess.run(config, capture_output=True, text=True, check=False)
    if flags.returncode:
        return None
    program = folder / "resolved"
    words = shlex.split(flags.stdout)
    subprocess.run(["g++", "-w", str(SOURCE), "-o", str(program), *words], check=True)
    return program


def run(program, paths, roots=()):
    """Return lines by file: kind and name to the fields; None for a file that it refuses."""
    environ = {**os.environ, "SDF_PATH": ":".join(map(str, roots))}
    command = [str(program), *map(str, paths)]
    done = subprocess.run(
        command, env=environ, capture_output=True, text=True, timeout=300, check=False
    )
    found = {}
    for line in done.stdout.splitlines():
        kind, mark, rest = line.partition("\t")
        if not mark:
            continue  # more of an error
        name, *fields = rest.split("\t")
        if kind == "file":
            lines = found[name] = {}
        elif kind == "error":
            lines["error"] = [*lines.get("error", []), fields[0] if fields else ""]
        else:
            lines[kind, name] = fields
    if done.returncode and len(paths) > 1:  # it crashed: one by one
        found = {}
        for path in paths:
            found |= run(program, [path], roots)
    return found


def numbers(text):
    return [float(word) for word in text.split()]


def pose(text):
    n = numbers(text)
    return Pose.from_quaternion(n[:3], n[3:])


def close(one, other, position=1e-9):
    # angles pass through roll, pitch and yaw on the way, which costs digits near a right angle
    angle = 1e-4 if abs(math.sin(one.pitch)) > 0.9999 else max(1e-6, position)
    return one.is_close(other, position=position * max(1.0, *map(abs, one.position)), angle=angle)


class _Lines(dict):
    """What the oracle says, and how well: libsdformat writes some poses with six digits."""

    position = 1e-9
    sensor = 1e-9


def differences(world, lines, *, merged=False, lumped=False):
    """Yield differences between a world and the oracle, as text."""
    left = _Lines(lines)
    left.position = 1e-5 if merged else 1e-9
    left.sensor = 1e-5 if merged or lumped else 1e-9
    return list(_all(world, left))


def _all(world, lines):
    lines.pop("error", None)
    for light in world.lights:
        yield from _placed(lines, "light", light.name, light.pose)
    written_out = _populations(world)
    for top in world.models:
        if not written_out.fullmatch(top.name) and not _is_actor(top):
            for placed in top.walk():
                yield from _model(placed, lines)
    yield from (f"missing: {kind} {name}" for kind, name in lines)


def _is_actor(model):
    """Return whether it was an actor, which libsdformat does not write as a model."""
    return any("scripted_motion" in plugin.filename for plugin in model.plugins)


def _populations(world):
    """Return names of the models of the file's populations, which libsdformat does not expand."""
    file = world.source.file if world.source else None
    root = None if file is None or not Path(file).exists() else xml.read_file(Path(file))
    worlds = [] if root is None else root.find_all("world")
    found = [node for each in worlds for node in each.find_all("population")]
    names = "|".join(re.escape(node.attributes["name"]) for node in found)
    return re.compile(rf"({names})_clone_\d+" if names else "(?!)")


def _model(placed, lines):
    model, scope = placed.model, placed.scope
    fields = lines.pop(("model", scope), None)
    if fields is None:
        yield f"more: model {scope}"
        return
    if not close(placed.pose, pose(fields[0]), lines.position):
        yield f"model {scope}: {placed.pose} is not {pose(fields[0])}"
    if model.static != (fields[1] == "1"):
        yield f"model {scope}: static {model.static}"
    for link in model.links:
        if model.static:  # its mass plays no part
            lines.pop(("inertial", f"{scope}::{link.name}"), None)
        yield from _link(link, f"{scope}::{link.name}", placed.pose, lines)
    for joint in model.joints:
        yield from _joint(joint, f"{scope}::{joint.name}", lines)
    for frame in model.frames:
        yield from _frame(frame, placed, lines)


def _placed(lines, kind, name, here):
    fields = lines.pop((kind, name), None)
    if fields is None:
        yield f"more: {kind} {name}"
    elif not close(here, pose(fields[0]), lines.sensor if kind == "sensor" else lines.position):
        yield f"{kind} {name}: {here} is not {pose(fields[0])}"


def _link(link, name, outer, lines):
    yield from _placed(lines, "link", name, outer * link.pose)
    for kind in ("collision", "visual", "sensor"):
        for part in getattr(link, f"{kind}s"):
            yield from _placed(lines, kind, f"{name}::{part.name}", part.pose)
    fields = lines.pop(("inertial", name), None)
    if fields is None:
        return
    own = link.inertial or Inertial()
    mass, xx, yy, zz, xy, xz, yz, *rest = numbers(fields[0])
    theirs = Pose.from_quaternion(rest[:3], rest[3:])
    if own.mass != pytest.approx(mass, rel=1e-9):
        yield f"link {name}: mass {own.mass} is not {mass}"
    if math.dist(own.pose.position, theirs.position) > 1e-9:
        yield f"link {name}: centre {own.pose.position} is not {theirs.position}"
    other = _turned(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), theirs)
    mine = _turned(own.inertia.matrix(), own.pose)
    if not np.allclose(mine, other, rtol=1e-9, atol=1e-9 * abs(other).max()):
        yield f"link {name}: inertia {mine.tolist()} is not {other.tolist()}"


def _turned(inertia, place):
    axes = place.matrix()[:3, :3]
    return axes @ inertia @ axes.T


def _joint(joint, name, lines):
    fields = lines.pop(("joint", name), None)
    if fields is None:
        yield f"more: joint {name}"
        return
    parent, child, place, *axes = fields
    if (joint.parent, joint.child) != (parent, child):
        yield f"joint {name}: {joint.parent} to {joint.child} is not {parent} to {child}"
    if not close(joint.pose, pose(place), lines.position):
        yield f"joint {name}: {joint.pose} is not {pose(place)}"
    for own, text in zip(joint.axes, axes, strict=False):
        x, y, z, lower, upper, effort, velocity, damping, friction = numbers(text)
        if own.xyz != pytest.approx((x, y, z), abs=lines.position):
            yield f"joint {name}: axis {own.xyz} is not {(x, y, z)}"
        pairs = {
            "lower": (own.lower, _endless(lower)),
            "upper": (own.upper, _endless(upper)),
            "effort": (own.effort, math.inf if effort < 0 else _endless(effort)),
            "velocity": (own.velocity, math.inf if velocity < 0 else _endless(velocity)),
            "damping": (own.damping, damping),
            "friction": (own.friction, friction),
        }
        for what, (one, two) in pairs.items():
            if one != pytest.approx(two, rel=1e-9):
                yield f"joint {name}: {what} {one} is not {two}"


def _endless(value):
    return math.copysign(math.inf, value) if abs(value) >= 1e16 else value


def _frame(frame, placed, lines):
    name = f"{placed.scope}::{frame.name}"
    fields = lines.pop(("frame", name), None)
    if fields is None:
        return  # of a lumped link, which Gazelle keeps as a frame
    links = {link.name: link.pose for link in placed.model.links}
    here = placed.pose * links.get(frame.attached_to, Pose()) * frame.pose
    inner = "::" in frame.attached_to or frame.attached_to not in {*links, ""}
    if not inner and not close(here, pose(fields[0]), lines.position):
        yield f"frame {name}: {here} is not {pose(fields[0])}"
