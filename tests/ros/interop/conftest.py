"""The roscpp node of the tests, compiled once."""

from __future__ import annotations

import contextlib
import shutil
import signal
import subprocess
from pathlib import Path

import pytest
from ros import real

from gazelle_ros import Master, MasterProxy, Node
from gazelle_ros.errors import ApiError

SOURCE = Path(__file__).parent / "peer.cpp"


@pytest.fixture(scope="session")
def peer_program(tmp_path_factory):
    """Return the path of the compiled node."""
    if not real.INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    if shutil.which("g++") is None or shutil.which("pkg-config") is None:
        pytest.skip("no C++ compiler (Debian: g++ pkg-config)")
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "roscpp"], capture_output=True, text=True, check=False
    )
    if flags.returncode:
        pytest.skip("roscpp is not installed (Debian: libroscpp-dev)")
    program = tmp_path_factory.mktemp("roscpp") / "peer"
    command = ["g++", "-std=c++17", "-O0", str(SOURCE), "-o", str(program), *flags.stdout.split()]
    subprocess.run(command, check=True, timeout=300)
    return program


class CppNode(real.RealNode):
    """The roscpp node in one of its modes."""

    def __init__(self, uri, program, *arguments):
        self.process = subprocess.Popen(
            [program, *map(str, arguments)],
            env=real.environment(uri),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def __exit__(self, *error):
        # This it takes as a request to unregister and end; others just end it.
        self.process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(20)
        super().__exit__(*error)


@pytest.fixture(scope="module", params=["our master", "real roscore"])
def running_master(request):
    """Yield the URI of a master of either kind."""
    if request.param == "our master":
        with Master(port=0) as running:
            yield running.uri
    else:
        with real.master() as uri:
            yield uri


@pytest.fixture
def graph(running_master):
    """Yield the URI of a master without parameters of other tests."""
    yield running_master
    proxy = MasterProxy(running_master, "/test")
    for name in ("use_sim_time", "shared", "theirs", "followed", "gain", "cpp"):
        with contextlib.suppress(ApiError):
            proxy.delete_param(f"/{name}")
    proxy.close()


@pytest.fixture
def node(graph):
    with Node("ours", master_uri=graph) as made:
        yield made


@pytest.fixture
def start(peer_program, graph):
    """Start the roscpp node in a mode; it ends with the test."""
    with contextlib.ExitStack() as running:
        yield lambda *words: running.enter_context(CppNode(graph, peer_program, *words))
