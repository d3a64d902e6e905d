"""Wrong values in calls of several rooms are errors of Gazelle's; the slow sweeps try all calls."""

from __future__ import annotations

import math

import numpy as np
import pytest

import gazelle_ros as ros
from gazelle.argument_checks import checked
from gazelle.control import EFFORT, ControllerManager, JointStateInterface, RobotHardware
from gazelle.control.parameters import ControllerParameters
from gazelle.control.ports import rows_of
from gazelle.description import Inertia, OccupancyMap, Pose
from gazelle.engines import planar
from gazelle.errors import ControlError, EngineError, Error, FormatError, RosError, SimulationError
from gazelle.formats import Resolver, save_map, write_text
from gazelle.sensors import NoiseModel, View
from gazelle.sensors.noise import NO_NOISE
from gazelle.sensors.rendering import directions_of_view
from gazelle.simulation import Clock, Replay, Schedule
from gazelle.stage.description.devices import StageActuator, StageSensor
from gazelle.stage.description.models import StageBlock, StageModel, StagePose, StageWorld
from gazelle.training.runs import Run, RunConfig
from gazelle_ros.launch import LaunchError, load_launch_text
from gazelle_ros.master.proxy import MasterProxy

HUGE = 10**400


@checked(SimulationError, after=True)
def ratio(of: float, to: float = 1.0) -> float:
    return of / to


def test_what_computes_first_says_what_it_could_not_take():
    assert math.isnan(ratio(math.nan))  # it can be computed with
    with pytest.raises(SimulationError, match="'of' must be less than"):
        ratio(HUGE)
    with pytest.raises(SimulationError, match="ratio cannot take these values: float division"):
        ratio(1.0, 0.0)
    with pytest.raises(TypeError, match="unexpected keyword"):
        ratio(1.0, by=2.0)


@checked(SimulationError, after=True)
class Share:
    def __init__(self, of: float) -> None:
        self.of = of

    def doubled(self, by: float) -> float:
        return self.of * by


@pytest.mark.parametrize("of", [math.nan, math.inf, HUGE])
def test_constructors_check_first_also_where_methods_do_not(of):
    with pytest.raises(SimulationError, match="'of' must be"):
        Share(of)
    assert math.isnan(Share(2.0).doubled(math.nan))


@pytest.mark.parametrize(
    "call",
    [
        lambda: Pose(HUGE),
        lambda: Pose(yaw=HUGE),
        lambda: Pose.from_quaternion((HUGE, 0.0, 0.0)),
        lambda: Pose.from_quaternion(quaternion=()),
        lambda: Pose.from_matrix(np.zeros(3)),
        lambda: Pose().apply([1.0]),
        lambda: Inertia.from_matrix([1.0, 2.0]),
        lambda: Inertia.from_matrix([[0.0], [1.0, 2.0]]),
    ],
)
def test_parts_of_descriptions(call):
    with pytest.raises(FormatError):
        call()


@pytest.mark.parametrize("shape", [(), (3,), (2, 2, 2)])
def test_maps_without_rows(shape, tmp_path):
    with pytest.raises(FormatError, match="the cells of a map must be rows"):
        save_map(OccupancyMap(np.zeros(shape, np.int8), 0.1), tmp_path / "map")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("file", "text"), [(None, ""), ("file", None), ("\0", ""), ("a" * 300, ""), ("f", "\ud800")]
)
def test_texts_that_cannot_be_written(file, text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FormatError):
        write_text(file, text)


def test_names_that_no_folder_has():
    resolver = Resolver()
    for name in ("a" * 300, "\0", "\ud800", "..", ""):
        assert (
            resolver.package(name) is resolver.model(name) is resolver.bundled_model(name) is None
        )


@pytest.mark.parametrize(
    "change",
    [
        {"width": -1},
        {"height": 0},
        {"width": 2**31},
        {"horizontal_fov": math.nan},
        {"horizontal_fov": 0.0},
        {"pose": Pose(math.inf)},
    ],
)
def test_views_that_cannot_be(change):
    with pytest.raises(SimulationError):
        directions_of_view(View(**{"pose": Pose(), "width": 4, "height": 4, **change}), 1)


def test_noise_in_too_many_worlds():
    for nworld, channels in ((-1, 1), (2**31, 1), (1, HUGE)):
        with pytest.raises(SimulationError):
            NoiseModel(NO_NOISE, 0, "noise", nworld, channels)


@pytest.mark.parametrize("worlds", [[-1], [2], [math.nan], [2**70], [[0]], [True], [[0], [0, 1]]])
def test_worlds_of_controllers(worlds):
    with pytest.raises(ControlError, match="worlds must be"):
        rows_of(worlds, 2)


def test_calls_of_control():
    hardware = RobotHardware(2)
    hardware.register_joints(["a"], {EFFORT: ["a"]})
    handles, manager = hardware.interface(EFFORT).handles(["a"]), ControllerManager(hardware)
    for call in (
        lambda: handles.command("no such"),
        lambda: handles.set_command(np.zeros((3, 7))),
        lambda: JointStateInterface(["a"], -1),
        lambda: hardware.register_joints(["b"], {"no such": ["b"]}),
        lambda: manager.update(HUGE, 0.1),
        lambda: ControllerParameters({}, "here")["no such"],
    ):
        with pytest.raises(ControlError):
            call()
    assert ControllerParameters({}, "here").get("no such") is None


@pytest.mark.parametrize("step", [math.nan, math.inf, 0.0, -1.0, 1e308])
def test_clocks(step):
    with pytest.raises(Error, match="step"):
        Clock(step)


def test_times():
    schedule = Schedule(10.0)
    for call in (lambda: schedule.done(HUGE), lambda: Clock(0.001).steps_in(math.inf)):
        with pytest.raises(SimulationError):
            call()
    for seconds in (math.nan, math.inf, -math.inf):
        for call in (ros.Time, ros.Duration, ros.Time.from_sec):
            with pytest.raises(RosError, match="finite"):
                call(seconds)
            with pytest.raises(ValueError, match="finite"):  # genpy's
                call(seconds)


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf, 10**400])
def test_parts_of_stage_worlds(number):
    for call in (
        lambda: StageSensor(range=(0.0, number)),
        lambda: StageModel("model", "a", pose=StagePose(number)),
        lambda: StageBlock(((0.0, number),), (0.0, 1.0)),
        lambda: StageActuator(start=number),
        lambda: StageWorld(interval_sim=number),
    ):
        with pytest.raises(FormatError, match=r"finite|less than"):
            call()


@pytest.mark.parametrize("number", [math.nan, math.inf, HUGE])
def test_parts_of_planar_sensors(number):
    for call in (
        lambda: planar.Fan(0.0, 0.1, 3, number),
        lambda: planar.Mount(0, number),
        lambda: planar.RangeNoise(share=number),
    ):
        with pytest.raises(EngineError, match=r"finite|less than"):
            call()


def test_launch_files_that_no_file_holds():
    with pytest.raises(LaunchError, match="not well-formed"):
        load_launch_text("\ud800")


@pytest.mark.parametrize("seconds", [math.nan, math.inf, HUGE, 0.0, -1.0])
def test_times_that_no_master_has(seconds):
    with pytest.raises(RosError, match="timeout must be above 0"):
        MasterProxy("http://localhost:1", "/a", seconds)


@pytest.mark.parametrize("path", ["no such", "/", "/dev/null/a", "a" * 300, "\0", "\ud800"])
def test_recordings_that_there_are_not(path):
    with pytest.raises(SimulationError, match="cannot be read"):
        Replay(path)


def test_fields_that_a_run_does_not_have(tmp_path):
    run = Run(tmp_path, RunConfig(task="CartPole", recipe=None, seed=0))
    with pytest.raises(Error, match=r"has no field 'sed'.*seed"):
        run.changed(sed=1)
