"""``MoveGroupCommandInterpreter``: commands in words, one a line, as of ``moveit_commander_cmdline.py``."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, KeysView
from pathlib import Path
from typing import ClassVar

from gazelle.drop_in.moveit_commander import conversions, group_commands
from gazelle.drop_in.moveit_commander.assignments import assignment
from gazelle.drop_in.moveit_commander.command_help import help_text, keywords
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.group_commands import (
    OK,
    Answer,
    MoveGroupInfoLevel,
    fail,
    good,
    info,
    listed,
    warn,
)
from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander
from gazelle.drop_in.moveit_commander.planning_scene_interface import (
    PlanningSceneInterface,
)
from gazelle.drop_in.moveit_commander.robot import RobotCommander
from gazelle.errors import Error, FormatError
from gazelle_ros.base.text_files import read_text
from gazelle_ros.base.writing import write_text
from gazelle_ros.msgs import moveit_msgs

__all__ = ["MoveGroupCommandInterpreter", "MoveGroupInfoLevel"]

LOG = logging.getLogger("rosout")

_ALIASES = {"which": "id", "groups": "use"}
_GROUND = (3.0, 3.0, 0.1)
_BELOW = -0.0501
"""Middle of the ground [m]: a tenth of a millimetre below the robot, which must not touch it."""


class MoveGroupCommandInterpreter:
    """Understands commands, and answers with a level (`MoveGroupInfoLevel`) and a text.

    Words of commands may be of capital letters; names are as they are.

    Raises:
        RuntimeError: There is no robot.
    """

    DEFAULT_FILENAME = "move_group.cfg"
    GO_DIRS: ClassVar[dict[str, tuple[int, int]]] = group_commands.GO_DIRS

    def __init__(self) -> None:
        self._groups: dict[str, MoveGroupCommander] = {}
        self._name = self._before = ""
        self._scene = PlanningSceneInterface()
        self._robot = RobotCommander()
        self._last_plan: moveit_msgs.msg.RobotTrajectory | None = None
        self._trace = False
        self._loading: set[Path] = set()

    def get_active_group(self) -> MoveGroupCommander | None:
        """Return the active group."""
        return self._groups.get(self._name)

    def get_loaded_groups(self) -> KeysView[str]:
        """Return names of groups that were used."""
        return self._groups.keys()

    # -- which command -------------------------------------------------------------------

    def execute(self, cmd: str) -> Answer:
        """Execute a line."""
        cmd = self.resolve_command_alias(cmd.strip())
        answer = self.execute_generic_command(cmd)
        if answer is not None:
            return answer
        group = self.get_active_group()
        if group is not None:
            return self.execute_group_command(group, cmd)
        missing = "No groups initialized yet. You must call the 'use' or the 'load' command first."
        return info(f"{self.get_help()}\n\n{missing}\n")

    def resolve_command_alias(self, cmdorig: str) -> str:
        """Return the command that an alias stands for."""
        return _ALIASES.get(cmdorig.lower(), cmdorig)

    def execute_generic_command(self, cmd: str) -> Answer | None:
        """Execute a command without a group, or a file; None if it needs a group.

        The name of a file in ``cmd`` loads that.
        """
        if cmd and "/" not in cmd and (Path("cmd") / cmd).is_file():
            cmd = f"load cmd/{cmd}"
        words = cmd.split()
        commands = {
            "use": self._use,
            "trace": self._set_trace,
            "load": self._load,
            "save": self._save,
        }
        act = commands.get(words[0].lower()) if words and "=" not in cmd else None
        return act(words[1:]) if act is not None else None

    def execute_group_command(self, g: MoveGroupCommander, cmdorig: str) -> Answer:
        """Execute a command of a group."""
        words = cmdorig.split()
        answer = assignment(g, cmdorig.strip())
        if answer is None and words:
            verb, rest = words[0].lower(), words[1:]
            answer = self._command(g, verb, rest)
            if answer is None and not rest and words[0] in g.get_remembered_joint_values():
                answer = group_commands.show(g, words[0])
        return answer or warn(f"Unknown command: '{cmdorig}'")

    def _command(self, g: MoveGroupCommander, verb: str, words: list[str]) -> Answer | None:
        if not words:
            return self._plain(g, verb)
        if verb == "go":
            return self._go(g, words)
        if len(words) == 1:
            return self._with_name(g, verb, words[0])
        if verb == "allow" and len(words) == 2:
            return group_commands.allow(g, words[0].lower(), words[1])
        if verb == "database" and len(words) == 2:
            return self._connect(g, *words)
        if verb == "rotate" and len(words) == 3:
            return group_commands.rotate(g, *words)
        return None

    def _plain(self, g: MoveGroupCommander, verb: str) -> Answer | None:
        """Execute a command of one word."""
        commands: dict[str, Callable[[], Answer]] = {
            "stop": lambda: group_commands.stop(g),
            "id": lambda: info(g.get_name()),
            "help": lambda: info(self.get_help()),
            "vars": lambda: info("[" + " ".join(g.get_remembered_joint_values()) + "]"),
            "joints": lambda: group_commands.joints(g),
            "show": lambda: self.command_show(g),
            "current": lambda: self.command_current(g),
            "group_state": lambda: self.command_group_state(g),
            "ground": self._ground,
            "eef": lambda: group_commands.end_effector(g),
            "database": lambda: info("Not connected to a database"),
            "plan": self._show_plan,
            "constrain": lambda: group_commands.clear_constraints(g),
            "tol": lambda: group_commands.tolerance(g),
            "tolerance": lambda: group_commands.tolerance(g),
            "time": lambda: info(str(g.get_planning_time())),
            "execute": lambda: self._execute_plan(g),
        }
        return commands[verb]() if verb in commands else None

    def _with_name(self, g: MoveGroupCommander, verb: str, name: str) -> Answer | None:
        """Execute a command of two words."""
        own: dict[str, Callable[[MoveGroupCommander, str], Answer]] = {
            "plan": self._plan,
            "pick": self._pick,
            "place": self._place,
            "constrain": self._constrain,
            "database": self._connect,
        }
        shared: dict[str, Callable[[MoveGroupCommander, str], Answer]] = {
            "planner": group_commands.set_planner,
            "record": group_commands.record, "rec": group_commands.record,
            "rand": group_commands.record_random, "random": group_commands.record_random,
            "del": group_commands.forget, "delete": group_commands.forget,
            "show": group_commands.show,
            "tol": group_commands.set_tolerance, "tolerance": group_commands.set_tolerance,
            "time": group_commands.set_time,
            "wait": group_commands.wait,
        }  # fmt: skip
        act = (own | shared).get(verb)
        return act(g, name) if act is not None else None

    # -- without a group -----------------------------------------------------------------

    def _use(self, words: list[str]) -> Answer | None:
        if not words:
            return info("\n".join(self.get_loaded_groups()))
        if len(words) > 1:
            return None
        name = self._before if words[0] == "previous" else words[0]
        if not name:
            return OK
        if name not in self._groups:
            try:
                self._groups[name] = MoveGroupCommander(name)
            except MoveItCommanderException as error:
                return fail(f"Initializing {name}: {error}")
            except (RuntimeError, Error) as error:
                return fail(f"Unable to initialize {name}: {error}")
        self._before, self._name = self._name, name
        return OK

    def _set_trace(self, words: list[str]) -> Answer | None:
        if not words:
            return info("trace is on" if self._trace else "trace is off")
        if words[0].lower() not in ("on", "off"):
            return None
        self._trace = words[0].lower() == "on"
        return OK

    def _load(self, words: list[str]) -> Answer:
        """Run a file of commands, in the folder or in ``cmd``; what fails is logged, the rest is done."""
        if len(words) > 1:
            return warn("Unable to parse load command")
        file = Path(words[0] if words else self.DEFAULT_FILENAME)
        if words and not file.is_file():
            file = Path("cmd") / file
        try:
            lines = read_text(file).splitlines()
        except (OSError, FormatError):
            return warn(f"Unable to load {file}")
        here = file.resolve()
        if here in self._loading:
            return warn(f"Unable to load {file}: it loads itself")
        self._loading.add(here)
        try:
            for number, line in enumerate(lines, 1):
                self._run_line(file, number, line.rstrip())
        finally:
            self._loading.remove(here)
        return OK

    def _run_line(self, file: Path, number: int, line: str) -> None:
        if self._trace:
            sys.stdout.write(f"{file}:{number}:  {line}\n")
        command = line.partition("#")[0].strip()
        level, text = self.execute(command) if command else OK
        if level <= MoveGroupInfoLevel.WARN:
            LOG.warning("%s:%d: %s: %s", file, number, command, text)

    def _save(self, words: list[str]) -> Answer:
        if len(words) > 1:
            return warn("Unable to parse save command")
        file = Path(words[0] if words else self.DEFAULT_FILENAME)
        lines = []
        for name, group in self._groups.items():
            lines.append(f"use {name}")
            known = group.get_remembered_joint_values()
            lines.extend(f"{key} = {listed(values)}" for key, values in known.items())
        try:
            write_text(file, "".join(f"{line}\n" for line in lines))
        except OSError as error:
            return warn(f"Unable to save {file}: {error.strerror}")
        return OK

    # -- with one ------------------------------------------------------------------------

    def command_show(self, g: MoveGroupCommander) -> Answer:
        """Return all remembered values."""
        return group_commands.remembered(g)

    def command_group_state(self, g: MoveGroupCommander) -> Answer:
        """Return the present joint values as SRDF."""
        return group_commands.group_state(g)

    def command_current(self, g: MoveGroupCommander) -> Answer:
        """Return the present joint values and the pose of the end effector."""
        return group_commands.current(g)

    def command_go_offset(
        self,
        g: MoveGroupCommander,
        offset: float,
        factor: float,
        dimension_index: int,
        direction_name: str,
    ) -> Answer:
        """Move the end effector along an axis [m]."""
        return group_commands.go_offset(g, offset, factor, dimension_index, direction_name)

    def _go(self, g: MoveGroupCommander, words: list[str]) -> Answer | None:
        self._last_plan = None
        if len(words) == 1:
            return group_commands.go(g, words[0])
        if len(words) == 2 and words[0].lower() in self.GO_DIRS:
            return group_commands.go_along(g, words[0].lower(), words[1])
        return group_commands.go_to_pose(g, words) if len(words) >= 6 else None

    def _plan(self, g: MoveGroupCommander, name: str) -> Answer:
        answer, self._last_plan = group_commands.plan(g, name)
        return answer

    def _pick(self, g: MoveGroupCommander, name: str) -> Answer:
        self._last_plan = None
        return group_commands.pick(g, name)

    def _place(self, g: MoveGroupCommander, name: str) -> Answer:
        self._last_plan = None
        return group_commands.place(g, name)

    def _show_plan(self) -> Answer:
        return info("No previous plan" if self._last_plan is None else str(self._last_plan))

    def _execute_plan(self, g: MoveGroupCommander) -> Answer:
        if self._last_plan is None:
            return warn("No motion plan computed")
        if g.execute(self._last_plan):
            return good("Plan submitted for execution")
        return warn("Failed to submit plan for execution")

    def _ground(self) -> Answer:
        root = self._robot.get_root_link()
        pose = conversions.list_to_pose_stamped([0.0, 0.0, _BELOW, 0.0, 0.0, 0.0], root)
        self._scene.attach_box(root, "ground", pose, _GROUND)
        return info("Added ground")

    def _connect(self, g: MoveGroupCommander, host: str, port: str = "33829") -> Answer:
        """Log that databases of constraints are not supported."""
        if port.isdecimal():
            g.set_constraints_database(host, int(port))
        return warn(f"Unable to connect to '{host}:{port}'")

    def _constrain(self, g: MoveGroupCommander, name: str) -> Answer:
        try:
            g.set_path_constraints(name)
        except MoveItCommanderException:
            return warn("Not connected to a database.")
        return good("OK")

    # -- for people ----------------------------------------------------------------------

    def get_help(self) -> str:
        """Return the list of commands."""
        return help_text()

    def get_keywords(self) -> dict[str, list[str]]:
        """Return first words of commands, and their completions."""
        return keywords(self._robot.get_group_names(), self.get_active_group())
