"""A controller manager of a few lines that keeps ros_control's rules, without a robot."""

from gazelle_ros import load_message, load_service

SERVICES = {
    "list_controllers": "ListControllers",
    "list_controller_types": "ListControllerTypes",
    "load_controller": "LoadController",
    "unload_controller": "UnloadController",
    "switch_controller": "SwitchController",
    "reload_controller_libraries": "ReloadControllerLibraries",
}
INTERFACE = "hardware_interface::EffortJointInterface"


class ManagerStandIn:
    """Loads what has a type among the parameters; controllers that share a joint conflict.

    Args:
        node: Serves.
        namespace: Of the services.
        joints: From the name of a controller to its joint; its own name by default.
    """

    def __init__(self, node, namespace="/controller_manager", joints=None):
        self.node = node
        self.space = namespace.removesuffix("controller_manager")
        self.states = {}
        self.joints = joints or {}
        self.calls = []
        acts = {
            "list_controllers": self.list,
            "list_controller_types": lambda _: (["kind/A", "kind/B"], ["base", "base"]),
            "load_controller": self.load,
            "unload_controller": self.unload,
            "switch_controller": self.switch,
            "reload_controller_libraries": self.reload,
        }
        self.servers = [
            node.serve(f"{namespace}/{name}", load_service(f"controller_manager_msgs/{kind}"), act)
            for (name, kind), act in zip(SERVICES.items(), acts.values(), strict=True)
        ]

    def list(self, _request):
        state = load_message("controller_manager_msgs/ControllerState")
        claim = load_message("controller_manager_msgs/HardwareInterfaceResources")
        return {
            "controller": [
                state(
                    name=name,
                    state=what,
                    type="kind/A",
                    claimed_resources=[claim(INTERFACE, [self.joints.get(name, name)])],
                )
                for name, what in self.states.items()
            ]
        }

    def load(self, request):
        known = self.node.get_param(f"{self.space}{request.name}/type", None) is not None
        good = known and request.name not in self.states
        if good:
            self.states[request.name] = "initialized"
        self.calls.append(("load", request.name, good))
        return {"ok": good}

    def unload(self, request):
        good = self.states.get(request.name, "running") != "running"
        if good:
            del self.states[request.name]
        self.calls.append(("unload", request.name, good))
        return {"ok": good}

    def switch(self, request):
        start, stop = request.start_controllers, request.stop_controllers
        if request.strictness == 1:
            start = [name for name in start if self.states.get(name, "running") != "running"]
            stop = [name for name in stop if self.states.get(name) == "running"]
        good = all(self.states.get(name, "running") != "running" for name in start)
        good &= all(self.states.get(name) == "running" for name in stop)
        running = {name for name, state in self.states.items() if state == "running"}
        after = [self.joints.get(name, name) for name in (running - set(stop)) | set(start)]
        good &= len(after) == len(set(after))
        if good:
            self.states |= dict.fromkeys(stop, "stopped") | dict.fromkeys(start, "running")
        self.calls.append(("switch", tuple(start), tuple(stop), request.strictness, good))
        return {"ok": good}

    def reload(self, request):
        good = request.force_kill or not self.states
        if good:
            self.states.clear()
        return {"ok": good}
