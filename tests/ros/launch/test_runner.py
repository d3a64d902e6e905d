"""Launches: processes, parameters, masters."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from ports import free_port
from processes import is_running
from ros.graph import until

from gazelle_ros import Master
from gazelle_ros.errors import MasterUnreachableError
from gazelle_ros.launch import LaunchError, Packages
from gazelle_ros.launch.process import StopTimeouts
from gazelle_ros.launch.runner import Launch, Options
from gazelle_ros.master.proxy import MasterProxy
from gazelle_ros.xmlrpc.client import BlockingClient

SLEEP = "#!/bin/sh\nexec sleep 100\n"
PATIENCE = StopTimeouts(60.0, 10.0)


@pytest.fixture
def master():
    with Master(port=0) as running:
        yield running


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path / "home"))
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    return tmp_path / "home"


@pytest.fixture
def launch(load, master):
    """Yield a function that starts a launch file's body; it returns the launch and its log."""
    made = []

    def run(body, *, start=True, patience=PATIENCE, **options):
        said = []
        options.setdefault("master_uri", master.uri)
        plan = load(body)
        running = Launch(
            plan, Options(patience=patience, **options), say=said.append, packages=Packages()
        )
        running.said = said
        made.append(running)
        if start:
            running.start()
        return running

    yield run
    for running in made:
        running.close()


def spin(running, seconds=120.0):
    """Watch until the launch ends by itself."""
    timer = threading.Timer(seconds, running.end)
    timer.start()
    code = running.spin()
    assert timer.is_alive(), "the launch does not end"
    timer.cancel()
    return code


def node(kind, name="n", **attributes):
    extra = "".join(f' {key.replace("__", "-")}="{each}"' for key, each in attributes.items())
    return f'<node pkg="robot" type="{kind}" name="{name}"{extra}/>'


def test_parameters_are_cleared_and_set(launch, master):
    proxy = MasterProxy(master.uri, "/test")
    proxy.set_param("/g/old", 1)
    launch(
        '<group ns="g" clear_params="true"><param name="a" value="1"/></group>'
        '<param name="c" command="echo 1.5"/><rosparam>{l: [1, a], d: {e: true}}</rosparam>'
    )
    assert proxy.get_param("/g") == {"a": 1}
    assert proxy.get_param("/c") == 1.5
    assert proxy.get_param("/l") == [1, "a"]
    assert proxy.get_param("/d/e") is True
    proxy.close()


def test_dumps_and_deletes_come_first(launch, master, tmp_path):
    proxy = MasterProxy(master.uri, "/test")
    proxy.set_param("/x", {"y": 1})
    launch(
        f'<rosparam command="dump" param="x" file="{tmp_path}/d.yaml"/>'
        '<rosparam command="delete" param="x"/><param name="x/z" value="2"/>'
    )
    assert (tmp_path / "d.yaml").read_text() == "y: 1\n"
    assert proxy.get_param("/x") == {"z": 2}
    proxy.close()


def test_a_failing_command_stops_all_before_it_begins(launch, script, master):
    script("sleep.sh", SLEEP)
    with pytest.raises(LaunchError, match="ended with code 3") as caught:
        launch('<param name="c" command="sh -c \'echo why >&amp;2; exit 3\'"/>' + node("sleep.sh"))
    assert "why" in str(caught.value)
    assert caught.value.line == 2


def test_a_wrapper_of_a_command_finds_our_python(launch, script, master, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "/usr/bin:/bin")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    wrapper = script("wrap.sh", '#!/bin/sh\nexec "$@"\n')
    said = "import gazelle_ros; print(7)"
    launch(f'<param name="c" command="{wrapper} python3 -c \'{said}\'"/>')
    proxy = MasterProxy(master.uri, "/test")
    assert proxy.get_param("/c") == 7
    proxy.close()


def test_nodes_get_arguments_names_and_environment(launch, script, tmp_path):
    script(
        "say.sh",
        f'#!/bin/sh\necho "$@" "$ROS_NAMESPACE" "$E" "$ROS_MASTER_URI" > {tmp_path}/said\n',
    )
    running = launch(
        '<group ns="g"><env name="E" value="e"/><remap from="a" to="/b"/>'
        + node("say.sh", args="-x 'y z'")
        + "</group>"
    )
    assert spin(running) == 0
    words = (tmp_path / "said").read_text().split()
    assert words[:5] == ["-x", "y", "z", "a:=/b", "__name:=n"]
    assert words[5].startswith("__log:=")
    assert words[6:] == ["/g", "e", running.master_uri]


def test_output_goes_to_a_log_or_the_screen(launch, script, home, capfd):
    script("say.sh", "#!/bin/sh\necho hello $1\n")
    running = launch(
        node("say.sh", "quiet", args="log") + node("say.sh", "loud", args="screen", output="screen")
    )
    spin(running)
    assert "hello screen" in capfd.readouterr().out
    (log,) = home.rglob("quiet-1-stdout.log")
    assert log.read_text().startswith("hello log")


def test_prefixes_and_folders(launch, script, home, tmp_path):
    script("here.sh", f"#!/bin/sh\npwd > {tmp_path}/$1; nice >> {tmp_path}/$1\n")
    body = node("here.sh", "a", args="a", launch__prefix="nice -n 3")
    spin(launch(body + node("here.sh", "b", args="b", cwd="node")))
    assert (tmp_path / "a").read_text().split() == [str(home), str(min(19, os.nice(0) + 3))]
    assert (tmp_path / "b").read_text().split()[0].endswith("robot/scripts")


def test_a_python_before_a_python_node_is_taken_as_said(launch, script, tmp_path):
    script("write.py", f"#!/usr/bin/env python\nopen('{tmp_path}/done', 'w').close()\n")
    spin(launch(node("write.py", "a", launch__prefix="python3")))
    assert (tmp_path / "done").exists()


def test_a_node_without_program_is_named_and_left_out(launch, script):
    script("sleep.sh", SLEEP)
    running = launch(node("sleep.sh") + "\n" + node("slep.sh", "m"))
    assert len(running.processes) == 1
    said = [text for text in running.said if "left out" in text]
    assert len(said) == 1
    assert "ERROR" in said[0]
    assert "slep.sh" in said[0]


@pytest.mark.parametrize("also", ["", "required"])
def test_nothing_begins_when_no_node_or_a_required_one_has_no_program(launch, script, also):
    script("sleep.sh", SLEEP)
    wrong = node("slep.sh", "m", **({"required": "true"} if also else {}))
    with pytest.raises(LaunchError, match=r"did you mean 'sleep\.sh'") as caught:
        launch((node("sleep.sh") if also else "") + "\n" + wrong)
    assert caught.value.line == 3


def test_windows_are_left_out_with_one_notice(launch):
    running = launch(
        '<node pkg="rviz" type="rviz" name="a"/><node pkg="rviz" type="rviz" name="b"/>'
    )
    assert [text for text in running.said if "left out" in text] == [
        "nodes of 'rviz' are left out: it is a window for people"
    ]


def test_a_dead_node_is_respawned_after_its_delay(launch, script, tmp_path):
    script("die.sh", f"#!/bin/sh\ndate +%s.%N >> {tmp_path}/t\n")
    running = launch(node("die.sh", respawn="true", respawn_delay="0.4"))
    watcher = threading.Thread(target=running.spin)
    watcher.start()
    until(
        lambda: (
            len((tmp_path / "t").read_text().split()) >= 3 if (tmp_path / "t").exists() else False
        )
    )
    running.end()
    watcher.join()
    first, second, third = map(float, (tmp_path / "t").read_text().split()[:3])
    assert second - first >= 0.4
    assert third - second >= 0.4


def test_a_required_node_ends_the_launch(launch, script):
    script("sleep.sh", SLEEP)
    script("die.sh", "#!/bin/sh\nexit 2\n")
    running = launch(node("sleep.sh", "s") + node("die.sh", "r", required="true"))
    assert spin(running) == 1
    running.close()
    assert not is_running(running.processes[0].pid)
    assert any("exit code 2" in text for text in running.said)


@pytest.mark.long
def test_all_are_ended_with_all_they_started(launch, script, tmp_path):
    script("family.sh", f"#!/bin/sh\nsleep 100 &\necho $! > {tmp_path}/child\nwait\n")
    running = launch(node("family.sh"))
    until(lambda: (tmp_path / "child").exists() and (tmp_path / "child").read_text().strip())
    child = int((tmp_path / "child").read_text())
    running.close()
    assert not is_running(running.processes[0].pid)
    until(lambda: not is_running(child))


@pytest.mark.long
def test_the_stubborn_are_killed(launch, script, tmp_path):
    script(
        "no.sh",
        f"#!/bin/sh\ntrap '' INT TERM\ntouch {tmp_path}/up\nwhile true; do sleep 0.1; done\n",
    )
    running = launch(node("no.sh"), patience=StopTimeouts(0.3, 0.3))
    until((tmp_path / "up").exists)
    begin = time.monotonic()
    running.close()
    assert time.monotonic() - begin > 0.5
    assert not is_running(running.processes[0].pid)
    assert any("did not end on SIGINT" in text for text in running.said)


def test_processes_end_at_the_same_time(launch, script, tmp_path):
    # Each ends only when all have been asked to.
    script(
        "slow.sh",
        f"""#!/bin/sh
end() {{
  touch {tmp_path}/$1.asked
  while [ $(ls {tmp_path}/*.asked | wc -l) -lt 4 ]; do sleep 0.05; done
  exit 0
}}
trap "end $1" INT
touch {tmp_path}/$1
while true; do sleep 0.05; done
""",
    )
    running = launch("".join(node("slow.sh", f"n{i}", args=f"up{i}") for i in range(4)))
    until(lambda: all((tmp_path / f"up{i}").exists() for i in range(4)))
    running.close()
    assert not any("did not end" in text for text in running.said)


@pytest.mark.parametrize("pause", [0.0, 0.02, 0.05, 0.1, 0.2])
def test_nodes_that_are_stopped_while_they_start_say_nothing(launch, script, capfd, pause):
    script(
        "talker.py", "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('a')\nrospy.spin()\n"
    )
    running = launch(node("talker.py", "n", output="screen"))
    time.sleep(pause)
    running.close()
    assert "Traceback" not in (said := capfd.readouterr().err)
    assert "Fatal" not in said


def test_a_master_is_started_where_there_is_none(launch):
    uri = f"http://127.0.0.1:{free_port()}/"
    running = launch('<param name="a" value="1"/>', master_uri=uri)
    proxy = MasterProxy(uri, "/test")
    assert proxy.get_param("/a") == 1
    assert proxy.get_param("/run_id") == running.run_id
    running.close()
    with pytest.raises(MasterUnreachableError):
        proxy.get_pid()
    proxy.close()


def test_a_master_of_another_machine_is_not_started(launch):
    with pytest.raises(MasterUnreachableError, match="another machine"):
        launch("", master_uri="http://192.0.2.1:1/")


def test_the_launch_can_be_asked(launch, script, master):
    script("sleep.sh", SLEEP)
    running = launch(node("sleep.sh", "s"))
    proxy = MasterProxy(master.uri, "/test")
    (uri,) = proxy.get_param("/roslaunch/uris").values()
    client = BlockingClient(uri)
    assert client.call("get_pid")[2] == os.getpid()
    assert client.call("get_node_names")[2] == ["s-1"]
    assert client.call("list_processes")[2] == [[["s-1", 1]], []]
    assert client.call("process_info", "s-1")[2]["pid"] == running.processes[0].pid
    assert client.call("process_info", "nope")[0] == -1
    running.close()
    assert not proxy.has_param("/roslaunch/uris") or proxy.get_param("/roslaunch/uris") == {}
    client.close()
    proxy.close()


def test_another_run_id_is_refused(launch):
    with pytest.raises(LaunchError, match="run_id"):
        launch("", run_id="mine")


@pytest.mark.parametrize("address", ["localhost", "127.0.0.1"])
def test_local_machines_are_fine(launch, script, address):
    script("true.sh", "#!/bin/sh\n")
    body = f'<machine name="m" address="{address}"/>' + node("true.sh", machine="m")
    assert spin(launch(body)) == 0


@pytest.mark.parametrize(
    ("machine", "message"),
    [
        ('<machine name="m" address="192.0.2.7"/>', "192.0.2.7, not this one"),
        ("", "no machine 'm'"),
    ],
)
def test_other_machines_are_refused(launch, script, machine, message):
    script("true.sh", "#!/bin/sh\n")
    with pytest.raises(LaunchError, match=message):
        launch(machine + node("true.sh", machine="m"))


@pytest.mark.long
def test_the_command_ends_cleanly_on_ctrl_c(workspace, script, tmp_path):
    script("sleep.sh", f"#!/bin/sh\ntouch {tmp_path}/up\nexec sleep 100\n")
    file = tmp_path / "f.launch"
    file.write_text(f"<launch>{node('sleep.sh')}</launch>")
    uri = f"http://127.0.0.1:{free_port()}/"
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle_ros.cli.main", "launch", str(file)],
        env=os.environ | {"ROS_MASTER_URI": uri},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        until((tmp_path / "up").exists)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=120)
    finally:
        process.kill()
    assert process.returncode == 0
    assert "started a master" in out
    assert out.endswith("done\n")
    assert "Traceback" not in out


def test_python_nodes_import_rospy(launch, script, tmp_path):
    script(
        "node.py",
        "import rospy\nrospy.init_node('x')\n"
        f"open('{tmp_path}/name', 'w').write(rospy.get_name() + str(rospy.get_param('~p')))\n",
    )
    body = '<node pkg="robot" type="node.py" name="mine" ns="s"><param name="p" value="4"/></node>'
    assert spin(launch(body)) == 0
    assert (tmp_path / "name").read_text() == "/s/mine4"


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_no_node_is_left_however_the_command_ends(workspace, script, tmp_path, master, number):
    script("sleep.sh", f"#!/bin/sh\necho $$ > {tmp_path}/pid\nexec sleep 100\n")
    file = tmp_path / "f.launch"
    file.write_text(f"<launch>{node('sleep.sh')}</launch>")
    with subprocess.Popen(
        [sys.executable, "-m", "gazelle_ros.cli.main", "launch", str(file)],
        env=os.environ | {"ROS_MASTER_URI": master.uri},
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        # Only then has the watchdog been told of it.
        assert any(line.startswith("process[n-1]: started") for line in process.stdout)
        until(lambda: (tmp_path / "pid").exists() and (tmp_path / "pid").read_text())
        process.send_signal(number)
        process.wait(60)
    pid = int((tmp_path / "pid").read_text())
    until(lambda: not is_running(pid))
