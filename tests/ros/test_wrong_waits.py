"""Timeouts, rates and ports that cannot be end in one error, or end the wait."""

import math
import threading
import time

import pytest
from ros.graph import Text

from gazelle_ros import Master, Rate, SimulatedClock, WallClock
from gazelle_ros.actions.spec import wait
from gazelle_ros.base.deadlines import LONGEST_WAIT, deadline_after, wait_of
from gazelle_ros.base.errors import RosError
from gazelle_ros.errors import RosTimeoutError

ENDED = [math.nan, -math.inf, -1e308, -(10**400), -1.0, 0.0, 1e-320]
ENDLESS = [math.inf, 1e308, 10**400]


@pytest.mark.parametrize("seconds", ENDED)
def test_waits_that_are_over_at_once(make_node, seconds):
    node = make_node("waiter")
    assert wait_of(seconds) <= 1e-320
    assert not node.wait_closed(seconds)
    with pytest.raises(RosTimeoutError):
        node.wait_for_message("nothing", Text, seconds)
    with pytest.raises(RosTimeoutError):
        node.wait_for_service("nothing", seconds)


@pytest.mark.parametrize("seconds", ENDLESS)
def test_waits_for_longer_than_a_system_can(seconds):
    assert wait_of(seconds) == LONGEST_WAIT
    assert deadline_after(seconds) < LONGEST_WAIT + time.monotonic() + 1.0
    condition = threading.Condition()
    done = iter([False, True])
    assert wait(_Waiter(), condition, lambda: next(done), seconds)
    naps = iter([False, True])
    assert not WallClock().sleep(int(min(seconds, 1e30)) * 10**9, lambda: next(naps))


def test_a_timeout_that_is_no_number_is_an_error_of_actions():
    with pytest.raises(RosError, match="must be a number, not nan"):
        wait(_Waiter(), threading.Condition(), lambda: False, math.nan)


class _Waiter:
    clock, closed = WallClock(), False


@pytest.mark.parametrize("hertz", [0.0, -1.0, math.nan, -math.inf, 1e-320, 1e-10])
def test_rates_that_cannot_be(hertz):
    with pytest.raises(ValueError, match="a rate must be positive"):
        Rate(SimulatedClock(), hertz)


@pytest.mark.parametrize("port", [-1, 65536, 2**31, 10**30])
def test_ports_that_are_not_there(port):
    with pytest.raises(RosError, match="a port is from 0 to 65535"):
        Master(port=port)
