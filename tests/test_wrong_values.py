"""Wrong values for all that is public of a simulation are errors of Gazelle's, see ``wrong_calls``."""

from __future__ import annotations

import re
import tempfile

import public_handles
import public_sweep
import pytest
import scenes
import wrong_calls
from wrong_calls import Findings
from wrong_values import shown

from gazelle import Simulation, control, engines, simulation
from gazelle.description import Pose
from gazelle.sensors import View, look_at

# Called by the owner of the thing, with what it made itself.
OWN = {
    "InitialPoses": {"apply", "forget", "restore"},
    "Robot": {"add_manager", "back_to", "bind", "mark"},
    "SensorUnit": {"join", "leave", "reading", "reseed", "reset", "restore", "update"},
    "TwistInput": {"keep_in", "store_in"},
    "WorldParameters": {"reseed", "restore"},
}
ENDING = {"close", "pause", "unpause"}


@pytest.fixture(autouse=True)
def traces(monkeypatch, tmp_path):
    """Remove at the end of each test what calls leave behind.

    They register engines under wrong names, and record simulations that diverge.
    """
    for module in (control.registry, engines.registry, simulation.registry):
        monkeypatch.setattr(module, "_registered", dict(module._registered))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))


def world():
    return scenes.world(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(1.0, 1.0, 1.0)))


def skipped(handle, name):
    kind = public_handles.kind_of(handle).__name__
    return kind == "AppliedWrenches" or name in ENDING or name in OWN.get(kind, ())


def good_values(sim):
    """Return good values of a call, by the parameter's name or by what it is."""
    robot = sim.robots["burger"]
    named = {
        "view": View(look_at((2.0, 2.0, 2.0), (0.0, 0.0, 0.0)), 4, 4),
        "parent": next(iter(robot.links.values())),
        "child": sim.robots["box"].links["link"],
        "model": scenes.box("new"),
        "joint": "wheel_left_joint",
        "link": "burger::base_footprint",
        "position": (0.0, 0.0, 0.0),
        "seconds": 0.001,
        "path": "file.jsonl",
        "listener": lambda *_: None,
    }
    by_word = {
        "Vector3": (0.0, 0.0, 1.0),
        "ArrayLike": 1.0,
        "Sequence": [],
        "str": "a",
        "float": 1.0,
    }

    def good(name, annotation):
        found = (value for word, value in by_word.items() if word in annotation)
        return named[name] if name in named else next(found, 1)

    return good


def kinds(sim):
    """Return a path for each kind of handle, and for each port and sensor."""
    found = {}
    for path, handle in public_handles.handles(sim):
        kind = public_handles.kind_of(handle).__name__
        alone = kind in ("Input", "Output", "SensorUnit", "Service", "Tuning")
        found.setdefault(path if alone else (kind, path.count("[")), path)
    return list(found.values())


@pytest.mark.slow
@pytest.mark.parametrize("nworld", [1, 2])
@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_handles_refuse_wrong_values(engine, nworld):
    findings = Findings()
    with wrong_calls.limits():
        sim = Simulation(world(), engine, nworld=nworld, threads=1)
        for path in kinds(sim):
            handle = dict(public_handles.handles(sim))[path]
            wrong_calls.try_members(path, handle, good_values(sim), findings, skipped)
            if path != "sim":
                findings.attempt(f"a step after {path}", sim.step)
            if path == "sim" or not {"burger", "box"} <= set(sim.robots):
                sim.close()
                sim = Simulation(world(), engine, nworld=nworld, threads=1)
        sim.close()
    assert not findings.foreign
    assert not findings.late
    assert findings.count > 1800


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_a_simulation_refuses_wrong_values(engine):
    findings = Findings()

    def make(positional, named):
        with Simulation(*positional, **{"engine": engine, **named}) as sim:
            sim.step()

    with wrong_calls.limits():
        for name, value, positional, named in wrong_calls.calls(Simulation, lambda *_: world()):
            what = f"Simulation({name}={shown(value)})"
            findings.attempt(what, lambda p=positional, n=named: make(p, n))
    assert not findings.foreign
    assert findings.count > 90


PACKAGES = {
    "actions": 150,
    "assets": 25,
    "bags": 130,
    "bridges": 75,
    "builders": 3000,
    "clients": 1500,
    "control": 1300,
    "costmap": 600,
    "deploy": 450,
    "description": 4500,
    "engines": 400,
    "envs": 1000,
    "estimation": 600,
    "formats": 650,
    "frames": 280,
    "gazelle": 800,
    "kinematics": 500,
    "launch": 700,
    "localization": 650,
    "mapping": 600,
    "messages": 110,
    "move_base": 250,
    "mujoco": 200,
    "navigation": 800,
    "planar": 1300,
    "planners": 150,
    "planning": 2500,
    "rendering": 500,
    "robot": 120,
    "ros": 850,
    "sensors": 3000,
    "simulation": 3500,
    "stage": 1300,
    "training": 2300,
    "viewer": 300,
}
"""With the calls that are made at least."""
MEASURED = {
    *(
        "Blob",
        "EpisodeRecord",
        "GoalResult",
        "OdometryReading",
        "ScanReading",
        "Evaluation",
        "Fault",
        "Fiducial",
        "GripperState",
        "ImuReading",
    ),
    *(
        "LaserScan",
        "Measurement",
        "ModelState",
        "VelocityCommand",
        "PhysicsSettings",
        "PlanarScan",
        "PoseEstimate",
    ),
    *(
        "PressureReading",
        "RunSummary",
        "Sample",
        "SonarReading",
        "TrainResult",
        "TrajectoryProgress",
    ),
}
"""Records of what was measured, which may be NaN; users of those check it.

``PhysicsSettings`` is what Gazebo answers; a scan with NaN favours no pose.
"""
COMPUTED = {"Model.walk", "PlacedModel", "Pose", "Pose.exactly", "TreeJoint", "TreeJoint.placed"}
"""Poses, which also come from worlds that diverged, where NaN is the answer; descriptions take none."""
REFUSED_BY_PORT = {"GoalPose"}
"""Values that messages hold too; the port they are sent to refuses what is not finite."""
LOOP = "catch_up|measure|noisy|on_update|read|starting|stopping|update|write"
PILOT = "angles|arm|blocked|set_odometry|set_scan|tick"
TIMED = re.compile(rf"\w+\.({LOOP}|{PILOT})")
"""Steps of a loop, which are called with its clock's time."""
OF_ONE_WORLD = {
    *("Costmap.place_of", "FrameTree.place", "JointArray.drive", "JointHandle.drive"),
    *("JointHandle.effort", "NoiseModel.apply", "Pose.is_close"),
}
"""They return NaN, say that they ignore it, or end their own world only, as a policy may command it."""


def takes_nan(call):
    """Return whether a call may take NaN."""
    known = MEASURED | COMPUTED | REFUSED_BY_PORT | OF_ONE_WORLD
    return call in known or TIMED.fullmatch(call) is not None


@pytest.mark.slow
@pytest.mark.parametrize("package", PACKAGES)
def test_what_a_package_exports_refuses_wrong_values(package):
    findings = public_sweep.sweep(package)
    assert not findings.foreign
    assert not findings.late
    calls = {each.partition("(")[0] for each in findings.accepted}
    assert not {each for each in calls if not takes_nan(each)}
    assert findings.count > PACKAGES[package]
