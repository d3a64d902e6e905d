"""The names that masters and nodes tell others are names that others can use."""

from __future__ import annotations

import socket

import pytest

from gazelle_ros import Master, MasterProxy, Node, net


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "0:0:0:0:0:0:0:0"])  # on purpose
def test_all_addresses_are_told_as_one_that_can_be_used(host):
    usable = net.usable_host(host)
    assert usable not in {"0.0.0.0", "::"}
    try:
        with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET) as sock:
            sock.bind((usable, 0))
    except OSError:
        assert ":" in host, "there is no IPv6"


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "robot", "10.1.2.3", "::1"])
def test_other_names_stay(host):
    assert net.usable_host(host) == host


@pytest.mark.parametrize("host", ["", "a" * 70, "a..b", "\u2028", "\udc80"])
def test_what_is_no_name_is_a_host_that_is_not_there(host):
    with pytest.raises(OSError, match=r"name|known|address"):
        net.find_address(host)


def test_a_master_for_all_addresses_says_where_it_is(monkeypatch):
    with Master("0.0.0.0", 0, rosout=False) as master:  # on purpose
        assert "0.0.0.0" not in master.uri
        proxy = MasterProxy(master.uri, "/test")
        assert proxy.get_uri() == master.uri
        proxy.close()
        # It answers at loopback, too.
        local = MasterProxy(f"http://127.0.0.1:{master.port}/", "/test")
        assert local.get_pid()
        local.close()
        monkeypatch.setenv("ROS_IP", "0.0.0.0")
        with Node("n", master_uri=master.uri) as node:
            assert "0.0.0.0" not in node.uri


def test_without_a_network_it_is_loopback(monkeypatch):
    class Nowhere(socket.socket):
        def connect(self, address):
            raise OSError(101, "Network is unreachable")

    monkeypatch.setattr(net.socket, "socket", Nowhere)
    assert net.usable_host("0.0.0.0") == "127.0.0.1"  # on purpose
