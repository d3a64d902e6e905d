"""A Stage file in a ``Simulation``: handles, snapshots, recordings, and models that come and go."""

import numpy as np
import pytest
from stage_samples import write

import gazelle
from gazelle import assets
from gazelle.errors import SimulationError
from gazelle.simulation import Replay, Simulation, WorldPlugin
from gazelle.stage import StageFleet, StageSimulation, stage_of

SCANNER = "ranger ( pose [0 0 -0.2 0] sensor ( range [0 8] fov 180 samples 31 {} ) )"
WORLD = """
interval_sim 50
define robot position ( size [.4 .4 .4] {} )
robot ( name "a" )
robot ( name "b" pose [0 3 0 90] drive "omni" localization "odom" )
robot ( name "c" pose [0 -3 0 0] drive "car" localization "odom" )
model ( name "wall" size [1 9 1] pose [5 0 0 0] )
"""
WANDERING = WORLD.format('ctrl "wander" ' + SCANNER.format(""))
NOISY = WORLD.format(SCANNER.format("noise [.01 0 0]"))
BUSY = (
    WORLD.format(SCANNER.format("noise [.01 0 0.01]"))
    + 'robot ( name "d" pose [-3 0 0 0] gripper ( pose [.3 0 -.4 0] size [.2 .3 .3] ) '
    "actuator ( axis [1 0 0] max_position 2 size [.1 .1 .1] ranger ( sensor ( ) ) ) )"
    'model ( name "thing" size [.1 .1 .3] pose [-2.7 0 0 0] gripper_return 1 )'
)


@pytest.fixture
def open_file(tmp_path):
    made = []

    def make(text, **options):
        file = write(tmp_path, text)
        made.append(Simulation(file, "planar", threads=1, **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()


def test_handles_are_rows_of_the_arrays(open_file):
    sim = open_file(NOISY, nworld=2, seed=4)
    stage = stage_of(sim)
    assert list(sim.robots) == ["ground_plane", "a", "b", "c", "wall"]
    assert sim.clock.step_ns == 50_000_000
    sim.robots["b"].inputs["cmd_vel"].send([[0.1, 0.2, 0.0], [0.3, 0.0, 0.0]], [0.0, 0.4])
    assert stage.commands[:, 1].tolist() == [[0.1, 0.2, 0.0], [0.3, 0.0, 0.4]]
    sim.robots["a"].inputs["cmd_vel"].send(0.5, worlds=np.array([1]))
    assert stage.commands[:, 0].tolist() == [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0]]
    sim.run(1.0)
    assert sim.time == pytest.approx(1.0)
    pose = sim.robots["b"].pose
    assert (pose.x, pose.y) == tuple(stage.poses[0, 1, :2])
    assert (sim.robots["b"].planar_pose() == stage.poses[:, 1]).all()
    sim.robots["a"].inputs["cmd_vel"].clear()
    assert not stage.commands[:, 0].any()
    ranges = sim.robots["a"].sensors["ranger:0"].measure()
    seen = stage.scan(0)[:, 0]
    assert (np.where(seen < 8.0, seen, np.inf) == ranges).all()
    scan = sim.robots["a"].sensors["ranger:0"].read()
    assert scan.angle_max == pytest.approx(np.pi / 2)
    assert (scan.range_min, scan.range_max) == (0.0, 8.0)


def test_it_is_what_a_stage_simulation_is(open_file, tmp_path):
    sim = open_file(WANDERING, seed=3)
    with StageSimulation(write(tmp_path, WANDERING), seed=3, threads=1) as other:
        sim.step(120)
        other.step(120)
        for name in ("poses", "commands", "odometry", "stalled", "true_velocities"):
            assert np.array_equal(getattr(stage_of(sim), name), getattr(other, name)), name


def test_a_reset_begins_anew(open_file):
    sim = open_file(WANDERING, seed=3)
    sim.step(60)
    first = sim.state_hash()
    sim.reset()
    assert sim.time == 0.0
    assert not stage_of(sim).commands.any()
    sim.step(60)
    assert sim.state_hash() == first
    sim.reset(seed=8)
    sim.step(60)
    sim.reset(seed=3)
    sim.step(60)
    assert stage_of(sim).odometry.any()


@pytest.mark.parametrize("text", [WANDERING, NOISY, BUSY])
def test_a_snapshot_goes_on_as_the_run_did(open_file, text):
    sim = open_file(text, nworld=2, seed=1)
    for name in ("a", "b", "c"):
        sim.robots[name].inputs["cmd_vel"].send(0.3, 0.2)
    if text is BUSY:
        stage_of(sim).gripper("d").do("close")
        stage_of(sim).actuator("d").set_speed(0.3)
    sim.step(20)
    saved = sim.snapshot()

    def look():
        sim.step(20)
        stage = stage_of(sim)
        names = ("poses", "odometry", "commands", "true_velocities")
        seen = [getattr(stage, name).copy() for name in names]
        return [*seen, *(stage.scan(k).copy() for k in range(stage.scanners))]

    first = look()
    sim.restore(saved)
    assert sim.time == pytest.approx(1.0)
    for one, other in zip(first, look(), strict=True):
        assert np.array_equal(one, other)
    twin = open_file(text, nworld=2, seed=7)
    twin.restore(saved)
    twin.step(20)
    assert np.array_equal(stage_of(twin).odometry, first[1])


@pytest.mark.parametrize("text", [WANDERING, BUSY])
def test_a_recording_is_done_again_to_the_bit(open_file, tmp_path, text):
    sim, quiet = open_file(text, seed=1), open_file(text, seed=1)
    for each in (sim, quiet):
        each.robots["b"].inputs["cmd_vel"].send(0.3, 0.2)
        if text is BUSY:
            stage_of(each).gripper("d").do("close")
            stage_of(each).actuator("d").go_to(1.0)
        each.step(3)
    with sim.record(tmp_path / "run.jsonl"):
        sim.step(40)
        stage_of(sim).set_pose("a", (0.0, -1.5, 2.0))
        sim.robots["a"].inputs["cmd_vel"].send(-0.2)
        sim.step(10)
    quiet.step(40)
    stage_of(quiet).set_pose("a", (0.0, -1.5, 2.0))
    quiet.robots["a"].inputs["cmd_vel"].send(-0.2)
    quiet.step(10)
    assert sim.state_hash() == quiet.state_hash()
    with Replay(tmp_path / "run.jsonl") as replay:
        assert replay.run() > 0
        assert replay.simulation.state_hash() == sim.state_hash()
        assert np.array_equal(stage_of(replay.simulation).poses, stage_of(sim).poses)


def test_models_come_and_go(open_file):
    sim = open_file(WANDERING, seed=1)
    sim.step(30)
    stage = stage_of(sim)
    believed, poses = stage.odometry.copy(), stage.poses.copy()
    burger = sim.spawn("turtlebot3_burger", pose=gazelle.Pose(-2.0, 0.0, 0.0))
    assert np.array_equal(stage.odometry, believed)
    sim.spawn(sim.world.models[1], name="e", pose=gazelle.Pose(0.0, -6.0, 0.0))
    assert [robot.name for robot in stage.robots] == ["a", "b", "c", "e"]
    assert np.array_equal(stage.poses[:, :3], poses)
    assert stage.poses[0, 3].tolist() == [0.0, -6.0, 0.0]
    assert "ranger:0" in sim.robots["e"].sensors
    burger.inputs["cmd_vel"].send(0.1)
    sim.step(40)
    assert burger.pose.x > -1.95
    assert (stage.poses[0, :, :2] != 0.0).any()
    assert np.isfinite(burger.sensors["lds_lfcd_sensor"].measure()).any()
    believed, poses = stage.odometry.copy(), stage.poses.copy()
    sim.delete("b")
    assert [robot.name for robot in stage.robots] == ["a", "c", "e"]
    assert np.array_equal(stage.poses, poses[:, [0, 2, 3]])
    assert np.array_equal(stage.odometry, believed[:, [0, 2, 3]])
    sim.delete("wall")
    sim.step(10)
    assert "b" not in sim.robots


def test_what_is_carried_stays_so_when_models_come(open_file):
    sim = open_file(BUSY)
    gripper = stage_of(sim).gripper("d")
    gripper.do("close")
    sim.step(30)
    assert stage_of(sim).gripper("d").state().carried == "thing"
    sim.spawn("turtlebot3_burger", pose=gazelle.Pose(9.0, 9.0, 0.0))
    assert stage_of(sim).gripper("d").state().carried == "thing"
    sim.step(5)
    sim.delete("thing")
    sim.step(5)
    assert "thing" not in sim.robots


def test_plugins_and_listeners_act_beside(open_file):
    sim = open_file(WANDERING)
    times, asked = [], []

    class Watch(WorldPlugin):
        update_rate = 0.0

        def on_update(self, time):
            asked.append(time)

    sim.load_plugin(f"{__name__}:_Nothing")
    end = sim.subscribe(lambda: times.append(round(sim.time, 9)))
    sim.step(3)
    end()
    sim.step(3)
    assert times == [0.05, 0.1, 0.15]


class _Nothing(WorldPlugin):
    """A plugin of a user's, which keeps Python in every step."""

    update_rate = 0.0


def test_it_does_not_matter_who_else_acts(open_file):
    alone, beside = open_file(WANDERING, seed=5), open_file(WANDERING, seed=5)
    beside.load_plugin(f"{__name__}:_Nothing")
    alone.step(50)
    beside.step(50)
    assert np.array_equal(stage_of(alone).poses, stage_of(beside).poses)


def test_static_models_can_be_moved(open_file):
    sim = open_file(NOISY.replace("noise [.01 0 0]", ""))
    middle = sim.robots["a"].sensors["ranger:0"].measure()[0, 15]
    assert middle == pytest.approx(4.5)
    sim.robots["wall"].set_pose([6.0, 0.0, 0.0])
    assert sim.robots["a"].sensors["ranger:0"].measure()[0, 15] == pytest.approx(5.5)
    sim.step(2)
    assert stage_of(sim).poses.shape == (1, 3, 3)


def test_the_bundled_fleet_is_a_world_like_any_other():
    with Simulation(assets.world("fleet"), "planar") as sim:
        assert len(stage_of(sim).robots) == 72
        sim.robots[stage_of(sim).robots[40].name].inputs["cmd_vel"].send(0.3)
        sim.step(5)
        assert (stage_of(sim).velocities[0, :, 0] != 0.0).nonzero()[0].tolist() == [40]


def test_other_engines_run_its_bodies(tmp_path):
    with Simulation(write(tmp_path, WANDERING), "mujoco") as sim:
        assert sim.extension(StageFleet) is None
        with pytest.raises(SimulationError, match="not a world of Stage"):
            stage_of(sim)
        sim.robots["a"].inputs["cmd_vel"].send(0.4)
        sim.run(0.5)
        assert sim.robots["a"].pose.x > 0.05  # it stands 0.2 s after its last command


def test_odometry_goes_on_with_another_time_step(open_file):
    sim = open_file(WORLD.format(""))
    stage_of(sim).commands[:, 1] = (0.3, 0.1, 0.2)
    sim.run(1.0)
    sim.physics.time_step = 0.01
    sim.run(1.0)
    assert sim.time == pytest.approx(2.0)
    turned = stage_of(sim).odometry[0, 1, 2]
    assert turned == pytest.approx(0.4, rel=0.03)  # its share of error is 2.5 % at most


def test_many_robots_are_placed_at_once_and_bumps_are_kept(open_file):
    sim = open_file(WORLD.format(""), nworld=2)
    stage = stage_of(sim)
    bumped = stage.bumped
    stage.commands[1, 0, 0] = 1.0
    stage.place(np.array([0, 3]), [[1.0, 1.0, 0.5], [4.2, 0.0, 0.0]])
    assert stage.poses[0, 0].tolist() == [1.0, 1.0, 0.5]
    assert stage.poses[1, 0].tolist() == [4.2, 0.0, 0.0]
    assert not stage.commands.any()
    assert not stage.true_velocities.any()
    stage.commands[1, 0, 0] = 1.0
    sim.step(4)
    assert bumped.tolist() == [[False, False, False], [True, False, False]]
    stage.commands[1, 0, 0] = -1.0
    sim.step(4)
    assert not stage.stalled.any()
    assert stage.bumped[1, 0]
    bumped[:] = False
    sim.step()
    assert not stage.bumped.any()


def test_cameras_are_sensors_too(open_file):
    eye = "camera ( resolution [16 12] range [0.2 8] fov [60 45] )"
    swivel = f'actuator ( type "rotational" max_position 3 size [.1 .1 .1] {eye} )'
    sim = open_file(WORLD.format(eye + swivel + SCANNER.format("")), nworld=2)
    stage_of(sim).set_pose("a", [[0.0, 0.0, 0.0], [0.0, 0.0, 3.0]])
    sensors = sim.robots["a"].sensors
    assert set(sensors) == {"camera:0", "actuator:0.camera:0", "ranger:0"}
    for which, name in enumerate(("camera:0", "actuator:0.camera:0")):
        for world in range(2):
            image = sensors[name].read(world)
            seen = stage_of(sim).picture("a", which, world)
            assert np.array_equal(image.color, seen.color[..., :3])
            assert np.array_equal(image.depth, seen.depth)
    assert np.isfinite(sensors["camera:0"].read(0).depth).any()


def test_outputs_tell_what_stage_ros_would(open_file):
    sim = open_file(NOISY, nworld=2)
    robot, told = sim.robots["b"], []
    assert set(robot.outputs) == {"base_scan", "odom"}
    robot.inputs["cmd_vel"].send(0.4, 0.2)
    end = robot.outputs["odom"].subscribe(told.append)
    sim.step(3)
    end()
    sim.step(3)
    assert [odometry.stamp for odometry in told] == [50_000_000, 100_000_000, 150_000_000]
    assert (told[-1].frame, told[-1].child_frame) == ("robot_1/odom", "robot_1/base_footprint")
    assert told[-1].linear[:, 0] == pytest.approx(0.4)
    now = robot.outputs["odom"].last
    assert np.array_equal(now.position[:, :2], stage_of(sim).odometry[:, 1, :2])
    assert robot.outputs["base_scan"].topic == "/robot_1/base_scan"
    assert robot.outputs["base_scan"].last.ranges.shape[-1] == 31
