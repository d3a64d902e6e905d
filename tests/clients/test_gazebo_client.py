"""The client of Gazebo's services."""

import contextlib
import math

import pytest
from flaky_service import FlakyService
from ros.graph import until

from gazelle import assets
from gazelle.clients import ClientError, Driver, Gazebo, LiveStates, PerformanceWatch
from gazelle_ros import Master

BALL = """<sdf version="1.6"><model name="ball"><link name="core"><inertial><mass>2</mass></inertial>
<gravity>0</gravity></link></model></sdf>"""
STONE = """<robot name="s"><link name="core"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""


def test_time_is_stopped_stepped_and_let_go(graph):
    gazebo = graph.gazebo
    gazebo.pause()
    stopped = gazebo.time
    assert gazebo.step(25) == pytest.approx(stopped + 0.025)
    assert gazebo.physics.paused
    gazebo.unpause()
    until(lambda: gazebo.time > stopped + 0.1)
    with pytest.raises(ClientError, match="not paused"):
        gazebo.step()


def test_everything_is_put_back(graph):
    until(lambda: graph.gazebo.time > 0.2)
    graph.gazebo.set_model_state("r1", (1.0, 1.0, 0.0))
    graph.gazebo.reset_world()
    assert graph.gazebo.model_state("r1").position == pytest.approx((0.0, 0.0, 0.0), abs=0.02)
    before = graph.gazebo.time
    graph.gazebo.reset_simulation()
    assert graph.gazebo.time < before


@pytest.mark.filterwarnings("ignore:the physics property")
def test_the_physics_is_read_and_set_by_name(graph):
    gazebo = graph.gazebo
    gazebo.time_step = 0.002
    gazebo.gravity = (0.0, 0.0, -3.7)
    gazebo.real_time_factor = 4.0
    found = gazebo.physics
    assert found.time_step == 0.002
    assert found.gravity == (0.0, 0.0, -3.7)
    assert found.max_update_rate == pytest.approx(2000.0)
    gazebo.set_physics(sor_pgs_iters=77)
    assert gazebo.physics.ode.sor_pgs_iters == 77
    gazebo.set_default_physics()
    assert gazebo.real_time_factor == pytest.approx(1.0)
    with pytest.raises(ClientError, match="no field 'sor_iters'"):
        gazebo.set_physics(sor_iters=1)


def test_models_come_and_go(graph):
    gazebo = graph.gazebo
    gazebo.spawn_sdf("ball", BALL, position=(1.0, 0.0, 2.0), rpy=(0.0, 0.0, 1.0))
    assert "ball" in gazebo.models
    state = gazebo.model_state("ball")
    assert state.position == pytest.approx((1.0, 0.0, 2.0))
    assert state.yaw == pytest.approx(1.0)
    gazebo.delete("ball")
    assert "ball" not in gazebo.models
    with pytest.raises(ClientError, match="model does not exist"):
        gazebo.delete("ball")


@pytest.mark.filterwarnings("ignore:the service /imu_service")
def test_robots_are_spawned_from_files_packages_and_parameters(graph, tmp_path):
    gazebo = graph.gazebo
    (tmp_path / "ball.sdf").write_text(BALL)
    gazebo.spawn_sdf_file("ball_of_a_file", tmp_path / "ball.sdf", position=(0.0, 2.0, 1.0))
    gazebo.spawn_urdf_file("r2", assets.robot("turtlebot3_burger"), position=(1.0, 0.0, 0.0))
    gazebo.spawn_urdf_file(
        "r3",
        "urdf/turtlebot3_burger.urdf.xacro",
        package="turtlebot3_description",
        position=(-1.0, 0.0, 0.0),
        namespace="/r3",
    )
    gazebo.node.set_param("ball_description", STONE)
    gazebo.node.set_param("ball_sdf", BALL)
    gazebo.spawn_sdf_parameter("ball", "ball_sdf", position=(0.0, 1.0, 1.0))
    gazebo.spawn_urdf_parameter("stone", "ball_description")
    assert {"r2", "r3", "ball", "ball_of_a_file", "stone"} <= set(gazebo.models)
    assert graph.sim.robots["r3"].outputs["odom"].topic == "/r3/odom"
    with pytest.raises(ClientError, match="holds no description"):
        gazebo.spawn_urdf_parameter("r4", "nothing")
    with pytest.raises(ClientError, match="no file"):
        gazebo.spawn_urdf_file("r4", "nothing.urdf")


def test_wrenches_and_efforts_act_and_end(graph):
    gazebo = graph.gazebo
    gazebo.pause()
    gazebo.spawn_sdf("ball", BALL, position=(0.0, 0.0, 3.0))
    gazebo.apply_wrench("ball::core", (4.0, 0.0, 0.0), duration=0.5)
    gazebo.step(1000)
    assert gazebo.model_state("ball").linear[0] == pytest.approx(1.0, rel=1e-3)
    gazebo.apply_wrench("ball::core", (4.0, 0.0, 0.0))
    gazebo.clear_wrenches("ball::core")
    gazebo.step(100)
    assert gazebo.model_state("ball").linear[0] == pytest.approx(1.0, rel=1e-3)
    gazebo.apply_effort("wheel_left_joint", 0.1, duration=0.1)
    gazebo.clear_efforts("wheel_left_joint")


def test_a_table_of_states_is_kept_up_to_date(graph):
    with graph.gazebo.watch_models().wait() as models:
        assert "r1" in models
        graph.gazebo.set_model_state("r1", (1.0, 0.5, 0.0))
        until(lambda: models["r1"].position[0] == pytest.approx(1.0, abs=0.01))
        with pytest.raises(ClientError, match="did you mean 'r1'"):
            models["r11"]
    with graph.gazebo.watch_links().wait() as links:
        assert "r1::wheel_left_link" in set(links)


def test_three_numbers_are_three(graph):
    for call, words in (
        (lambda: graph.gazebo.spawn_sdf("b", BALL, position=(1.0, 2.0)), "a position is three"),
        (lambda: graph.gazebo.set_model_state("r1", (0, 0, 0), rpy=(1,)), "yaw is three"),
        (lambda: graph.gazebo.apply_wrench("r1::base", (1, 2, 3, 4)), "a force is three"),
        (lambda: setattr(graph.gazebo, "gravity", (0.0,)), "gravity is three"),
    ):
        with pytest.raises(ClientError, match=words):
            call()


def test_who_is_not_there_is_said_clearly():
    with (
        Master(port=0, rosout=False) as master,
        Gazebo(master_uri=master.uri, timeout=0.3) as gazebo,
        pytest.raises(ClientError, match="does not answer within"),
    ):
        gazebo.pause()


def test_values_that_cannot_be_are_clear_errors(graph):
    gazebo, node = graph.gazebo, graph.gazebo.node
    driver = Driver(node, "nobody")
    for call in (
        lambda: gazebo.apply_wrench("r1::base_footprint", force=math.nan),
        lambda: gazebo.apply_effort("\ud800", 1.0),
        lambda: gazebo.delete("\ud800"),
        lambda: setattr(gazebo, "real_time_factor", 10**400),
        lambda: gazebo.wait_for_model("nobody", math.nan),
        lambda: driver.wait(math.inf),
        lambda: driver.wait(1e308),
        lambda: LiveStates(node, "model_states", "no such"),
    ):
        with pytest.raises(ClientError):
            call()
    driver.close()


@pytest.mark.filterwarnings("error::pytest.PytestUnhandledThreadExceptionWarning")
def test_one_look_in_a_long_time(graph):
    PerformanceWatch(graph.gazebo.node, rate=1e-320).close()


def test_waiting_for_a_model_ends(graph):
    graph.gazebo.wait_for_model("r1")
    with pytest.raises(ClientError, match="did not appear within"):
        graph.gazebo.wait_for_model("nobody", timeout=0.2)


@pytest.fixture
def flaky(graph):
    """Yield a function that drops a service's first answers."""
    with contextlib.ExitStack() as stack:

        def begin(name, lost=1):
            service = FlakyService(graph.gazebo.node, f"/gazebo/{name}", lost)
            return stack.enter_context(contextlib.closing(service))

        yield begin


def test_a_spawn_whose_answer_got_lost_is_a_spawn(graph, flaky):
    service = flaky("spawn_sdf_model", lost=2)
    graph.gazebo.spawn_sdf("ball", BALL, position=(1.0, 0.0, 2.0))
    assert service.calls == 3
    assert graph.gazebo.models.count("ball") == 1
    assert graph.gazebo.model_state("ball").position == pytest.approx((1.0, 0.0, 2.0))


def test_a_name_that_was_taken_before_is_taken_however_often_one_asks(graph, flaky):
    graph.gazebo.spawn_sdf("ball", BALL)
    flaky("spawn_sdf_model")
    with pytest.raises(ClientError, match="already exists"):
        graph.gazebo.spawn_sdf("ball", BALL, position=(1.0, 0.0, 2.0))
    assert graph.gazebo.model_state("ball").position == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


def test_a_spawn_fails_when_all_answers_get_lost(graph, flaky):
    service = flaky("spawn_sdf_model", lost=9)
    with pytest.raises(ClientError, match="spawn_sdf_model"):
        graph.gazebo.spawn_sdf("ball", BALL)
    assert service.calls == 3


def test_a_delete_whose_answer_got_lost_is_a_delete(graph, flaky):
    service = flaky("delete_model")
    graph.gazebo.delete("r1")
    assert (service.calls, "r1" in graph.gazebo.models) == (2, False)
    with pytest.raises(ClientError, match="model does not exist"):
        graph.gazebo.delete("r1")


def test_forces_are_not_applied_twice(graph, flaky):
    service = flaky("apply_body_wrench")
    with pytest.raises(ClientError, match="apply_body_wrench"):
        graph.gazebo.apply_wrench("r1::base_footprint", (1.0, 0.0, 0.0), duration=0.1)
    assert service.calls == 1
