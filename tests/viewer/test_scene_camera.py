"""Pictures and films of worlds in space, recordings, bags and policies."""

import shlex
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, ImageSequence

from gazelle import assets, formats
from gazelle.cli.main import main
from gazelle.errors import Error, RosError
from gazelle.rendering import PinholeLens
from gazelle.sensors import look_at
from gazelle.simulation import Simulation
from gazelle.viewer import SceneCamera, film
from gazelle.viewer.scene_camera import distance_to_see
from gazelle.viewer.sources import BagSource, RecordingSource, picture_of, pictures_of
from gazelle_ros import load_message
from gazelle_ros.bags import Bag

side = st.floats(0.01, 50.0)
away = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.1, 1))


@given(st.tuples(side, side, side), away, st.floats(0.3, 2.5), st.integers(40, 400))
def test_a_whole_box_is_seen_and_hardly_more(half, aside, fov, height):
    lens = PinholeLens(240, height, fov)
    eye = np.array(aside) * distance_to_see(np.array(half), np.array(aside), lens)
    pose = look_at(tuple(eye), (0.0, 0.0, 0.0))
    corners = np.array(np.meshgrid(*((-s, s) for s in half))).reshape(3, -1).T
    forward, left, up = ((corners - eye) @ np.array(pose.matrix())[:3, :3]).T
    assert (forward > 0).all()
    across = np.abs(lens.focal * left / forward) / (lens.width / 2)
    down = np.abs(lens.focal * up / forward) / (lens.height / 2)
    assert max(across.max(), down.max()) < 1.0


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_a_robot_is_seen_to_move_and_is_followed(engine):
    with Simulation(assets.world("turtlebot3_stage_1"), engine, threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        camera = SceneCamera(sim, size=(240, 160))
        behind = SceneCamera(sim, size=(240, 160), follow="turtlebot3_burger")
        still, near = camera.render(), behind.render()
        assert still.shape == (160, 240, 3)
        assert (camera.render() == still).all()
        robot.set_pose((0.8, 0.3, 0.0))
        moved = np.abs(camera.render().astype(int) - still).max(axis=2) > 25
        assert 5 < moved.sum() < 0.1 * moved.size
        # What is around it is elsewhere, and it is where it was.
        middle = np.abs(behind.render().astype(int) - near)[70:90, 110:130]
        assert np.median(middle) < 10
        with pytest.raises(Error, match="no model"):
            SceneCamera(sim, follow="nobody")
        with pytest.raises(Error, match="no world"):
            SceneCamera(sim, world=1)


WALL = """<sdf version="1.7"><model name="wall"><static>1</static><link name="l">
<pose>{0} 0 1 0 0 0</pose><collision name="c"><geometry><box><size>{1} 9 2</size></box></geometry>
</collision><visual name="v"><geometry><box><size>{1} 9 2</size></box></geometry></visual></link>
</model></sdf>"""


@pytest.mark.parametrize(
    ("engine", "x", "thick"),
    [("mujoco", -0.6, 0.1), ("mujoco", -1.5, 1.0), ("mujoco", -3.0, 4.0), ("planar", -1.5, 1.0)],
)
def test_a_camera_that_follows_looks_from_where_nothing_is_in_the_way(engine, x, thick):
    with Simulation("empty", engine, threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        sim.spawn(formats.load_model_string(WALL.format(x, thick)))
        camera = SceneCamera(sim, size=(240, 160), follow="turtlebot3_burger")
        with_it = camera.render()
        robot.set_pose((50.0, 0.0, 0.0))
        camera._follow, camera._dodges = "", False
        gone = np.abs(camera.render().astype(int) - with_it).max(axis=2) > 25
        assert gone[60:100, 90:150].mean() > 0.05


def test_a_robot_that_drives_behind_walls_stays_in_sight():
    with Simulation("empty", threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        sim.spawn(formats.load_model_string(WALL.format(2.0, 0.1)))
        camera = SceneCamera(sim, size=(120, 80), follow="turtlebot3_burger")
        hidden = SceneCamera(
            sim,
            size=(120, 80),
            follow="turtlebot3_burger",
            eye=(-1.6, -1.0, 1.2),
            target=(0, 0, 0.1),
        )
        for x, seen in ((0.0, True), (2.5, False), (3.0, False), (5.0, True)):
            shares = [_share_of_robot(each, robot, x) for each in (camera, hidden)]
            assert shares[0] > 0.02
            assert (shares[1] > 0.02) == seen


def _share_of_robot(camera, robot, x):
    """Return the share of pixels in the middle that change when the robot is not there."""
    robot.set_pose((x, 0.0, 0.0))
    with_it = camera.render()
    robot.set_pose((x, 0.0, -5.0))
    follow, dodges, eye, target = camera._follow, camera._dodges, camera._eye, camera._target
    camera._follow, camera._dodges = "", False
    shift = np.array([x, 0.0, 0.0])
    camera._eye, camera._target = eye + shift, target + shift
    gone = np.abs(camera.render().astype(int) - with_it).max(axis=2) > 25
    camera._follow, camera._dodges, camera._eye, camera._target = follow, dodges, eye, target
    return gone[25:55, 40:80].mean()


def test_a_camera_follows_models_that_come_and_go():
    with Simulation("empty", threads=1) as sim:
        camera = SceneCamera(sim, eye=(2, 2, 1), target=(0, 0, 0), size=(160, 120))
        before = camera.render()
        sim.spawn("turtlebot3_burger")
        there = camera.render()
        assert (there != before).any()
        sim.delete("turtlebot3_burger")
        assert (camera.render() == before).all()


def test_a_film_of_a_world_in_space(tmp_path):
    with Simulation(assets.world("turtlebot3_stage_1"), threads=1) as sim:
        sim.spawn("turtlebot3_burger").inputs["cmd_vel"].send(0.2)
        camera = SceneCamera(sim, size=(160, 120), follow="turtlebot3_burger")
        assert film(sim, tmp_path / "a.gif", 1.0, camera=camera, rate=10.0, speed=2.0) == 6
        assert sim.time == pytest.approx(1.0)
        with pytest.raises(Error, match="above zero"):
            film(sim, tmp_path / "a.gif", -1.0)
        with pytest.raises(Error, match="no folder"):
            film(sim, tmp_path / "none" / "a.gif", 1.0)


@pytest.mark.long
def test_a_recording_is_filmed_in_steps_finer_than_it_was_made(tmp_path):
    with Simulation(assets.world("turtlebot3_stage_1"), threads=1) as sim:
        sim.spawn("turtlebot3_burger").inputs["cmd_vel"].send(0.2)
        sim.run(0.5)
        with sim.record(tmp_path / "run.jsonl"):
            sim.run(1.0)
        end = sim.robots["turtlebot3_burger"].pose.x
    source = RecordingSource(tmp_path / "run.jsonl", lambda sim: SceneCamera(sim, size=(64, 48)))
    with source:
        replay = source._replay
        assert len(list(pictures_of(source, None, 0.25))) == 6
        assert replay.done
        assert replay.simulation.robots["turtlebot3_burger"].pose.x == pytest.approx(end)


@pytest.fixture
def bag(tmp_path):
    """Return ten red images a second, brighter and brighter, beside another topic."""
    image, text = load_message("sensor_msgs/Image"), load_message("std_msgs/String")
    from gazelle_ros import Time

    with Bag(str(tmp_path / "drive.bag"), "w") as written:
        for number in range(11):
            now = Time.from_sec(100.0 + 0.1 * number)
            data = np.zeros((12, 16, 3), np.uint8)
            data[..., 0] = 20 * number
            message = image(height=12, width=16, encoding="rgb8", step=48, data=data.tobytes())
            written.write("/camera/image_raw", message, now)
            written.write("/said", text(data="x"), now)
    return tmp_path / "drive.bag"


def test_images_of_a_bag_are_filmed_at_their_times(bag):
    with BagSource(bag) as source:
        reds = [picture[0, 0, 0] for picture in pictures_of(source, None, 0.5)]
    assert reds == [0, 100, 200]
    with pytest.raises(RosError, match="no images on '/said'"):
        BagSource(bag, "/said")


@pytest.mark.parametrize(
    ("encoding", "raw", "seen"),
    [
        ("rgb8", [1, 2, 3], [1, 2, 3]),
        ("bgr8", [1, 2, 3], [3, 2, 1]),
        ("rgba8", [1, 2, 3, 4], [1, 2, 3]),
        ("bgra8", [1, 2, 3, 4], [3, 2, 1]),
        ("mono8", [9], [9, 9, 9]),
        ("32FC1", np.array([2.5], "<f4").view(np.uint8).tolist(), [255, 255, 255]),
        ("16UC1", [0, 1], [255, 255, 255]),
    ],
)
def test_images_of_all_encodings_are_drawn(encoding, raw, seen):
    message = load_message("sensor_msgs/Image")(
        height=1, width=1, encoding=encoding, step=len(raw) + 2, data=bytes([*raw, 7, 7])
    )
    assert picture_of(message)[0, 0].tolist() == seen


def test_an_unknown_encoding_is_named():
    message = load_message("sensor_msgs/Image")(encoding="bayer_rggb8")
    with pytest.raises(RosError, match="bayer_rggb8"):
        picture_of(message)


def test_pictures_and_films_from_the_shell(tmp_path, bag, capsys):
    out = tmp_path / "a.png"
    spawn = ["--spawn", "turtlebot3_burger@0.5,0", "--drive", "0.2,0.1", "--size", "160x120"]
    assert main(["picture", "turtlebot3_stage_1", str(out), *spawn, "--at", "0.5"]) == 0
    assert Image.open(out).size == (160, 120)
    gif = tmp_path / "a.gif"
    line = ["film", "turtlebot3_stage_1", str(gif), *spawn, "--for", "1", "--fps", "5"]
    assert main([*line, "--follow", "turtlebot3_burger"]) == 0
    assert Image.open(gif).n_frames == 6
    assert main(["picture", "turtlebot3_stage_1", str(out), "--top", "--size", "99x99"]) == 0
    assert Image.open(out).size == (99, 99)
    assert main(["film", str(bag), str(gif), "--fps", "4"]) == 0
    assert Image.open(gif).n_frames == 5
    capsys.readouterr()
    assert main(["picture", str(tmp_path / "nothing.world"), str(out)]) == 1
    assert "nothing.world" in capsys.readouterr().err
    for wrong in (["--eye", "1,2"], ["--size", "9"], ["--target", "a,b,c"], ["--size", "0x5"]):
        assert main(["picture", "empty", str(out), *wrong]) == 2


@pytest.mark.long
def test_a_trained_policy_is_filmed(tmp_path, capsys):
    pytest.importorskip("stable_baselines3", reason="the extra 'train' is not installed")
    from gazelle.training import train

    result = train("TurtleBot3Stage1", steps=64, num_envs=4, out=tmp_path, engine="planar")
    gif = tmp_path / "policy.gif"
    line = ["film", str(result.run.folder), str(gif), "--for", "1", "--fps", "5"]
    assert main(line) == 0
    with Image.open(gif) as made:
        assert made.n_frames == 6
        assert made.size == (480, 400)


@pytest.mark.long
def test_every_environment_draws_itself_with_record_video(tmp_path):
    import gymnasium as gym

    import gazelle.envs  # noqa: F401  it registers them

    names = [name for name in gym.registry if name.startswith("gazelle/")]
    assert names
    for name in names:
        with gym.make(name, render_mode="rgb_array") as env:
            env.reset(seed=0)
            first = env.render()
            assert first.dtype == np.uint8
            assert first.ndim == 3
            assert len(np.unique(first @ [65_536, 256, 1])) > 3, name


@pytest.mark.parametrize("place", [(np.nan, 0.0, 0.0), (10**400, 0, 0), (1.0, 2.0), (), 1.0])
@pytest.mark.parametrize("which", ["eye", "target"])
def test_places_that_cannot_be(which, place):
    with Simulation("empty", threads=1) as sim, pytest.raises(Error, match=which):
        SceneCamera(sim, **{which: place})


def test_the_film_of_the_docs_shows_the_robot_in_each_picture(tmp_path):
    page = Path(__file__).parents[2] / "docs/how-to/viewing.md"
    (line,) = (each for each in page.read_text().splitlines() if "film turtlebot3_world" in each)
    _, *words = shlex.split(line)
    words[2] = str(tmp_path / "burger.gif")
    assert main([*words, "--size", "120x75", "--fps", "3"]) == 0
    with Image.open(words[2]) as gif:
        frames = [np.asarray(each.convert("RGB")) for each in ImageSequence.Iterator(gif)]
    assert len(frames) == 16
    dark = np.array([frame.max(axis=2) < 60 for frame in frames])
    assert (dark[:, 25:60, 45:80].mean(axis=(1, 2)) > 0.15).all()
    assert (dark[:, :, :40].mean(axis=(1, 2)) < 0.01).all()
    # Only the robot is as dark, and it turns; pillars come into sight.
    assert np.abs(frames[-1][:20].astype(int) - frames[0][:20]).mean() > 5
