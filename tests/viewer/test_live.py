"""A simulation is shown live in a browser on this machine, to those who know the address alone."""

import http.client
import math
import socket
import threading
import warnings
from urllib.parse import urlsplit

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

import gazelle
from gazelle import assets
from gazelle.description import Pose
from gazelle.errors import Error
from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from tests.ros.graph import until

ROOM = """
<sdf version="1.6"><world name="room">
<model name="ground"><static>true</static><link name="l">
 <collision name="c"><geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></collision>
 <visual name="v"><geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></visual></link></model>
<model name="box"><pose>0 0 1 0 0 0</pose><link name="l">
 <inertial><mass>2</mass></inertial>
 <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
 <visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link></model>
<model name="other"><pose>3 0 1 0 0 0</pose><link name="l">
 <inertial><mass>2</mass></inertial>
 <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
 <visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link></model>
</world></sdf>
"""


BODY = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
)


@pytest.fixture
def room(tmp_path):
    file = tmp_path / "room.world"
    file.write_text(ROOM)
    with Simulation(file, threads=1) as simulation:
        yield simulation


def ask(view, path, *, method="GET", **headers):
    where = urlsplit(view.url)
    connection = http.client.HTTPConnection(where.hostname, where.port, timeout=60)
    connection.request(method, path, headers=headers)
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer, body


def secret(view):
    return urlsplit(view.url).path


def upgrade(view, path):
    """Return the first line of the answer to a websocket."""
    where = urlsplit(view.url)
    with socket.create_connection((where.hostname, where.port), timeout=60) as connection:
        connection.sendall(
            f"GET {path} HTTP/1.1\r\nHost: {where.netloc}\r\nUpgrade: websocket\r\n"
            "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: viser-v0\r\n\r\n".encode()
        )
        return connection.recv(4096).split(b"\r\n")[0]


def pictures(view):
    """Make one picture, as if the page were open; another thread checks that otherwise."""
    view._picture()


def layer(view, name):
    """Return the part of the page of a class."""
    return next(each for each in view._layers if type(each).__name__ == name)


def shapes(view):
    """Return the batches of shapes, by how many instances they have."""
    (layer,) = (each for each in view._layers[1:2])
    return [batch.handle for batch in layer._batches._batches]


def test_only_who_knows_the_address_is_served(room):
    with LiveView(room) as view:
        assert view.url.startswith("http://127.0.0.1:")
        assert len(secret(view)) > 20
        assert ask(view, secret(view))[0].status == 200
        for path in ("/", "/index.html", "/wrong/", f"{secret(view)[:-2]}/", secret(view)[2:]):
            assert ask(view, path)[0].status == 403
        assert ask(view, secret(view), Host="evil.example:80")[0].status == 403
        assert ask(view, f"{secret(view)}../../pyproject.toml")[0].status == 404
        assert ask(view, f"{secret(view)}assets/x.js")[0].status == 404
        assert b"403" in upgrade(view, "/")
        assert b"403" in upgrade(view, "/wrong")
        assert b"101" in upgrade(view, secret(view))


def test_two_views_have_addresses_of_their_own(room):
    with LiveView(room) as one, LiveView(room) as other:
        assert ask(one, secret(other))[0].status == 403
        assert ask(other, secret(other))[0].status == 200


def test_the_page_takes_nothing_from_elsewhere(room):
    with LiveView(room) as view:
        answer, _ = ask(view, secret(view))
        policy = answer.headers["Content-Security-Policy"]
        assert "default-src 'self'" in policy
        assert "frame-ancestors 'none'" in policy
        assert "http" not in policy
        handlers = view._server.viser._websock_server._incoming_handlers
        assert not any(kind.__name__.startswith("ShareUrl") for kind in handlers)


def test_the_port_is_the_one_asked_for_and_given_back(room):
    with LiveView(room) as view:
        port = urlsplit(view.url).port
        with pytest.raises(Error, match="it is taken"):
            LiveView(room, port=port)
    with LiveView(room, port=port) as view:
        assert urlsplit(view.url).port == port


@pytest.mark.parametrize(
    "options",
    [
        {"world": 1},
        {"world": -1},
        {"rate": 0.0},
        {"rate": math.nan},
        {"rate": 10**400},
        {"worlds": 2},
    ],
)
def test_what_cannot_be_is_refused(room, options):
    with pytest.raises(
        Error, match=r"there is no world|a view cannot show|a rate above zero|'rate' must be"
    ):
        LiveView(room, **options)


def test_equal_shapes_are_one_batch_and_follow_the_simulation(room):
    with LiveView(room) as view:
        pictures(view)
        plane, boxes = shapes(view)
        assert len(plane.batched_positions) == 1
        assert boxes.batched_positions == pytest.approx(np.array([[0, 0, 1], [3, 0, 1]]))
        room.run(1.0)
        pictures(view)
        assert boxes.batched_positions[:, 2] == pytest.approx(0.5, abs=1e-2)


def test_models_that_come_and_go_are_followed(room):
    with LiveView(room) as view:
        pictures(view)
        view._context.select("other")
        room.delete("other")
        pictures(view)
        assert len(shapes(view)[1].batched_positions) == 1
        pictures(view)
        assert view._context.selected == ""
        room.spawn("turtlebot3_burger", pose=gazelle.Pose(2.0))
        pictures(view)
        assert len(shapes(view)) > 3


def test_worlds_of_a_batch_stand_beside_each_other(tmp_path):
    file = tmp_path / "room.world"
    file.write_text(ROOM)
    with Simulation(file, nworld=9, threads=1) as sim, LiveView(sim, world=2, worlds=4) as view:
        sim.robots["box"].set_pose((0.0, 0.0, 2.0), worlds=np.array([3]))
        pictures(view)
        places = shapes(view)[1].batched_positions.reshape(4, 2, 3)
        assert len(np.unique(places[:, 0, :2], axis=0)) == 4
        assert places[:, 0, 2] == pytest.approx([1.0, 2.0, 1.0, 1.0])


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_everything_that_can_be_shown_is(engine):
    with Simulation(assets.world("turtlebot3_world"), engine, threads=1) as sim:
        sim.spawn("turtlebot3_burger", pose=gazelle.Pose(-2.0, -0.5))
        with LiveView(sim) as view:
            for layer in view._optional.values():
                layer.shown = True
            sim.run(0.2)
            view._context.select("turtlebot3_burger")
            pictures(view)
            pictures(view)
            names = view._context.scene._handle_from_node_name
            assert {"/world/rays", "/world/scan", "/world/frames", "/world/joints"} <= set(names)
            assert "/world/names/turtlebot3_burger" in names
            rays = names["/world/scan"].points
            assert len(rays) > 100
            for layer in view._optional.values():
                layer.shown = False
            pictures(view)
            assert not names["/world/rays"].visible


def test_what_is_shown_does_not_change_what_the_run_computes():
    hashes = []
    for shown in (False, True):
        with Simulation(assets.world("turtlebot3_world"), threads=1, seed=3) as sim:
            robot = sim.spawn("turtlebot3_burger", pose=gazelle.Pose(-2.0, -0.5))
            robot.inputs["cmd_vel"].send(0.2, 0.3)
            scan = (
                robot.sensors["lds"]
                if "lds" in robot.sensors
                else next(iter(robot.sensors.values()))
            )
            if shown:
                with LiveView(sim) as view:
                    for layer in view._optional.values():
                        layer.shown = True
                    for _ in range(5):
                        sim.run(0.1)
                        pictures(view)
            else:
                for _ in range(5):
                    sim.run(0.1)
            hashes.append((sim.state_hash(), scan.latest().tobytes()))
    assert hashes[0] == hashes[1]


def test_a_stage_world_is_shown_with_its_rangers():
    with Simulation(assets.world("fleet"), "planar", threads=1) as sim, LiveView(sim) as view:
        view._optional["Lidar rays"].shown = True
        sim.run(0.2)
        pictures(view)
        found = sum(len(batch.batched_positions) for batch in shapes(view))
        assert found >= 72


def test_the_clock_is_steered_from_the_page(room):
    with LiveView(room) as view:
        controls = view._layers[0]
        for word, paused in (("pause", True), ("run", False), ("step", True)):
            controls.do(word)
            assert room.paused is paused
        assert room.time == pytest.approx(room.engine.time_step)
        controls.do("reset")
        assert room.time == 0.0
        controls._pace("2")
        assert room.physics.target_rate == pytest.approx(2.0)
        controls._pace("max")
        assert room.physics.target_rate is None


def test_a_robot_is_driven_by_the_joystick_and_stands_when_nobody_steers(monkeypatch):
    with Simulation(assets.world("turtlebot3_stage_1"), "planar", threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        with LiveView(sim) as view:
            view._context.select("turtlebot3_burger")
            where = f"{secret(view)}drive"
            assert ask(view, f"{where}?linear=1&angular=0")[0].status == 200
            until(lambda: robot.inputs["cmd_vel"].linear[0, 0] == pytest.approx(0.2))
            assert ask(view, f"{where}?linear=nan&angular=0")[0].status == 200
            assert ask(view, f"{where}?linear=99&angular=-99")[0].status == 200
            until(lambda: robot.inputs["cmd_vel"].angular[0, 2] == pytest.approx(-1.0))
            drive = next(each for each in view._layers if type(each).__name__ == "DriveControls")

            def quiet():
                drive.read()
                return robot.inputs["cmd_vel"].linear[0, 0] == 0.0

            until(quiet)
            assert ask(view, "/drive?linear=1&angular=0")[0].status == 403


def test_models_are_pushed_lifted_deleted_and_spawned(room):
    with LiveView(room) as view:
        tools = view._layers[2]
        view._context.select("box")
        tools.do("lift")
        assert room.robots["box"].pose.z == pytest.approx(1.5)
        tools._force.value = (50.0, 0.0, 0.0)
        tools.do("push")
        room.run(0.3)
        assert room.robots["box"].pose.x > 0.1
        tools.do("delete")
        assert "box" not in room.robots
        tools = layer(view, "InsertTools")
        tools._what.value = "turtlebot3_burger"
        tools._where.value = (0.0, 2.0, 1.57)
        for _ in range(2):
            tools.spawn()
        assert {"turtlebot3_burger", "turtlebot3_burger_2"} <= set(room.robots)
        assert room.robots["turtlebot3_burger"].pose.y == pytest.approx(2.0)


def test_what_goes_wrong_on_the_page_is_said_there_and_stops_nothing(room, monkeypatch):
    with LiveView(room) as view:
        said = []
        monkeypatch.setattr(view._context, "notify", lambda *words: said.append(words))
        tools = layer(view, "InsertTools")
        tools._what.value = "file ..."
        tools._file.value = "/nowhere/robot.urdf"
        view._context.guarded(tools.spawn)
        view._context.guarded(lambda: 1 / 0)
        assert "/nowhere/robot.urdf" in said[0][1]
        assert "ZeroDivisionError" in said[1][1]
        room.run(0.1)


def test_joints_are_moved_by_sliders(tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(
        f'<robot name="arm"><link name="base">{BODY}</link><link name="tip">{BODY}</link>'
        '<joint name="j" type="revolute"><parent link="base"/><child link="tip"/>'
        '<axis xyz="0 0 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint></robot>'
    )
    with Simulation("empty", threads=1) as sim:
        sim.spawn(file)
        with LiveView(sim) as view:
            sliders = next(each for each in view._layers if type(each).__name__ == "JointSliders")
            view._context.select("arm")
            pictures(view)
            assert (sliders._sliders["j"].shown.min, sliders._sliders["j"].shown.max) == (-1.0, 2.0)
            sim.robots["arm"].set_configuration(["j"], [0.7])
            pictures(view)
            assert sliders._sliders["j"].shown.value == pytest.approx(0.7, abs=2e-3)


def test_a_model_that_is_spawned_and_selected_on_the_page_has_its_sliders_once(room, monkeypatch):
    """A click's thread spawns while another makes pictures: both used to build the sliders."""
    with LiveView(room) as view:
        sliders = next(each for each in view._layers if type(each).__name__ == "JointSliders")
        builders, clashes, made = set(), [], []
        slider = sliders._slider

        def slow():
            builders.add(threading.get_ident())
            clashes.extend(builders - {threading.get_ident()})
            if not made:
                view._changed = True  # as when the news of the spawn comes just now
            threading.Event().wait(0.1)
            made.append(slider())
            builders.discard(threading.get_ident())
            return made[-1]

        monkeypatch.setattr(sliders, "_slider", slow)
        tools = layer(view, "InsertTools")
        tools._what.value = "turtlebot3_burger"
        tools._where.value = (0.0, 2.0, 0.0)
        spawner = threading.Thread(target=tools.spawn)
        spawner.start()
        while spawner.is_alive():
            pictures(view)
        spawner.join()
        pictures(view)
        kept = list(sliders._sliders.values())
        assert {each.shown.label for each in kept} == {"wheel_left_joint", "wheel_right_joint"}
        assert made == kept
        assert clashes == []


@pytest.mark.parametrize(
    ("step", "text"), [(0.01, "0.01 s"), (0.001, "0.001 s"), (0.0005, "0.0005 s")]
)
def test_a_single_step_is_seen_on_the_clock(step, text):
    with Simulation("empty", time_step=step, threads=1) as sim, LiveView(sim) as view:
        view._layers[0].do("step")
        pictures(view)
        assert f"**{text}**" in view._layers[0]._status.content


def test_a_model_that_is_spawned_into_something_is_put_beside_it(monkeypatch):
    with Simulation("turtlebot3_world", threads=1) as sim, LiveView(sim) as view:
        said = []
        monkeypatch.setattr(view._context, "notify", lambda *words: said.append(words))
        tools = layer(view, "InsertTools")
        tools._what.value = "turtlebot3_burger"
        tools._where.value = (0.0, 0.0, 0.0)  # a pillar stands there
        tools.spawn()
        pose = sim.robots["turtlebot3_burger"].pose
        assert np.hypot(pose.x, pose.y) == pytest.approx(0.5)
        assert "0.5, 0" in said[0][1]


def test_outputs_are_plotted_while_they_are_chosen():
    with Simulation(assets.world("turtlebot3_stage_1"), "planar", threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        with LiveView(sim) as view:
            plots = view._plots
            assert "turtlebot3_burger: odom" in plots._port.options
            plots._port.value = "turtlebot3_burger: odom"
            plots._choose()
            assert robot.outputs["odom"].has_subscribers
            sim.run(1.0)
            pictures(view)
            assert len(plots._chart.data[0]) > 5
        assert not robot.outputs["odom"].has_subscribers


def test_nobody_who_looks_costs_nothing(room, monkeypatch):
    with LiveView(room) as view:
        monkeypatch.setattr(view, "_look", lambda: pytest.fail("nobody looks"))
        room.run(1.0)
        assert not view._server.watched


def test_an_error_of_the_view_ends_the_view_alone(room, monkeypatch):
    with LiveView(room) as view:
        seen = threading.Event()

        def broken():
            seen.set()
            raise RuntimeError("broken")

        monkeypatch.setattr(view, "_look", broken)
        monkeypatch.setattr(type(view._server), "watched", property(lambda _: True))
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            view._server._changed.set()
            until(lambda: not view._thread.is_alive())
        assert any("the live view ended" in str(each.message) for each in said)
        room.run(0.1)


def test_it_ends_with_its_simulation(room):
    view = LiveView(room)
    room.close()
    view._server._changed.set()
    view.close()
    view.close()
    assert not view._thread.is_alive()


def test_a_page_to_look_at_alone_changes_nothing(room):
    with LiveView(room, read_only=True) as view:
        view._context.select("box")
        pictures(view)
        assert ask(view, f"{secret(view)}drive?linear=1&angular=0")[0].status == 404
        assert not any("Controls" in type(layer).__name__ for layer in view._layers[1:])
        with pytest.raises(Error, match="has no log"):
            view.show_recording(None)


@pytest.mark.long
def test_copies_that_learn_are_watched(capsys):
    pytest.importorskip("stable_baselines3", reason="the extra 'train' is not installed")
    import argparse

    from gazelle.cli.viewing import watched
    from gazelle.training import train
    from gazelle.training.progress import NoProgress

    class Said(NoProgress):
        def __init__(self):
            self.said = []

        def say(self, text):
            self.said.append(text)

    import tempfile

    for task in ("TurtleBot3Stage1", "AGVFleet"):
        display = Said()
        with tempfile.TemporaryDirectory() as folder:
            train(
                task,
                steps=256,
                num_envs=8,
                out=folder,
                progress=watched(display, argparse.Namespace(view=0)),
            )
        assert [text.partition(":")[0] for text in display.said] == ["view http"]


def test_goals_and_the_ways_there_are_shown():
    """Of every world that is shown, where it stands."""
    with Simulation("turtlebot3_world", "planar", nworld=2, time_step=0.02) as simulation:
        robot = simulation.spawn("turtlebot3_burger", name="burger", pose=Pose(-2.0, -0.5))
        with LiveView(simulation) as view:
            layer = view._optional["Plans"]
            assert layer.shown
            lines, arrows = layer.read()
            assert len(lines) == len(arrows) == 0
            robot.navigation.go_to(0.55, 0.55, 0.0, worlds=np.array([1]))
            simulation.run(1.5)
            lines, arrows = layer.read()
            spot = view._context.spots[1]
            start, end = robot.planar_pose()[1, :2] + spot[:2], np.array([0.55, 0.55]) + spot[:2]
            assert np.hypot(*(lines[0, 0, :2] - start)) < 0.5
            assert np.hypot(*(lines[-1, 1, :2] - end)) < 0.1
            np.testing.assert_allclose(lines[1:, 0], lines[:-1, 1])  # one way, without gaps
            np.testing.assert_allclose(arrows[0, 0, :2], end)
            assert arrows[0, 1, 0] > arrows[0, 0, 0]
            layer.show((lines, arrows))
            layer.show((lines, arrows))
            robot.navigation.cancel()
            lines, arrows = layer.read()
            assert len(lines) == len(arrows) == 0
            layer.show((lines, arrows))
            layer.shown = False
