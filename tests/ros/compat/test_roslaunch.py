"""roslaunch from a script: launch files, nodes, processes, substitutions."""

import importlib
import os
import signal
import subprocess
import sys
import time

import pytest
from processes import is_running
from ros.graph import until

from gazelle_ros.launch.packages import Packages
from gazelle_ros.messages import search

SLEEPER = """#!/usr/bin/env python3
import rospy, sys
rospy.init_node("sleeper")
rospy.set_param("~ready", rospy.myargv(sys.argv)[1:])
rospy.spin()
"""
LAUNCH = """<launch><arg name="word" default="none"/>
<param name="word" value="$(arg word)"/><param name="said" command="echo hello"/>
<node pkg="robot" type="sleeper.py" name="one" args="a b" required="false"><remap from="x" to="y"/>
</node></launch>
"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Yield the package ``robot``, on ROS_PACKAGE_PATH."""
    folder = tmp_path / "ws" / "robot"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>robot</name></package>")
    (folder / "sleeper.py").write_text(SLEEPER)
    (folder / "sleeper.py").chmod(0o755)
    (folder / "launch" / "all.launch").write_text(LAUNCH)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    monkeypatch.setenv("ROS_HOME", str(tmp_path / "home"))
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    search.forget()
    yield folder
    search.forget()


@pytest.fixture
def roslaunch(rospy, package):
    return importlib.import_module("roslaunch")


def test_a_launch_file_is_started_and_ended(roslaunch, rospy, package, capfd):
    died = []

    class Listener(roslaunch.pmon.ProcessListener):
        def process_died(self, process_name, exit_code):
            died.append((process_name, exit_code))

    uuid = roslaunch.rlutil.get_or_generate_uuid(None, False)
    roslaunch.configure_logging(uuid)
    (file,) = roslaunch.rlutil.resolve_launch_arguments(["robot", "all.launch"])
    parent = roslaunch.parent.ROSLaunchParent(
        uuid, [(file, ["word:=told"])], process_listeners=[Listener()]
    )
    before = signal.getsignal(signal.SIGINT)
    parent.start()
    try:
        assert rospy.get_param("/word") == "told"
        assert rospy.get_param("/said") == "hello\n"
        until(lambda: rospy.has_param("/one/ready"))
        assert rospy.get_param("/one/ready") == ["a", "b"]
        parent.spin_once()
        assert died == []
    finally:
        parent.shutdown()
    parent.shutdown()
    assert signal.getsignal(signal.SIGINT) == before
    assert "process[one-1]: started with pid" in capfd.readouterr().out


def test_nodes_are_started_one_by_one(roslaunch, rospy):
    launch = roslaunch.scriptapi.ROSLaunch()
    node = roslaunch.core.Node("robot", "sleeper.py", name="two", namespace="/ns", args="x")
    with pytest.raises(roslaunch.RLException, match="please start"):
        launch.launch(node)
    launch.start()
    try:
        process = launch.launch(node)
        assert process.is_alive()
        assert node.process_name == process.name == "ns/two-1"
        until(lambda: rospy.has_param("/ns/two/ready"))
        process.stop()
        assert not process.is_alive()
        assert process.exit_code == 0
        assert process.get_exit_description() == "process has finished cleanly"
        assert process.get_info()["spawn_count"] == 1
        with pytest.raises(roslaunch.RLException, match="failed to launch"):
            launch.launch(roslaunch.Node("robot", "nothing.py"))
        with pytest.raises(ValueError, match="of type Node"):
            launch.launch("robot")
    finally:
        launch.stop()


def test_a_node_that_ends_is_told_and_may_come_again(roslaunch, package):
    (package / "once.sh").write_text("#!/bin/sh\nexit 3\n")
    (package / "once.sh").chmod(0o755)
    died = []

    class Listener(roslaunch.pmon.ProcessListener):
        def process_died(self, process_name, exit_code):
            died.append(exit_code)

    uuid = roslaunch.rlutil.get_or_generate_uuid(None, True)
    text = '<launch><node pkg="robot" type="once.sh" name="n" respawn="true"/></launch>'
    parent = roslaunch.parent.ROSLaunchParent(
        uuid, [], roslaunch_strs=[text], process_listeners=[Listener()], show_summary=False
    )
    parent.start()
    try:
        until(lambda: len(died) >= 2)
    finally:
        parent.shutdown()
    assert set(died) == {3}


def test_the_launch_ends_by_itself_when_its_nodes_have(roslaunch, package):
    (package / "once.sh").write_text("#!/bin/sh\nexit 0\n")
    (package / "once.sh").chmod(0o755)
    uuid = roslaunch.rlutil.get_or_generate_uuid(None, True)
    text = '<launch><node pkg="robot" type="once.sh" name="n"/></launch>'
    parent = roslaunch.parent.ROSLaunchParent(uuid, [], roslaunch_strs=[text])
    parent.start()
    parent.spin()


def test_what_cannot_start_is_a_roslaunch_error(roslaunch, rospy, package):
    rospy.set_param("/run_id", "mine")
    parent = roslaunch.parent.ROSLaunchParent("other", [], roslaunch_strs=["<launch/>"])
    with pytest.raises(roslaunch.RLException, match="run_id"):
        parent.start()
    core = roslaunch.parent.ROSLaunchParent("x", [], is_core=True)
    with pytest.raises(roslaunch.RLException, match="already running"):
        core.start()
    with pytest.raises(roslaunch.RLException, match="positive"):
        roslaunch.parent.ROSLaunchParent("x", [], sigint_timeout=0)
    with pytest.raises(roslaunch.RLException, match="not a launch file"):
        roslaunch.rlutil.resolve_launch_arguments(["nothing.launch"])


def test_a_configuration_has_nodes_and_parameters(roslaunch, package):
    file = str(package / "launch" / "all.launch")
    config = roslaunch.config.load_config_default([(file, ["word:=x"])], None)
    assert {param.key: param.value for param in config.params.values()} == {
        "/word": "x",
        "/said": "hello\n",
    }
    (node,) = config.nodes
    assert (node.package, node.type, node.name, node.args) == ("robot", "sleeper.py", "one", "a b")
    assert node.remap_args == [("x", "y")]
    assert config.roslaunch_files == [file]
    loaded = roslaunch.ROSLaunchConfig()
    roslaunch.XmlLoader().load(file, loaded, argv=[])
    assert loaded.params["/word"].value == "none"
    with pytest.raises(roslaunch.RLException, match="multiple nodes named"):
        roslaunch.XmlLoader().load(file, loaded, argv=[])
    with pytest.raises(roslaunch.XmlParseException):
        roslaunch.XmlLoader().load_string("<launch><node/></launch>", loaded)
    assert roslaunch.rlutil.check_roslaunch(file) is None


def test_tests_have_limits(roslaunch):
    config = roslaunch.ROSLaunchConfig()
    text = '<launch><test pkg="a" type="b" test-name="c" time-limit="3" retry="2"/></launch>'
    roslaunch.XmlLoader().load_string(text, config)
    (test,) = config.tests
    assert (test.test_name, test.name, test.time_limit, test.retry) == ("c", "c", 3.0, 2)


@pytest.mark.parametrize(
    "values",
    [
        {"name": "a/b"},
        {"output": "nowhere"},
        {"cwd": "elsewhere"},
        {"respawn": True, "required": True},
        {"package": " "},
    ],
)
def test_nodes_that_make_no_sense_are_refused(roslaunch, values):
    with pytest.raises(ValueError):  # noqa: PT011  # any text
        roslaunch.core.Node(**{"package": "p", "node_type": "t", **values})


def test_substitutions_work_in_any_text(roslaunch, package, monkeypatch):
    args = roslaunch.substitution_args
    monkeypatch.setenv("WHO", "me")
    context = {"arg": {"x": "1"}}
    assert args.resolve_args("$(env WHO)-$(arg x)-$(optenv NO other)", context) == "me-1-other"
    assert args.resolve_args("$(find robot)/launch") == str(package / "launch")
    name = args.resolve_args("$(anon n)", context)
    assert name == args.resolve_args("$(anon n)", context)
    assert args.resolve_args("$(anon n)$(env WHO)", context, resolve_anon=False) == "$(anon n)me"
    assert args.resolve_args(None) is None
    with pytest.raises(args.ArgException):
        args.resolve_args("$(arg y)", context)
    with pytest.raises(args.SubstitutionException):
        args.resolve_args("$(nothing y)")
    with pytest.raises(importlib.import_module("rospkg").ResourceNotFound):
        args.resolve_args("$(find nothing)")


SCRIPT = """
import roslaunch, sys, time
launch = roslaunch.scriptapi.ROSLaunch()
launch.start()
process = launch.launch(roslaunch.core.Node("robot", "sleeper.py", name="left"))
print(process.pid, flush=True)
time.sleep(60)
"""


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_no_node_is_left_when_the_script_is_ended(package, master, tmp_path, number):
    pid = node_of_ended_script(master, tmp_path, number)
    until(lambda: not is_running(pid))


@pytest.mark.long
def test_the_node_of_a_killed_script_is_left_as_in_ros(package, master, tmp_path):
    pid = node_of_ended_script(master, tmp_path, signal.SIGKILL)
    try:
        time.sleep(0.5)
        assert is_running(pid)
    finally:
        os.kill(pid, signal.SIGKILL)


def node_of_ended_script(master, tmp_path, number):
    """Start the script, send it a signal once its node runs; the node's process."""
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    command = "import sys; from gazelle_ros.cli.main import main; sys.exit(main())"
    with subprocess.Popen(
        [sys.executable, "-c", command, "exec", str(script)],
        env={**os.environ, "ROS_MASTER_URI": master.uri},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as process:
        pid = next(int(line) for line in process.stdout if line.strip().isdigit())
        time.sleep(0.5)
        process.send_signal(number)
        process.wait(60)
    return pid


def test_packages_are_found(package):
    assert Packages().installed("robot") == package


def test_the_arguments_of_a_file_are_told(rospy, tmp_path, capsys):
    arg_dump = importlib.import_module("roslaunch.arg_dump")
    file = tmp_path / "args.launch"
    file.write_text(
        '<launch><arg name="a"/><arg name="b" default="1" doc="second"/><arg name="c" value="2"/>'
        "</launch>"
    )
    assert arg_dump.get_args([str(file)]) == {"a": (None, None), "b": ("second", "1")}
    arg_dump.dump_args([str(file)])
    assert 'b (default "1"): second' in capsys.readouterr().out
    file.write_text("<launch><arg/></launch>")
    with pytest.raises(arg_dump.RLException):
        arg_dump.get_args([str(file)])
