"""The program gz, as scripts call it, steers a simulator on the graph."""

from __future__ import annotations

import threading

import pytest

import gazelle
from gazelle.bridges import serve_ros
from gazelle.clients.gz import main
from gazelle.clients.gz_elsewhere import NOT_HERE
from gazelle_ros import Master


@pytest.fixture
def sim(monkeypatch):
    with Master(port=0, rosout=False) as master, gazelle.Simulation("turtlebot3_stage_1") as made:
        made.spawn("turtlebot3_burger", name="r1", namespace="/")
        monkeypatch.setenv("ROS_MASTER_URI", master.uri)
        with serve_ros(made, master.uri) as server:
            running = threading.Thread(target=server.run)
            running.start()
            yield made
            server.stop()
            running.join()


def test_steps_pause_the_world_and_are_made_when_it_returns(sim):
    assert main(["world", "-p", "1"]) == 0
    before = sim.time
    assert main(["world", "-m", "100"]) == 0
    assert sim.time == pytest.approx(before + 0.1)
    assert main(["world", "-p", "0"]) == 0
    assert main(["world", "-s"]) == 0
    assert sim.paused


def test_resets_put_back_the_models(sim):
    sim.robots["r1"].set_pose((1.0, 0.0, 0.0))
    assert main(["world", "-p", "1", "-o"]) == 0
    assert sim.robots["r1"].pose.position[0] == pytest.approx(0.0, abs=1e-6)
    assert main(["world", "-r"]) == 0
    assert sim.time == 0.0


def test_physics_and_models(sim, capsys):
    assert main(["physics", "-u", "500", "-s", "0.002", "-g", "0,0,-3.7"]) == 0
    assert sim.physics.time_step == 0.002
    assert sim.physics.gravity[2] == -3.7
    assert main(["model", "-m", "r1", "-p"]) == 0
    assert len(capsys.readouterr().out.split()) == 6
    assert main(["model", "-m", "r1", "-d"]) == 0
    assert "r1" not in sim.robots


BALL = """<sdf version='1.6'><model name='b'><link name='l'><inertial><mass>1</mass></inertial>
<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model></sdf>"""


def test_models_are_put_there_moved_and_described(sim, tmp_path, capsys):
    assert main(["world", "-p", "1"]) == 0
    file = tmp_path / "ball.sdf"
    file.write_text(BALL)
    assert main(["model", "-m", "ball", "-f", str(file), "-x", "-1.5", "-z", "2"]) == 0
    assert sim.robots["ball"].pose.position == pytest.approx([-1.5, 0.0, 2.0])
    assert main(["model", "-m", "ball", "-y", "0.5", "-Y", "1.0"]) == 0
    assert sim.robots["ball"].pose.position == pytest.approx([-1.5, 0.5, 2.0])
    assert main(["model", "-m", "ball", "-i"]) == 0
    assert "position: -1.5 0.5 2\n" in capsys.readouterr().out


def test_what_is_no_file_is_told(sim):
    with pytest.raises(gazelle.Error, match="cannot be read"):
        main(["model", "-m", "ball", "-f", "/nowhere/ball.sdf"])


@pytest.mark.long
def test_times_are_told_until_the_duration_is_over(sim, capsys):
    assert main(["stats", "-d", "0.3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines
    assert all(line.startswith("Factor[") and line.endswith("Paused[F]") for line in lines)
    assert main(["stats", "-d", "0.1", "-p"]) == 0
    assert capsys.readouterr().out.startswith("# real-time factor")


def test_an_effort_lasts_until_there_is_another(sim):
    assert main(["world", "-p", "1"]) == 0
    joint = sim.robots["r1"].joints["wheel_left_joint"]
    assert main(["joint", "-m", "r1", "-j", "wheel_left_joint", "-f", "-0.001"]) == 0
    assert main(["world", "-m", "50"]) == 0
    moved = float(joint.position)
    assert moved != 0.0


@pytest.mark.parametrize("name", sorted(NOT_HERE))
def test_what_is_for_a_window_names_what_does_it(name, capsys):
    assert main([name, "-c", "gzclient_camera", "-f", "x"]) == 1
    said = capsys.readouterr().err
    assert said.startswith(f"gz {name}: ")
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize("words", [["help"], ["help", "model"], ["--help"]])
def test_help_is_printed(words, capsys):
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 0
    assert "usage: gz" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("model -m a --nonsense", "it does not know --nonsense: 'gz help model'"),
        (
            "joint -m a -j b --vel-t 1.0 --vel-p 2",
            "it does not know --vel-t 1.0 --vel-p 2: only -f",
        ),
        ("joint -m a -j b", "only -f is there"),
        ("physics -o fast", "profiles (-o) are not read"),
        ("sdf -d", "it does not know -d: -k and -p are there"),
        ("sdf", "-k and -p are there"),
        ("topic", "-l, -e, -i, -z, -b and -d are there"),
        ("topic -v /x", "'gazelle view' shows"),
        ("world -t", "-r puts back the time too"),
    ],
)
def test_options_that_are_not_here_are_one_line(words, said, capsys):
    assert main(words.split()) == 2
    err = capsys.readouterr().err
    assert said in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize("word", ["-v", "--version", "--versions"])
def test_the_version_is_gazelles(word, capsys):
    with pytest.raises(SystemExit) as ended:
        main([word])
    assert ended.value.code == 0
    assert gazelle.__version__ in capsys.readouterr().out


@pytest.mark.long
def test_messages_are_printed_until_the_duration_is_over(sim, capfd):
    assert main(["topic", "-e", "/clock", "-d", "4", "-w", "default"]) == 0
    assert "clock" in capfd.readouterr().out


@pytest.mark.parametrize("words", [["nonsense"], ["model"], []])
def test_what_is_unknown_is_a_usage_error(words, capsys):
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2


@pytest.mark.long
@pytest.mark.parametrize(
    ("words", "said"), [("sdf -k", "0 errors"), ("sdf -p", "<model name='b'>")]
)
def test_files_are_checked_and_printed_without_a_simulator(tmp_path, capfd, words, said):
    file = tmp_path / "ball.sdf"
    file.write_text(BALL)
    assert main([*words.split(), str(file)]) == 0
    assert said in capfd.readouterr().out.replace('"', "'")
