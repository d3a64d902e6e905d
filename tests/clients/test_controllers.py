"""The client of a controller manager, against one that keeps ros_control's rules."""

from __future__ import annotations

import contextlib

import pytest

from gazelle.clients import ClientError, Controllers
from gazelle_ros import Master, Node, load_message, load_service

MANAGER = "/r1/controller_manager"
KNOWN = {"left", "right"}


class ControllerManager:
    """Loads what it knows, unloads what does not run, and switches all or nothing."""

    def __init__(self, node):
        self.states = {}
        for name, kind, act in (
            ("list_controllers", "ListControllers", self.list),
            ("load_controller", "LoadController", self.load),
            ("unload_controller", "UnloadController", self.unload),
            ("switch_controller", "SwitchController", self.switch),
        ):
            node.serve(f"{MANAGER}/{name}", load_service(f"controller_manager_msgs/{kind}"), act)

    def list(self, _request):
        made = load_message("controller_manager_msgs/ControllerState")
        return {"controller": [made(name=k, state=v) for k, v in self.states.items()]}

    def load(self, request):
        good = request.name in KNOWN and request.name not in self.states
        if good:
            self.states[request.name] = "initialized"
        return {"ok": good}

    def unload(self, request):
        good = self.states.get(request.name, "running") != "running"
        if good:
            del self.states[request.name]
        return {"ok": good}

    def switch(self, request):
        assert request.strictness == 2
        good = {*request.start_controllers, *request.stop_controllers} <= self.states.keys()
        if good:
            self.states |= dict.fromkeys(request.stop_controllers, "stopped")
            self.states |= dict.fromkeys(request.start_controllers, "running")
        return {"ok": good}


@pytest.fixture
def controllers():
    with (
        Master(port=0, rosout=False) as master,
        Node("robot", master_uri=master.uri) as robot,
        Node("client", master_uri=master.uri) as client,
    ):
        ControllerManager(robot)
        with contextlib.closing(Controllers(client, "/r1", timeout=60.0)) as made:
            yield made


def test_controllers_are_loaded_started_stopped_and_unloaded(controllers):
    controllers.load(["left"])
    assert controllers.states() == {"left": "initialized"}
    controllers.spawn(["right"])
    assert controllers.states() == {"left": "initialized", "right": "running"}
    controllers.switch(start=["left"], stop=["right"])
    assert controllers.states() == {"left": "running", "right": "stopped"}
    controllers.reset(["left"])
    controllers.unload(["right"])
    assert controllers.states() == {"left": "running"}


def test_what_the_manager_refuses_is_an_error_with_the_service_and_the_name(controllers):
    with pytest.raises(ClientError, match=r"/r1/controller_manager/load_controller .*'middle'"):
        controllers.load(["middle"])
    controllers.spawn(["left"])
    with pytest.raises(ClientError, match=r"unload_controller .*'left'"):
        controllers.unload(["left"])
    with pytest.raises(ClientError, match=r"switch_controller .*'right'"):
        controllers.switch(start=["left", "right"])
    assert controllers.states() == {"left": "running"}
