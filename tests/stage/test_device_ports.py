"""Devices of Stage's robots as ordinary inputs and outputs, and plugins of one's own on them."""

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest
from stage_samples import write

from gazelle.description import Parameters, Plugin
from gazelle.errors import SimulationError
from gazelle.formats import load, load_string, to_string
from gazelle.simulation import ModelPlugin, Simulation, register, registry
from gazelle.stage import Blob, Fiducial, GripperState, stage_of

DEVICES = """
interval_sim 100
define robot position ( size [.4 .4 .4] )
robot ( name "a"
  bumper ( bcount 1 bpose[0] [.2 0 0 0] blength .4 noblocks 1 )
  fiducial ( range_max 8 fov 180 )
  blobfinder ( colors_count 1 colors [ "red" ] range 12 fov 180 )
  gripper ( pose [-.3 0 -.4 180] size [.2 .3 .3] )
  gripper ( name "left" pose [0 .5 -.4 0] size [.2 .3 .3] )
  actuator ( axis [1 0 0] max_position 2 size [.1 .1 .1] )
)
robot ( name "b" pose [0 4 0 0] )
model ( name "post" pose [2 0 0 0] size [.3 .3 1] color "red" fiducial_return 7 )
"""


@pytest.fixture
def open_file(tmp_path):
    made = []

    def make(text, **options):
        made.append(Simulation(write(tmp_path, text), "planar", threads=1, **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()


@pytest.fixture
def sim(open_file):
    return open_file(DEVICES, nworld=2)


def named(ports, word):
    return sorted(name for name in ports if word in name)


def test_every_device_is_there_by_its_name_in_the_file(sim):
    robot = sim.robots["a"]
    for word in ("bumper", "fiducial", "blobfinder", "gripper", "actuator"):
        assert named(robot.outputs, word), word
    assert "left" in robot.outputs
    assert "left" in robot.inputs
    assert len(named(robot.inputs, "actuator")) == 2
    assert not named(sim.robots["b"].outputs, "gripper")


def test_outputs_say_what_the_methods_say_in_each_world(sim):
    robot, stage = sim.robots["a"], stage_of(sim)
    stage.set_pose("a", (1.64, 0.0, 0.0), worlds=np.array([1]))
    sim.step()
    (finder,), (blobs,) = named(robot.outputs, "fiducial"), named(robot.outputs, "blobfinder")
    (bumper,) = named(robot.outputs, "bumper")
    for world in range(2):
        assert robot.outputs[finder].last[world] == tuple(stage.fiducials("a", 0, world))
        assert robot.outputs[blobs].last[world] == tuple(stage.blobs("a", 0, world))
        assert robot.outputs[bumper].last[world] == stage.bumps("a", 0, world)
    far, near = robot.outputs[finder].last
    assert isinstance(far[0], Fiducial)
    assert far[0].id == 7
    assert far[0].distance > near[0].distance
    assert isinstance(robot.outputs[blobs].last[0][0], Blob)
    assert robot.outputs[bumper].last == ((None,), ("post",))


def test_inputs_move_grippers_and_actuators_in_some_worlds(sim):
    robot = sim.robots["a"]
    (first,) = named(robot.inputs, "gripper")
    robot.inputs[first].send("close", worlds=np.array([1]))
    robot.inputs["left"].send("up")
    speed, position = named(robot.inputs, "actuator")[::-1]
    robot.inputs[speed].send(0.5, worlds=np.array([0]))
    robot.inputs[position].send(1.0, worlds=np.array([1]))
    sim.step(30)
    open_, closed = robot.outputs[first].last
    assert isinstance(closed, GripperState)
    assert (open_.paddles, closed.paddles) == (0.0, 1.0)
    assert [each.lift for each in robot.outputs["left"].last] == [1.0, 1.0]
    (actuator,) = named(robot.outputs, "actuator")
    assert robot.outputs[actuator].last == pytest.approx((1.5, 1.0), abs=0.05)
    with pytest.raises(SimulationError, match="no command 'clsoe'"):
        robot.inputs[first].send("clsoe")


def test_who_listens_hears_after_every_step_until_it_ends(sim):
    robot, heard = sim.robots["a"], []
    (actuator,) = named(robot.outputs, "actuator")
    end = robot.outputs[actuator].subscribe(heard.append)
    robot.inputs[f"{actuator}/speed"].send(0.1)
    sim.step(3)
    assert [each[0] for each in heard] == pytest.approx([0.01, 0.02, 0.03])
    end()
    sim.step()
    assert len(heard) == 3


def test_ports_follow_their_robot_when_others_go(sim):
    robot = sim.robots["a"]
    (finder,) = named(robot.outputs, "fiducial")
    sim.delete("b")
    sim.step()
    assert robot.outputs[finder].last[0] == tuple(stage_of(sim).fiducials("a"))


class Shove(ModelPlugin):
    """Stands in for a drive of somebody's own."""

    loaded: ClassVar[list] = []

    def load(self, robot, parameters):
        self.loaded.append(robot.name)


@pytest.mark.parametrize("filename", ["libgazebo_ros_planar_move.so", "libmine.so"])
def test_a_plugin_of_ones_own_runs_on_a_stage_robot(tmp_path, monkeypatch, filename):
    monkeypatch.setattr(Shove, "loaded", [])
    monkeypatch.setattr(registry, "_registered", {})
    register("libmine.so", Shove)
    world = load(write(tmp_path, DEVICES))
    own = Plugin("own", filename, Parameters("plugin"))
    models = [replace(m, plugins=(*m.plugins, own)) if m.name == "b" else m for m in world.models]
    with Simulation(replace(world, models=tuple(models)), "planar") as sim:
        started = [entry.owner for entry in sim.plugins if entry.name == "own"]
        assert started == ["b"]
        assert Shove.loaded == (["b"] if filename == "libmine.so" else [])
        assert [e.name for e in sim.plugins if e.owner == "a"] == []


def test_the_stand_ins_are_ordinary_plugins_in_other_engines(tmp_path):
    world = load(write(tmp_path, DEVICES))
    again = load_string(to_string(world, "sdf"))
    (robot,) = [m for m in again.models if m.name == "b"]
    assert [p.filename for p in robot.plugins] == ["libgazebo_ros_planar_move.so"]


WANDER = """
interval_sim 100
position ( name "r" size [.4 .4 .4] ctrl "wander" ranger ( pose [0 0 -.2 0] sensor ( range [0 8] fov 180 samples 31 ) ) )
model ( size [1 9 1] pose [2 0 0 0] )
"""


def test_a_reset_of_some_worlds_resets_what_wander_does_there(open_file):
    sim, fresh = open_file(WANDER, nworld=3, seed=5), open_file(WANDER, nworld=3, seed=5)
    (wander,) = stage_of(sim).controllers
    while not wander.state()["turn_state"][:, 0].all():
        sim.step()
    sim.reset(worlds=[1])
    turn_state = wander.state()["turn_state"]
    assert turn_state[1].tolist() == [0, 0]
    assert turn_state[0].any()
    assert turn_state[2].any()
    (other,) = stage_of(fresh).controllers
    assert other.state()["turn_state"][1].tolist() == turn_state[1].tolist()
