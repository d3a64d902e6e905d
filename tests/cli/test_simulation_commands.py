"""`gazelle run`, `check` and the lists."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time

import pytest
from ros.graph import until

from gazelle.cli.bench import benchmarks


def test_run_simulates_for_a_time(cli):
    code, out, err = cli("run", "turtlebot3_stage_1", "--for", 0.5, "--rate", "max")
    assert code == 0
    assert "turtlebot3_square" in out
    assert re.search(r"simulated 0\.50 s in [\d.]+ s, RTF [\d.]+", err)


def test_run_keeps_to_the_wall_clock(cli):
    for _ in range(20):  # a pause makes one slower
        start = time.monotonic()
        code, _, err = cli("run", "empty", "--for", 0.6, "--rate", 2.0)
        assert code == 0
        assert time.monotonic() - start > 0.28
        factor = float(re.search(r"RTF ([\d.]+)", err).group(1))
        assert factor < 2.3
        if factor > 1.7:
            break
    assert factor > 1.7


def test_run_of_an_unknown_world_suggests_the_closest(cli):
    code, _, err = cli("run", "turtlebot3_stage_l")
    assert code == 1
    assert "did you mean 'turtlebot3_stage_" in err


def test_run_with_an_unknown_engine_is_an_error(cli):
    code, _, err = cli("run", "empty", "--engine", "mujoko")
    assert code == 1
    assert "did you mean 'mujoco'" in err


@pytest.mark.parametrize(
    "arguments", [("--for", "-1"), ("--rate", "slow"), ("--paused", "--for", "1")]
)
def test_run_refuses_what_makes_no_sense(cli, arguments):
    assert cli("run", "empty", *arguments)[0] == 2


def behind_a_script():
    """Ignore Ctrl-C, as a shell does for what a script runs with &."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


STEPS = """
import sys
from gazelle.simulation import SystemPlugin
class Steps(SystemPlugin):
    update_rate = 10.0
    def on_update(self, time):
        sys.stderr.write("it steps\\n")
        sys.stderr.flush()
"""


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize(
    ("extra", "before", "sign"),
    [
        (["--plugins", ".", "--system", "steps:Steps"], behind_a_script, "it steps"),
        (["--paused"], None, "paused"),
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
def test_interrupt_ends_a_run_cleanly(extra, before, sign, number, tmp_path):
    (tmp_path / "steps.py").write_text(STEPS)
    said = tmp_path / "said.txt"
    with said.open("w") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", "gazelle.cli.main", "run", "empty", *extra],
            stdout=subprocess.DEVNULL, stderr=out, cwd=tmp_path,
            preexec_fn=before,  # noqa: PLW1509  # nothing else runs here
        )  # fmt: skip
    try:
        until(lambda: sign in said.read_text())
        os.kill(process.pid, number)
        assert process.wait(60) == 128 + number
    finally:
        process.kill()
        process.wait()
    assert "Traceback" not in said.read_text()
    assert "simulated" in said.read_text()


def test_check_of_a_good_file(cli):
    code, out, _ = cli("check", "turtlebot3_stage_1", "turtlebot3_burger")
    assert (code, out) == (0, "turtlebot3_stage_1: ok\nturtlebot3_burger: ok\n")


def test_what_a_macro_repeats_is_one_line(cli, tmp_path):
    inertial = (
        "<inertial><mass value='1'/>"
        "<inertia ixx='1' iyy='{}' izz='{}' ixy='0' ixz='0' iyz='0'/></inertial></link>"
    )
    wheel = (
        f"<link name='w${{n}}'>{inertial.format(0.1, 0.1)}"
        "<joint name='j${n}' type='continuous'><parent link='b'/><child link='w${n}'/></joint>"
    )
    file = tmp_path / "robot.urdf.xacro"
    file.write_text(
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>"
        f"<link name='b'>{inertial.format(1, 1)}\n"
        f"<xacro:macro name='wheel' params='n'>{wheel}</xacro:macro>\n"
        "<xacro:wheel n='1'/><xacro:wheel n='2'/><xacro:wheel n='3'/></robot>"
    )
    _, out, _ = cli("check", "--files-only", str(file))
    assert [line for line in out.splitlines() if "(3 times)" in line] == [
        line for line in out.splitlines() if "inertia-triangle" in line
    ]
    assert out.count("inertia-triangle") == 1


def test_check_names_file_and_line_and_fails(cli, tmp_path):
    file = tmp_path / "bad.urdf"
    file.write_text(
        '<robot name="r">\n  <link name="a">\n    <inertial>\n      <mass value="x"/>\n'
    )
    code, out, _ = cli("check", file)
    assert code == 1
    assert re.search(rf"error: {re.escape(str(file))}:\d+: ", out)
    assert out.endswith("bad.urdf: 1 error, 0 warnings\n")


@pytest.mark.parametrize(
    ("root", "fault"),
    [
        ('robot name="arm"', "a <robot> needs a <link>"),
        ("robot", "a <robot> needs a <link>"),
        ("root", "expected <sdf> or <robot>, found <root>"),
    ],
)
def test_check_warns_of_a_xacro_file_without_links(cli, tmp_path, root, fault):
    text = f"""<{root} xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="finger" params="at"><link name="${{at}}"/></xacro:macro>
      </{root.split()[0]}>"""
    file = tmp_path / "fingers.urdf.xacro"
    file.write_text(text)
    code, out, _ = cli("check", str(file))
    assert code == 0
    assert f"warning: {file}:1: {fault} [only-macros]" in out
    whole = tmp_path / "fingers.urdf"
    whole.write_text(text)
    code, out, _ = cli("check", str(whole))
    assert code == 1
    assert f"error: {whole}:1: {fault}" in out


def test_check_fails_for_a_plugin_that_fails(cli, tmp_path):
    file = tmp_path / "wrong.world"
    file.write_text(
        '<sdf version="1.6"><world name="w"><model name="m"><link name="l"/>\n'
        '<plugin name="p" filename="libgazebo_ros_p3d.so"/></model></world></sdf>'
    )
    code, out, _ = cli("check", file)
    assert code == 1
    assert re.search(r"error: .*wrong\.world:2: plugin 'p' of 'm' failed .*<bodyName>", out)


def test_check_warns_of_an_unsupported_plugin_without_failing(cli, tmp_path):
    file = tmp_path / "odd.world"
    file.write_text(
        '<sdf version="1.6"><world name="w">'
        '<plugin name="p" filename="libmakes_coffee.so"/></world></sdf>'
    )
    code, out, _ = cli("check", file)
    assert code == 0
    assert "warning: " in out
    assert "libmakes_coffee.so" in out
    assert "0 errors, 1 warning\n" in out
    assert "0 errors, 1 warning" not in cli("check", "--files-only", file)[1]


@pytest.mark.parametrize(
    ("command", "entry"),
    [
        ("robots", "turtlebot3_burger"),
        ("worlds", "turtlebot3_stage_4"),
        ("plugins", "libgazebo_ros_diff_drive.so"),
    ],
)
def test_lists_name_what_there_is(cli, command, entry):
    code, out, _ = cli(command)
    assert code == 0
    assert any(line.startswith(entry) for line in out.splitlines())


def test_unknown_benchmark_is_an_error(cli):
    code, _, err = cli("bench", "no_such_benchmark")
    assert code == 1
    assert "there is no benchmark 'no_such_benchmark'" in err


@pytest.mark.long
@pytest.mark.parametrize("name", benchmarks())
def test_every_benchmark_says_what_it_measures(name):
    command = [sys.executable, "-m", "gazelle", "bench", name, "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout.startswith(f"usage: gazelle bench {name} "), done.stderr


STAGE = """# two robots in a yard
define car position ( size [0.4 0.4 0.3] drive "diff" localization "gps" )
model ( name "wall" size [10 0.2 1] pose [0 3 0 0] )
car ( name "a" pose [0 0 0 0] )
car ( name "b" pose [2 0 0 90] )
"""


def test_run_of_a_stage_file_goes_in_the_plane(cli, tmp_path):
    file = tmp_path / "yard.world"
    file.write_text(STAGE, encoding="utf-8")
    code, out, err = cli("run", file, "--for", 2, "--rate", "max")
    assert code == 0, err
    assert "world 'yard' (planar, step 100 ms): ground_plane, wall, a, b" in out
    assert "simulated 2.00 s" in err


def test_run_keeps_to_the_speedup_and_quit_time_of_a_stage_file(cli, tmp_path):
    file = tmp_path / "one.world"
    file.write_text("speedup 40 quit_time 8\nposition ( )\n")
    start = time.monotonic()
    code, _, err = cli("run", file)
    assert code == 0
    assert "simulated 8.00 s" in err
    assert time.monotonic() - start > 0.19
    file.write_text("speedup 0 quit_time 8\nposition ( )\n")
    assert "simulated 4.00 s" in cli("run", file, "--for", 4)[2]
    assert cli("run", file, "--for", 0.3, "--rate", 1)[0] == 0


def test_run_of_a_stage_file_takes_other_robots_too(cli, tmp_path):
    file = tmp_path / "yard.world"
    file.write_text(STAGE, encoding="utf-8")
    code, out, err = cli(
        "run", file, "--spawn", "turtlebot3_burger@-3,0", "--for", 1, "--rate", "max"
    )
    assert code == 0, err
    assert "wall, a, b, turtlebot3_burger" in out
    assert "simulated 1.00 s" in err


def test_a_fleet_that_stands_says_how_it_moves(cli):
    line = "nothing drives the robots: --wander does"
    code, out, _ = cli("run", "fleet", "--for", 0.2, "--rate", "max")
    assert (code, line in out) == (0, True)
    code, out, _ = cli("run", "fleet", "--for", 0.2, "--rate", "max", "--wander")
    assert (code, line in out) == (0, False)
    code, out, _ = cli("run", "empty", "--for", 0.1, "--rate", "max")
    assert (code, line in out) == (0, False)
    code, _, err = cli("run", "fleet", "--for", 0.1, "--wander", "--ros")
    assert (code, "--wander and --ros cannot be used together" in err) == (2, True)


@pytest.mark.parametrize("world", ["fleet", "empty"])
def test_run_says_where_its_view_is(cli, world):
    pytest.importorskip("viser", reason="the extra 'web' is not installed")
    code, out, _ = cli("run", world, "--for", 0.2, "--view")
    assert code == 0
    assert re.search(r"view http://127\.0\.0\.1:\d+/[\w-]{20,}/\n", out)
    assert "viser" not in out


def test_a_view_without_its_extra_says_what_to_install(cli, monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    code, _, err = cli("run", "empty", "--for", 0.1, "--view")
    assert code == 1
    assert 'pip install "gazelle[web]"' in err
