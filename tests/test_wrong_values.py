"""Wrong values for all that is public of a simulation are errors of Gazelle's, see ``wrong_calls``."""

from __future__ import annotations

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
    assert not findings.accepted
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
    "control": 1200,
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
    "simulation": 3400,
    "stage": 1300,
    "training": 2300,
    "viewer": 300,
}
"""With the calls that are made at least."""
RECORDS = {
    *("Blob", "EpisodeRecord", "Evaluation", "Fault", "Fiducial", "GripperState", "ImuReading"),
    *("LaserScan", "ModelState", "PhysicsSettings", "PoseEstimate", "PressureReading"),
    *("RunSummary", "Sample", "SonarReading", "TrainResult", "TrajectoryProgress"),
}
"""Results of calls, which nothing takes: what was measured may be NaN."""


@pytest.mark.slow
@pytest.mark.parametrize("package", PACKAGES)
def test_what_a_package_exports_refuses_wrong_values(package):
    findings = public_sweep.sweep(package)
    assert not findings.foreign
    assert not findings.late
    assert not [
        each
        for each in findings.accepted
        if each.partition("(")[0] not in RECORDS and "(worlds=" not in each  # owners check those
    ]
    assert findings.count > PACKAGES[package]
