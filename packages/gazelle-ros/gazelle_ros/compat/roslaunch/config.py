"""Configuration from launch files, with roslaunch's interface."""

from __future__ import annotations

from typing import Any

from gazelle_ros.base.errors import Error
from gazelle_ros.compat.roslaunch.core import Machine, Master, Node, Param, RLException, Test
from gazelle_ros.compat.roslaunch.plans import load_plan, node_of
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import LaunchPlan, ParameterCommand
from gazelle_ros.launch.programs import parameter_value


class ROSLaunchConfig:
    """Nodes, parameters and machines.

    Attributes:
        nodes: Result of `add_node`.
        params: Parameters by name.
    """

    def __init__(self) -> None:
        self.master = Master()
        self.nodes: list[Node] = []
        self.nodes_core: list[Node] = []
        self.tests: list[Test] = []
        self.roslaunch_files: list[str] = []
        self.resolved_node_names: list[str] = []
        self.machines: dict[str, Machine] = {"": Machine("", "localhost")}
        self.params: dict[str, Param] = {}
        self.clear_params: list[str] = []
        self.executables: list[Any] = []
        self.config_errors: list[str] = []

    def add_roslaunch_file(self, f: str) -> None:
        """Record that a file was read."""
        if f not in self.roslaunch_files:
            self.roslaunch_files.append(f)

    def add_config_error(self, msg: str) -> None:
        """Record an error."""
        self.config_errors.append(msg)

    def add_param(self, p: Param, filename: str | None = None, verbose: bool = True) -> None:  # noqa: FBT001, FBT002  # roslaunch's interface
        """Set a parameter."""
        del filename, verbose
        self.params[p.key] = p

    def add_clear_param(self, param: str) -> None:
        """Clear a namespace before parameters are set."""
        self.clear_params.append(param)

    def add_machine(self, m: Machine, verbose: bool = True) -> None:  # noqa: FBT001, FBT002  # roslaunch's interface
        """Add a machine."""
        del verbose
        self.machines[m.name] = m

    def add_test(self, test: Test, verbose: bool = True) -> None:  # noqa: FBT001, FBT002  # roslaunch's interface
        """Add a test."""
        del verbose
        self.tests.append(test)

    def add_node(self, node: Node, core: bool = False, verbose: bool = True) -> None:  # noqa: FBT001, FBT002  # roslaunch's interface
        """Add a node.

        Raises:
            RLException: There is another of its name.
        """
        del verbose
        if node.name:
            name = node.namespace + node.name
            if name in self.resolved_node_names:
                raise RLException(f"roslaunch file contains multiple nodes named [{name}].")
            self.resolved_node_names.append(name)
        (self.nodes_core if core else self.nodes).append(node)

    def assign_machines(self) -> None:
        """Assign every node to the machine it names, or this one."""
        for node in [*self.nodes, *self.tests]:
            node.machine = self.machines.get(node.machine_name or "", self.machines[""])

    def has_remote_nodes(self) -> bool:
        """Return False: nodes run on this machine."""
        return False

    def take(self, plan: LaunchPlan) -> None:
        """Add all of a plan; commands are run for the values of parameters.

        Raises:
            RLException: A command fails, or names clash.
        """
        packages = Packages()
        for file in plan.files:
            self.add_roslaunch_file(file)
        for machine in plan.machines.values():
            self.add_machine(Machine(machine.name, machine.address))
        self.clear_params += plan.clear
        for parameter in plan.parameters.values():
            value = parameter.value
            if isinstance(value, ParameterCommand):
                value = _or_rl_exception(lambda p=parameter: parameter_value(p, packages))
            self.add_param(Param(parameter.name, value))
        for node in plan.nodes:
            self.add_node(node_of(node))
        for test in plan.tests:
            made = node_of(test)
            if isinstance(made, Test):
                self.add_test(made)


def _or_rl_exception(function: Any) -> Any:
    """Call a function; convert its errors to those of roslaunch."""
    try:
        return function()
    except Error as error:
        raise RLException(str(error)) from None


def load_config_default(
    roslaunch_files: list[Any],
    port: int | None,
    roslaunch_strs: list[str] | None = None,
    loader: Any = None,
    verbose: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
    assign_machines: bool = True,  # noqa: FBT001, FBT002
    ignore_unset_args: bool = False,  # noqa: FBT001, FBT002
) -> ROSLaunchConfig:
    """Load the configuration from launch files.

    Args:
        roslaunch_files: Paths, or pairs of a path and its arguments (``x:=1``).
        port: The master's, if it is not that of ROS_MASTER_URI.
        roslaunch_strs: Texts of launch files.
        loader: Accepted, and not needed.
        verbose: Accepted, and not needed.
        assign_machines: Give every node its machine.
        ignore_unset_args: Accepted, and not needed.

    Raises:
        RLException: A file is malformed.
    """
    del loader, verbose, ignore_unset_args
    made = ROSLaunchConfig()
    if port:
        from gazelle_ros import net

        made.master = Master(uri=net.uri_of(made.master.get_host(), port))
    made.take(_or_rl_exception(lambda: load_plan(list(roslaunch_files), roslaunch_strs)))
    if assign_machines:
        made.assign_machines()
    return made
