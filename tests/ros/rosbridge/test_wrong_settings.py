"""Settings that cannot be are refused, and a server starts with all others."""

import wrong_calls
from wrong_values import shown

from gazelle_ros import Node
from gazelle_ros.rosbridge.server import BridgeServer
from gazelle_ros.rosbridge.settings import BridgeSettings


def test_wrong_settings(graph):
    findings = wrong_calls.Findings()

    def start(settings):
        BridgeServer(node, BridgeSettings(**{"port": 0} | settings)).close()

    with Node("wrong", master_uri=graph.uri) as node, wrong_calls.limits():
        for name, value, _, named in wrong_calls.calls(BridgeSettings, lambda *_: None):
            findings.attempt(f"{name}={shown(value)}", lambda s=named: start(s), value=value)
    assert not findings.foreign
    assert not findings.late
    assert not findings.accepted
    assert findings.refused > 70, findings.refused
    assert findings.count > 150, findings.count
