"""Programs of rviz and rqt open the page of the graph, with the panel that they are."""

import os
import signal
import subprocess
import sys

import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.errors import Error
from gazelle.viewer.graph import programs
from gazelle.viewer.graph.panels.table import PANELS
from gazelle_ros import Master
from gazelle_ros.builtin import registry
from gazelle_ros.compat import script


@pytest.fixture
def opened(monkeypatch):
    """Return what programs open, without a page."""
    calls = []

    class View:
        url, ended = "http://here", True

        def __init__(self, master_uri, *, frame=None):
            calls.append(frame)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def open_panel(self, title, arguments=()):
            calls.append((title, list(arguments)))

    monkeypatch.setattr(programs, "GraphView", View)
    return calls


@pytest.mark.parametrize("package", [name for name in programs.WINDOWS if name.startswith("rqt_")])
def test_each_program_of_rqt_has_a_panel(opened, package):
    assert registry.main_of(package, package)(["/topic/x", "__name:=n"]) == 0
    if package == "rqt_gui":
        assert opened == [None]
    else:
        title, arguments = opened[1]
        assert title in PANELS
        assert arguments == ["/topic/x"]


def test_rqt_gui_opens_the_panel_of_a_plugin(opened):
    registry.main_of("rqt_gui", "rqt_gui")(["-s", "rqt_plot"])
    assert opened == [None, ("Plot", [])]


def test_rviz_has_the_fixed_frame_of_its_file(opened, tmp_path):
    file = tmp_path / "robot.rviz"
    file.write_text("Visualization Manager:\n  Global Options:\n    Fixed Frame: odom\n")
    main = registry.main_of("rviz", "rviz")
    main(["-d", str(file)])
    main(["-d", str(file), "-f", "base_link"])
    main([])
    assert opened == ["odom", "base_link", None]
    file.write_text("a: [")
    with pytest.raises(Error, match="not a configuration of RViz"):
        main(["-d", str(file)])
    file.write_text("- 1")
    assert programs.fixed_frame_of(file) is None


def test_rosrun_runs_them_and_only_them(monkeypatch):
    monkeypatch.setattr(script, "become", lambda words: words)
    assert script.run_named("rqt_plot", ["rqt_plot", "/a/b"])[-3:] == [
        "rqt_plot",
        "rqt_plot",
        "/a/b",
    ]
    with pytest.raises(Error, match="'rqt_shell' is left out"):
        script.run_named("rqt_shell", ["rqt_shell"])


@pytest.mark.long
def test_a_program_prints_the_address_of_its_page_and_ends():
    with Master("127.0.0.1", 0) as master:
        words = [sys.executable, "-m", "gazelle_ros.builtin.start", "rqt_plot", "rqt_plot", "/a/b"]
        environment = {**os.environ, "ROS_MASTER_URI": master.uri}
        program = subprocess.Popen(words, stderr=subprocess.PIPE, text=True, env=environment)
        assert program.stderr.readline().startswith("view http://127.0.0.1:")
        program.send_signal(signal.SIGINT)
        _, rest = program.communicate(timeout=60)
        assert "Traceback" not in rest
