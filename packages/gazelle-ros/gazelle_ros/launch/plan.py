"""Plan of a launch: the content of launch files, before anything is executed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

from gazelle_ros import names
from gazelle_ros.base.real_numbers import finite
from gazelle_ros.launch.errors import LaunchError


@dataclass(frozen=True, slots=True)
class SourceLocation:
    """Position in a launch file."""

    file: str
    line: int
    element: str


@dataclass(frozen=True, slots=True)
class ParameterCommand:
    """A parameter's value that a program will write to its standard output."""

    text: str
    kind: str
    """Format of the output: ``auto``, ``str``, ``int``, ``double``, ``bool`` or ``yaml``."""


@dataclass(frozen=True, slots=True)
class LaunchParameter:
    """A parameter to set; bytes stand for binary data."""

    name: str
    value: Any
    place: SourceLocation
    file: str | None = None
    """Text file that holds the value."""


@dataclass(frozen=True, slots=True)
class Action:
    """Request of ``<rosparam command="dump">`` or ``"delete"``, run before parameters are set."""

    command: Literal["dump", "delete"]
    name: str
    """Name of the parameter or namespace."""
    file: str | None
    place: SourceLocation


@dataclass(frozen=True, slots=True)
class LaunchMachine:
    """A machine that nodes can run on."""

    name: str
    address: str
    place: SourceLocation
    assignable: bool = True
    """False for ``default="never"``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NodePlan:
    """A node to start."""

    package: str
    type: str
    name: str
    """Its name without the namespace."""
    namespace: str
    """With slashes at both ends."""
    place: SourceLocation
    arguments: str = ""
    """Arguments of the program on its command line, to be split as a shell does."""
    machine: str = ""
    respawn: bool = False
    respawn_delay: float = 0.0
    """Seconds between its end and its next start."""
    required: bool = False
    output: Literal["log", "screen"] = "log"
    cwd: Literal["ROS_HOME", "ros-root", "node"] | None = None
    launch_prefix: str = ""
    environment: tuple[tuple[str, str], ...] = ()
    remappings: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        for name in ("respawn_delay", "time_limit"):  # that of a test
            seconds = getattr(self, name, 0.0)
            if finite(seconds) is None:
                raise LaunchError(f"{name} must be a finite number, not {seconds!r:.60}")

    @property
    def full_name(self) -> str:
        """The global name."""
        return names.canonical(self.namespace + self.name)


@dataclass(frozen=True, slots=True, kw_only=True)
class TestPlan(NodePlan):
    """A test node to run."""

    __test__ = False  # it is not a test of pytest's

    test_name: str
    time_limit: float = 60.0
    """Seconds it may take."""
    retry: int = 0


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument that the launch file declares."""

    name: str
    value: str | None
    """None if it has none and must be given."""
    default: str | None
    doc: str
    constant: bool


@dataclass(slots=True)
class LaunchPlan:
    """Content of launch files, in order."""

    files: list[str] = field(default_factory=list)
    """The launch files read, those included too."""
    arguments: dict[str, Argument] = field(default_factory=dict)
    """Arguments that the files themselves declare, not those that they include."""
    clear: list[str] = field(default_factory=list)
    """Namespaces to delete before parameters are set."""
    actions: list[Action] = field(default_factory=list)
    parameters: dict[str, LaunchParameter] = field(default_factory=dict)
    nodes: list[NodePlan] = field(default_factory=list)
    tests: list[TestPlan] = field(default_factory=list)
    machines: dict[str, LaunchMachine] = field(default_factory=dict)
    notices: list[str] = field(default_factory=list)
    """Notices of ignored or suspicious elements, one line each, with file and line."""
