"""A robot as planning sees it: variables with limits, a tree of joints, links with poses."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.description import (
    EndEffector,
    Joint,
    Model,
    Pose,
    Semantics,
)
from gazelle.errors import PlanningError, did_you_mean
from gazelle.kinematics.group_joints import GroupJoints
from gazelle.kinematics.joint_group import JointModelGroup, ends_of
from gazelle.kinematics.joint_nodes import flat
from gazelle.kinematics.robot_tree import LinkFrame, RobotTree
from gazelle.kinematics.variables import JointBounds


@checked(PlanningError)
class RobotModel:
    """Kinematics and semantics of one robot.

    All states are arrays with a column for each variable: the position of each joint with one axis,
    depth first from the root, those that mimic others too (what is written there is not read). A
    planar virtual joint has three before them: ``JOINT/x``, ``JOINT/y`` and ``JOINT/theta``.

    Args:
        model: The robot.
        semantics: Semantics of an SRDF file; without one, groups can be made by ``chain``.
        limits: Limits by joint, which take the place of the description's, as a ``joint_limits.yaml``
            of MoveIt says them (``JointBounds.with_parameters``).

    Attributes:
        model: The robot.
        semantics: Of the SRDF.
        root: Name of its root link.
        frame: Name of the frame that poses are in: the root link's, or the parent frame of a planar
            virtual joint.
        variables: In the order of columns.
        links: By name; links that a description has made part of others are among them.
        bodies: Links of the description with their places in the tree, by name.
        joints: By name, from the root outwards, those that do not move too.
        closing: Joints that close loops, which no state has.
        nodes: The joints that the variables move, parents first, one for each variable.

    Raises:
        PlanningError: The robot is not a tree with one root.
    """

    def __init__(
        self,
        model: Model,
        semantics: Semantics | None = None,
        limits: Mapping[str, JointBounds] | None = None,
    ) -> None:
        self.model = model
        self.semantics = semantics or Semantics(model.name)
        tree = RobotTree(model, self.semantics.virtual_joints, limits or {})
        self.root, self.frame, self.bodies = tree.root, tree.frame, tree.bodies
        self.variables = tuple(tree.variables)
        self.links, self._parts = tree.links(), tree.parts()
        self.tree, self.nodes = tree.nodes.tree(), tree.nodes.nodes
        self.joints = {joint.name: joint for joint in tree.graph.outwards(tree.root)}
        self.closing = tree.closing
        self._graph, self._group_joints = tree.graph, GroupJoints(self.semantics, tree)
        self._sources = tree.nodes.sources()
        self._followers = [
            (column, *source) for column, source in enumerate(self._sources) if column != source[0]
        ]
        self._column = {variable.name: i for i, variable in enumerate(self.variables)}
        self._groups: dict[str, JointModelGroup] = {}

    # -- names ---------------------------------------------------------------------------

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables."""
        return tuple(variable.name for variable in self.variables)

    def column(self, name: str) -> int:
        """Return the column of a variable.

        Raises:
            PlanningError: There is none of that name.
        """
        if name not in self._column:
            raise PlanningError(
                f"the robot has no joint '{name}'", hint=did_you_mean(name, self._column)
            )
        return self._column[name]

    def columns(self, names: Iterable[str]) -> Indices:
        """Return the columns of some variables, shape (n,).

        Raises:
            PlanningError: There is none of a name.
        """
        return np.array([self.column(name) for name in names], np.intp)

    def link(self, name: str) -> LinkFrame:
        """Return a link.

        Raises:
            PlanningError: There is none of that name.
        """
        if name not in self.links:
            raise PlanningError(
                f"the robot has no link '{name}'", hint=did_you_mean(name, self.links)
            )
        return self.links[name]

    def group(self, name: str) -> JointModelGroup:
        """Return a group of the SRDF.

        Raises:
            PlanningError: There is none of that name.
            FormatError: It names what the robot does not have.
        """
        if name not in self._groups:
            known = [group.name for group in self.semantics.groups]
            if name not in known:
                raise PlanningError(f"there is no group '{name}'", hint=did_you_mean(name, known))
            self._groups[name] = self._group(name)
        return self._groups[name]

    def joints_of(self, group: str) -> tuple[Joint, ...]:
        """Return the joints of a group that can move, from the root outwards.

        Joints that mimic others and passive ones are among them.

        Raises:
            FormatError: The group, or a joint or link that it names, is not there.
        """
        names = set(self._group_joints.names(group))
        return tuple(
            joint for joint in self.joints.values() if joint.type != "fixed" and joint.name in names
        )

    def _group(self, name: str) -> JointModelGroup:
        """Build a group from the SRDF, and derive its links, tips and base."""
        joints = {joint.name for joint in self.joints_of(name)}
        said = self.semantics.parts_of(name)
        joints |= {joint for group in said for joint in group.joints}
        chains = [chain for group in said for chain in group.chains]
        links = [joint.child for joint in self.joints.values() if joint.name in joints]
        links += [link for group in said for link in group.links]
        links += [tip for _, tip in chains]
        ordered = [link for link in self.links if link in links]
        tips = tuple(tip for _, tip in chains) or ends_of(ordered, self._parents())
        base = chains[0][0] if len(chains) == 1 and len(said) == 1 else ""
        return self._made(name, joints, tuple(ordered), tips, base)

    def _parents(self) -> dict[str, str]:
        """Return the parent of each link."""
        return {joint.child: joint.parent for joint in self.joints.values()} | self._parts

    def chain(self, base: str, tip: str, name: str = "chain") -> JointModelGroup:
        """Return a group of the joints between two links, without an SRDF.

        Raises:
            PlanningError: A link is not there.
        """
        ends = self.link(base).body, self.link(tip).body
        joints = {each.name for each in self._graph.between(*ends) if each.name in self._column}
        links = [joint.child for joint in self.joints.values() if joint.name in joints]
        ordered = [link for link in self.links if link in (*links, tip)]
        return self._made(name, joints, tuple(ordered), (tip,), base)

    def group_of(self, joints: Iterable[str], name: str) -> JointModelGroup:
        """Return a planning group of some joints, without an SRDF.

        Raises:
            PlanningError: The robot has no joint of that name.
        """
        chosen = {self.variables[self.column(joint)].joint for joint in joints}
        links = [joint.child for joint in self.joints.values() if joint.name in chosen]
        ordered = tuple(link for link in self.links if link in links)
        return self._made(name, chosen, ordered, ends_of(ordered, self._parents()), "")

    def _made(
        self, name: str, joints: set[str], links: tuple[str, ...], tips: tuple[str, ...], base: str
    ) -> JointModelGroup:
        passive = self.semantics.passive_joints
        variables = tuple(
            each
            for each in self.variables
            if each.joint in joints and not each.mimics and each.joint not in passive
        )
        effectors = [
            each for each in self.semantics.end_effectors if self._carries(each, name, links)
        ]
        states = {
            state.name: {
                key: value
                for joint, values in state.joints.items()
                for key, value in zip(self._of_joint(joint), values, strict=False)
            }
            for state in self.semantics.states
            if state.group == name
        }
        return JointModelGroup(
            name,
            variables,
            self.columns(each.name for each in variables),
            np.array([each.bounds.lower for each in variables]),
            np.array([each.bounds.upper for each in variables]),
            links,
            tips,
            base,
            tuple(effectors),
            states,
        )

    def _of_joint(self, joint: str) -> list[str]:
        """Return variables of a joint."""
        return [each.name for each in self.variables if each.joint == joint]

    def _carries(self, effector: EndEffector, group: str, links: tuple[str, ...]) -> bool:
        """Return whether an end effector is mounted on a group."""
        if effector.parent_group:
            return effector.parent_group == group
        return effector.group != group and effector.parent_link in links

    def moving(self, columns: ArrayLike) -> frozenset[str]:
        """Return names of the links that move when some variables do."""
        chosen = {int(each) for each in np.asarray(columns).ravel()}
        moves: list[bool] = []
        for node, (source, _, _) in zip(self.nodes, self._sources, strict=True):
            moves.append(source in chosen or (node.parent >= 0 and moves[node.parent]))
        return frozenset(
            name for name, link in self.links.items() if link.joint >= 0 and moves[link.joint]
        )

    # -- kinematics ----------------------------------------------------------------------

    def zero(self) -> Floats:
        """Return a state with all variables at zero or their nearest limit, shape (variables,)."""
        lower, upper = self.limits()
        return np.clip(np.zeros(len(self.variables)), lower, upper)

    def limits(self) -> tuple[Floats, Floats]:
        """Return lower and upper limits of the variables [m or rad], shape (variables,) each."""
        lower = np.array([variable.bounds.lower for variable in self.variables])
        upper = np.array([variable.bounds.upper for variable in self.variables])
        return lower, upper

    def leader(self, column: int) -> tuple[int, float, float]:
        """Return a variable's source: a column, a factor and an offset; itself, 1 and 0 without one."""
        if not 0 <= column < len(self._sources):
            raise PlanningError(f"there are columns 0 to {len(self._sources) - 1}, not {column}")
        return self._sources[column]

    def complete(self, state: ArrayLike) -> Floats:
        """Fill in the columns of joints that mimic others.

        Args:
            state: Shape (..., variables).
        """
        return self.completion()(state)

    def completion(self) -> Callable[[ArrayLike], Floats]:
        """Return ``complete`` for many states in a row, which checks none of them."""
        followers = self._followers

        def complete(state: ArrayLike) -> Floats:
            made = np.array(state, np.float64)
            for column, source, factor, offset in followers:
                made[..., column] = factor * made[..., source] + offset
            return made

        return complete

    def forward(self, state: ArrayLike, links: str | Sequence[str]) -> Floats:
        """Return poses of links in the robot's frame.

        Args:
            state: Shape (variables,) or (n, variables).
            links: A name, or several.

        Returns:
            Homogeneous transforms, shape (4, 4); for several states with the axis n before, for
            several links with another one before the matrices': (n, k, 4, 4).

        Raises:
            PlanningError: A link is not there, or the state has another number of columns.
        """
        checked = self._checked(state)
        names = [links] if isinstance(links, str) else list(links)
        chosen = [self.link(name) for name in names]
        joints = np.array([link.joint for link in chosen], np.intp)
        offsets = np.array([flat(link.offset) for link in chosen]).reshape(-1, 12)
        poses: Floats = self.tree.forward(checked, joints, offsets)
        if isinstance(links, str):
            poses = poses[:, 0]
        return poses if np.ndim(state) > 1 else poses[0]

    def pose(self, state: ArrayLike, link: str) -> Pose:
        """Return the pose of a link in one state, in the robot's frame; see ``forward``."""
        return Pose.from_matrix(self.forward(state, link))

    def jacobian(self, state: ArrayLike, link: str, point: Sequence[float] = (0, 0, 0)) -> Floats:
        """Compute the Jacobian of a point of a link.

        Args:
            state: Shape (variables,) or (n, variables).
            link: Its name.
            point: In the link's frame [m].

        Returns:
            Rows: velocity of the point [m] and angular velocity [rad], along the axes of the
            robot's frame, for a unit speed: shape (6, variables) or (n, 6, variables).

        Raises:
            PlanningError: A link is not there, or the state has another number of columns.
        """
        given, found = self._checked(state), self.link(link)
        x, y, z = point
        offset = flat(found.offset * Pose(x, y, z))
        made: Floats = self.tree.jacobian(given, found.joint, np.array(offset))
        return made if np.ndim(state) > 1 else made[0]

    def _checked(self, state: ArrayLike) -> Floats:
        states = np.atleast_2d(np.asarray(state, np.float64))
        if states.ndim != 2 or states.shape[1] != len(self.variables):
            raise PlanningError(
                f"a state has {len(self.variables)} positions, not the shape {np.shape(state)}",
                hint="in the order of RobotModel.names",
            )
        return states

    def __repr__(self) -> str:
        return f"<RobotModel '{self.model.name}': {len(self.variables)} variables>"
