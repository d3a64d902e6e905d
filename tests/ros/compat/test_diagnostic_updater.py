"""diagnostic_updater: statuses of a node, merged and published as ROS 1's does."""

import importlib

import pytest
from graph import until


@pytest.fixture
def diagnostics(node):
    return importlib.import_module("diagnostic_updater")


@pytest.fixture
def updater(node, diagnostics):
    """Return an updater, and the statuses it published by their names."""
    kind = importlib.import_module("diagnostic_msgs.msg").DiagnosticArray
    found = {}
    node.Subscriber(
        "/diagnostics", kind, lambda array: found.update({each.name: each for each in array.status})
    )
    made = diagnostics.Updater()
    made.setHardwareID("arm 7")
    until(made.publisher.get_num_connections)
    return made, found


def summaries(*pairs):
    def fill(status):
        for pair in pairs:
            status.mergeSummary(*pair)
        status.add("pairs", len(pairs))
        return status

    return fill


@pytest.mark.parametrize(
    ("pairs", "level", "message"),
    [
        ([(0, "fine")], 0, "fine"),
        ([(1, "warm"), (0, "fine")], 1, "warm"),
        ([(0, "fine"), (2, "hot")], 2, "hot"),
        ([(1, "warm"), (2, "hot")], 2, "warm; hot"),
        ([(0, "a"), (0, "b")], 0, "a; b"),
    ],
)
def test_the_worst_level_counts(diagnostics, pairs, level, message):
    status = diagnostics.DiagnosticStatusWrapper()
    summaries(*pairs)(status)
    assert (status.level, status.message) == (level, message)
    assert status.values[0].value == str(len(pairs))
    status.clearSummary()
    assert (status.level, status.message) == (0, "")


def test_all_tasks_are_published(diagnostics, updater):
    made, found = updater
    both = diagnostics.CompositeDiagnosticTask("both")
    for name, pair in (("a", (1, "warm")), ("b", (2, "hot"))):
        task = diagnostics.FunctionDiagnosticTask(
            name, lambda status, pair=pair: said(status, pair)
        )
        both.addTask(task)
    made.add(both)
    made.add("silent", lambda status: status)
    made.add(diagnostics.Heartbeat())
    made.add("gone", lambda status: status)
    assert made.removeByName("gone")
    assert not made.removeByName("gone")
    made.force_update()
    until(lambda: found.get("probe: both") and found["probe: both"].level == 2)
    assert found["probe: both"].message == "warm; hot"
    assert found["probe: both"].hardware_id == "arm 7"
    assert found["probe: silent"].message == "No message was set"
    assert found["probe: Heartbeat"].message == "Alive"
    made.broadcast(1, "ends")
    until(lambda: found["probe: Heartbeat"].message == "ends")


def said(status, pair):
    status.summary(*pair)
    return status


@pytest.mark.parametrize(
    ("bounds", "ticks", "message"),
    [
        ({"min": 1e-6, "max": 1e9}, 3, "Desired frequency met"),
        ({"min": 1e9, "max": 1e9}, 3, "Frequency too low."),
        ({"min": 1e-9, "max": 1e-6}, 3, "Frequency too high."),
        ({"min": 1.0}, 0, "No events recorded."),
    ],
)
def test_frequencies_have_limits(diagnostics, bounds, ticks, message):
    task = diagnostics.FrequencyStatus(diagnostics.FrequencyStatusParam(bounds))
    for _ in range(ticks):
        task.tick()
    status = task.run(diagnostics.DiagnosticStatusWrapper())
    assert status.message == message
    assert {"key": "Events in window", "value": str(ticks)} in [
        {"key": each.key, "value": each.value} for each in status.values
    ]


@pytest.mark.parametrize(
    ("ages", "message"),
    [
        ([0.0], "Timestamps are reasonable."),
        ([], "No data since last update."),
        ([1e6], "Timestamps too far in past seen."),
        ([0.0, -1e6], "Timestamps too far in future seen."),
        ([0.0, None], "Zero timestamp seen."),
    ],
)
def test_stamps_have_limits(node, diagnostics, ages, message):
    task = diagnostics.TimeStampStatus()
    for age in ages:
        task.tick(0.0 if age is None else node.get_time() - age)
    assert task.run(diagnostics.DiagnosticStatusWrapper()).message == message
    assert task.run(diagnostics.DiagnosticStatusWrapper()).message == "No data since last update."


def test_a_publisher_is_diagnosed(node, diagnostics, updater):
    made, found = updater
    imu = importlib.import_module("sensor_msgs.msg").Imu
    publisher = diagnostics.DiagnosedPublisher(
        node.Publisher("imu", imu, queue_size=1),
        made,
        diagnostics.FrequencyStatusParam({"min": 1e-6, "max": 1e9}),
        diagnostics.TimeStampStatusParam(),
    )
    message = imu()
    message.header.stamp = node.Time.now()
    publisher.publish(message)
    made.force_update()
    name = "probe: /imu topic status"
    until(lambda: name in found and found[name].message.startswith("Desired"))
    assert found[name].level == diagnostics.OK
