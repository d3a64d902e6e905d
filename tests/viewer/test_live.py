"""A world in the plane is shown live to a browser on this machine, and to nobody else."""

import http.client
import json
import math
import threading
import time
from urllib.parse import urlsplit

import pytest

import gazelle
from gazelle import assets
from gazelle.errors import Error
from gazelle.simulation import Simulation
from gazelle.viewer import LiveView

ROOM = """
define robot position ( size [.4 .4 .4] drive "diff"
  ranger ( sensor ( range [0 4] fov 90 samples 46 ) ) )
model ( size [4 .2 1] pose [0 1.5 0 0] )
model ( size [4 .2 1] pose [0 -1.5 0 0] )
robot ( name "r" pose [-1 0 0 90] )
"""


@pytest.fixture
def room(tmp_path):
    file = tmp_path / "room.world"
    file.write_text(ROOM)
    with Simulation(file, "planar", threads=1) as simulation:
        yield simulation


def connect(view):
    where = urlsplit(view.url)
    return http.client.HTTPConnection(where.hostname, where.port, timeout=60)


def get(view, path, method="GET", **headers):
    connection = connect(view)
    connection.request(method, path, headers=headers)
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer, body


def states(view):
    """The states of a stream, as they come."""
    connection = connect(view)
    connection.request("GET", "/events")
    answer = connection.getresponse()
    assert answer.headers["Content-Type"] == "text/event-stream"
    try:
        while True:
            line = answer.readline()
            if not line:
                return
            if line.startswith(b"data: "):
                yield json.loads(line[6:])
    finally:
        answer.close()
        connection.close()


def test_it_listens_to_this_machine_only(room):
    with LiveView(room) as view:
        assert view.url.startswith("http://127.0.0.1:")
        assert view._server.server_address[0] == "127.0.0.1"
        assert get(view, "/", Host="evil.example:80")[0].status == 403
        assert get(view, "/", Host="localhost:80")[0].status == 200


def test_the_page_and_nothing_else_is_served(room):
    with LiveView(room) as view:
        answer, body = get(view, "/")
        assert answer.status == 200
        assert b"<canvas" in body
        assert b"http" not in body.replace(b"http-equiv", b"")  # nothing from elsewhere
        assert "default-src 'self'" in answer.headers["Content-Security-Policy"]
        assert answer.headers["Access-Control-Allow-Origin"] is None
        for path in ("/../pyproject.toml", "/live.py", "/world/", "/%2e%2e/"):
            assert get(view, path)[0].status == 404
        for method in ("POST", "PUT", "DELETE"):
            assert get(view, "/world", method)[0].status == 501


def test_the_scenery_is_what_stands_and_what_bodies_look_like(room):
    with LiveView(room) as view:
        scenery = json.loads(get(view, "/world")[1])
    assert len(scenery["lines"]) == 4 * 8
    assert scenery["circles"] == []
    (body,) = scenery["bodies"]
    assert sorted(body["parts"][0]) == pytest.approx([-0.2] * 4 + [0.2] * 4)
    x0, y0, x1, y1 = scenery["extent"]
    assert x0 < -2 < 2 < x1
    assert y0 < -1.6 < 1.6 < y1


def test_states_follow_the_simulation(room):
    with LiveView(room, rate=100) as view:
        stream = states(view)
        first = next(stream)
        assert first["time"] == 0.0
        assert first["poses"] == pytest.approx([-1, 0, math.pi / 2], abs=1e-3)
        (scan,) = first["scans"]
        assert scan["eye"] == [-1.0, 0.0]
        assert len(scan["met"]) == 46
        assert scan["ends"][47] == pytest.approx(1.4, abs=2e-3)  # a degree beside the middle
        assert scan["met"][23] == 1
        room.stage.commands[0, 0, 0] = 1.0
        room.run(1.0)
        later = next(state for state in stream if state["time"] >= 1.0)
        assert later["poses"][1] == pytest.approx(room.stage.poses[0, 0, 1], abs=1e-3)
        room.run(1.0)
        stalled = next(state for state in stream if state["time"] >= 2.0)
        assert stalled["stalled"] == [0]
        stream.close()


def test_states_come_at_the_rate_while_it_runs(room):
    with LiveView(room, rate=20) as view:
        over = threading.Event()

        def run():
            while not over.is_set():
                room.run(0.1, rate=1.0)

        runner = threading.Thread(target=run)
        start = time.monotonic()
        runner.start()
        stream = states(view)
        for _ in range(21):
            next(stream)
        lasted = time.monotonic() - start
        over.set()
        runner.join()
        stream.close()
    assert lasted > 20 / 20 - 0.2


def test_nothing_is_looked_at_while_no_page_is_open(room, monkeypatch):
    with LiveView(room, rate=100) as view:
        monkeypatch.setattr(view._look, "state", lambda: pytest.fail("nobody looks"))
        room.run(1.0)
        time.sleep(0.1)


def test_pages_beyond_a_number_are_refused(room):
    with LiveView(room, rate=50) as view:
        streams = [states(view) for _ in range(8)]
        for stream in streams:
            next(stream)
        assert get(view, "/events")[0].status == 503
        for stream in streams:
            stream.close()
        end = time.monotonic() + 60
        while time.monotonic() < end:  # a place is free once a page is closed
            if view._guests.acquire(blocking=False):
                break
            time.sleep(0.05)
        else:
            pytest.fail("no page was let go")


def test_it_ends_and_frees_its_port(room):
    view = LiveView(room)
    stream = states(view)
    next(stream)
    view.close()
    list(stream)
    with pytest.raises(OSError, match="refused"):
        get(view, "/")
    assert not [t for t in threading.enumerate() if t.name == "live-view"]


def test_random_numbers_of_a_run_do_not_depend_on_a_page(tmp_path):
    text = ROOM.replace("samples 46", "samples 46 noise [0.1 0 2]")
    (tmp_path / "noisy.world").write_text(text)
    scans = []
    for watched in (False, True):
        with Simulation(tmp_path / "noisy.world", "planar", seed=1, threads=1) as sim:
            if watched:
                with LiveView(sim, rate=100) as view:
                    next(states(view))
            sim.step()
            scans.append(sim.stage.scan_of("r"))
    assert (scans[0] == scans[1]).all()


def test_any_world_in_the_plane_is_shown_and_models_may_come():
    with (
        gazelle.Simulation("turtlebot3_stage_4", engine="planar") as sim,
        LiveView(sim, rate=100) as view,
    ):
        stream = states(view)
        before = next(stream)["version"]
        sim.spawn(assets.robot("turtlebot3_burger"), name="burger")
        sim.run(0.5)
        now = next(state for state in stream if state["version"] > before)
        assert len(now["poses"]) == 3 * len(json.loads(get(view, "/world")[1])["bodies"])
        assert now["scans"]
        stream.close()


def test_what_is_not_in_the_plane_cannot_be_shown():
    with gazelle.Simulation("empty") as sim, pytest.raises(Error, match="in the plane"):
        LiveView(sim)


def test_a_port_that_is_taken_is_told(room):
    with LiveView(room) as view, pytest.raises(Error, match="no view on port"):
        LiveView(room, port=urlsplit(view.url).port)
    with pytest.raises(Error, match="no view on port"):
        LiveView(room, port=70000)
    with pytest.raises(Error, match="rate above zero"):
        LiveView(room, rate=0)
