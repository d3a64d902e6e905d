"""Grasps and place locations, in the words of moveit_msgs/Grasp and PlaceLocation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from gazelle.argument_checks import checked
from gazelle.description import Pose, Vector3
from gazelle.errors import PlanningError


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class GripperTranslation:
    """A straight motion of the hand.

    Attributes:
        direction: Of any length but zero.
        desired: Length without obstacles [m].
        minimum: Smallest distance [m].
        frame: Link of the direction's axes, as it is turned at the start; those of
            the robot's frame if empty.
    """

    direction: Vector3
    desired: float = 0.1
    minimum: float = 0.05
    frame: str = ""

    def __post_init__(self) -> None:
        """Check length and direction.

        Raises:
            PlanningError: A length is not finite, or the direction is zero.
        """
        numbers = (*self.direction, self.desired, self.minimum)
        if not all(map(math.isfinite, numbers)) or min(self.desired, self.minimum) < 0.0:
            raise PlanningError(
                "distances of a gripper translation must be finite and not negative"
            )
        if math.hypot(*self.direction) == 0.0:
            raise PlanningError("the direction of a gripper translation is zero")

    @property
    def unit(self) -> Vector3:
        """The direction with the length one."""
        length = math.hypot(*self.direction)
        x, y, z = self.direction
        return (x / length, y / length, z / length)


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class Grasp:
    """A grasp of an object.

    Attributes:
        pose: Pose of the link when the gripper closes, in the robot's frame.
        approach: Approach.
        retreat: Retreat.
        open: Positions of the gripper's joints before the grasp [m or rad]; as they are if empty.
        closed: Commanded positions that hold the object.
        effort: Largest one of the gripper [N or N m]; its controller's if zero.
        link: Link of the pose; the group's tip if empty.
        touches: Links and objects that the hand may touch beside the object.
        quality: Better ones are tried first.
        name: For people.
    """

    pose: Pose
    approach: GripperTranslation
    retreat: GripperTranslation
    open: Mapping[str, float] = field(default_factory=dict)
    closed: Mapping[str, float] = field(default_factory=dict)
    effort: float = 0.0
    link: str = ""
    touches: Sequence[str] = ()
    quality: float = 0.0
    name: str = ""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class PlaceLocation:
    """Place for putting down a held object.

    Attributes:
        pose: Of the object in the robot's frame.
        approach: Approach.
        retreat: Retreat of the hand.
        open: Positions of the gripper's joints that release.
        of_tip: Whether the pose is of the group's tip instead.
        touches: Links and objects that the hand may touch beside the object.
        quality: Better ones are tried first.
        name: For people.
    """

    pose: Pose
    approach: GripperTranslation = field(
        default_factory=lambda: GripperTranslation((0.0, 0.0, -1.0))
    )
    retreat: GripperTranslation = field(default_factory=lambda: GripperTranslation((0.0, 0.0, 1.0)))
    open: Mapping[str, float] = field(default_factory=dict)
    of_tip: bool = False
    touches: Sequence[str] = ()
    quality: float = 0.0
    name: str = ""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class ParallelHand:
    """Two fingers that close along the y axis of a link; its x axis points ahead.

    Attributes:
        link: Between the tips of the fingers; fixed to the group's tip.
        open: Positions of the fingers' joints, opened.
        closed: Closed.
        width: Opening [m].
        depth: Reach of the fingers beyond the link [m]: the deepest grasp over an object.
        effort: Effort of the grip [N]; its controller's if zero.
    """

    link: str
    open: Mapping[str, float]
    closed: Mapping[str, float]
    width: float
    depth: float = 0.03
    effort: float = 0.0


@checked(PlanningError)
def box_grasps(
    hand: ParallelHand, pose: Pose, size: Vector3, *, approach: float = 0.1, lift: float = 0.1
) -> tuple[Grasp, ...]:
    """Return grasps of a box: from above and from its sides, with the fingers on two faces.

    Args:
        hand: Hand for the grasps.
        pose: Of the box in the robot's frame.
        size: Of the box [m].
        approach: Length of the straight approach [m].
        lift: Height of the lift [m], at least half of it.

    Returns:
        Best first: from above, then the more they point down. None where it is too wide.
    """
    half = math.pi / 2.0
    turns = [Pose(roll=roll) for roll in (0.0, half, math.pi, -half)]
    faces = [Pose(pitch=half), *(Pose(yaw=number * half) for number in range(4)), Pose(pitch=-half)]
    made = []
    for face in faces:
        for turn in turns:
            turned = Pose.from_quaternion((0, 0, 0), (face * turn).quaternion)
            ahead, across = _extent(turned, (1, 0, 0), size), _extent(turned, (0, 1, 0), size)
            if across >= hand.width:
                continue
            # The fingers' tips are no further than the middle of the box, or than they are long.
            back = max(0.0, ahead / 2.0 - hand.depth)
            at = pose * turned * Pose(-back)
            down = -at.rotate((1.0, 0.0, 0.0))[2]
            made.append(
                Grasp(
                    at,
                    GripperTranslation((1.0, 0.0, 0.0), approach, approach / 2.0, hand.link),
                    GripperTranslation((0.0, 0.0, 1.0), lift, lift / 2.0),
                    open=hand.open,
                    closed=hand.closed,
                    effort=hand.effort,
                    link=hand.link,
                    quality=down,
                )
            )
    return tuple(sorted(made, key=lambda each: -round(each.quality, 6)))


def _extent(turned: Pose, axis: Vector3, size: Vector3) -> float:
    """Return the extent of a box along an axis of a turned frame, all axes being along edges [m]."""
    along = turned.rotate(axis)
    return sum(abs(part) * length for part, length in zip(along, size, strict=True))
