"""`gazelle master` answers soon, keeps to loopback, and ends without a trace."""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import socket
import subprocess
import sys
import time

import pytest
from ports import free_port

from gazelle_ros import Master, MasterProxy
from gazelle_ros.errors import RosError


@pytest.fixture
def start():
    started = []

    def begin(*arguments):
        command = [sys.executable, "-m", "gazelle.cli.main", "master", *arguments]
        started.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        return started[-1]

    yield begin
    for process in started:
        process.kill()
        process.wait()
        process.stdout.close()


def test_it_answers_soon_and_ends_on_a_signal(start):
    spent = []
    for _ in range(3):
        port, before = free_port(), resource.getrusage(resource.RUSAGE_CHILDREN)
        begin = time.monotonic()
        process = start("--port", str(port))
        proxy = MasterProxy(f"http://127.0.0.1:{port}/", "/test")
        while True:
            with contextlib.suppress(RosError):
                proxy.lookup_node("/rosout")
                break
            assert time.monotonic() - begin < 60
            time.sleep(0.005)
        assert proxy.get_param("/run_id")
        process.send_signal(signal.SIGTERM)
        assert process.wait(60) == 0
        assert process.stdout.readline() == f"ROS master at http://127.0.0.1:{port}/\n"
        proxy.close()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    assert min(spent) < 1.0, "0.2 s of the processor's time, with rosout"


def test_it_listens_on_loopback_only(start):
    process = start("--port", "0", "--no-rosout")
    port = int(process.stdout.readline().rstrip("/\n").rpartition(":")[2])
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
        except OSError:
            pytest.skip("there is no network")
        outside = probe.getsockname()[0]
    if outside.startswith("127."):
        pytest.skip("there is no network")
    socket.create_connection(("127.0.0.1", port), timeout=60).close()
    with pytest.raises(OSError, match="refused"):
        socket.create_connection((outside, port), timeout=5)


@pytest.mark.long
def test_a_taken_port_is_one_clear_error(cli):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        code, _, err = cli("master", "--port", port, "--no-rosout")
    assert code == 1
    assert f"cannot listen on 127.0.0.1:{port}" in err
    assert "a program that is not a ROS master has that port" in err
    assert "--port 11312" in err


def test_a_second_master_hears_of_the_first(cli):
    with Master(port=0, rosout=False) as first:
        code, _, err = cli("master", "--port", first.port, "--no-rosout")
    assert code == 1
    assert f"a ROS master runs there already, process {os.getpid()}" in err


def test_a_bad_port_is_wrong_usage(cli):
    assert cli("master", "--port", "99999")[0] == 2


def test_the_node_that_collects_logs_has_the_services_of_every_node():
    with Master(port=0) as master, contextlib.closing(MasterProxy(master.uri, "/asker")) as proxy:
        services = proxy.system_state()[2]
    assert sorted(services) == ["/rosout/get_loggers", "/rosout/set_logger_level"]
