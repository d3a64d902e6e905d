"""Commands and states of controllers; each class names its ROS message.

Arrays that come out of a controller have a leading axis over worlds; what goes in is for the worlds that
it is sent to, so its arrays have none.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from numpy.typing import ArrayLike

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class JointTarget:
    """A command to one joint (std_msgs/Float64).

    Attributes:
        value: [m or rad, m/s or rad/s, N or N m]; a number, or one for each world sent to.
    """

    value: ArrayLike


@dataclass(frozen=True, slots=True)
class JointTargets:
    """A command to several joints, in the controller's order (std_msgs/Float64MultiArray).

    Attributes:
        values: Shape (joints,), or (n, joints) for each world sent to.
    """

    values: ArrayLike


@dataclass(frozen=True, slots=True)
class BaseTwist:
    """A command to a base (geometry_msgs/Twist).

    Attributes:
        linear: x, y, z [m/s], shape (3,), or (n, 3) for each world sent to.
        angular: About x, y, z [rad/s], likewise.
    """

    linear: ArrayLike = (0.0, 0.0, 0.0)
    angular: ArrayLike = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class StampedTwist:
    """Commanded velocity of a base after limits (geometry_msgs/TwistStamped).

    Attributes:
        stamp: Simulated time [ns].
        frame: Frame of the twist.
        linear: [m/s], shape (nworld, 3).
        angular: [rad/s], shape (nworld, 3).
    """

    stamp: int
    frame: str
    linear: Floats
    angular: Floats


@dataclass(frozen=True, slots=True)
class FourWheelCommand:
    """A command to a base that steers front and rear (four_wheel_steering_msgs/FourWheelSteering).

    Attributes:
        front_angle: [rad].
        rear_angle: [rad].
        speed: [m/s].
        stamp: Time of the command [ns]; 0 for now.
    """

    front_angle: float = 0.0
    rear_angle: float = 0.0
    speed: float = 0.0
    stamp: int = 0


@dataclass(frozen=True, slots=True)
class FourWheelOdometry:
    """Steering and speed of a base (four_wheel_steering_msgs/FourWheelSteeringStamped).

    Attributes:
        stamp: [ns].
        front_angle: [rad], shape (nworld,).
        rear_angle: [rad], shape (nworld,).
        speed: [m/s], shape (nworld,).
    """

    stamp: int
    front_angle: Floats
    rear_angle: Floats
    speed: Floats


@dataclass(frozen=True, slots=True)
class JointControlState:
    """A joint under PID control (control_msgs/JointControllerState); arrays have shape (nworld,).

    Attributes:
        stamp: [ns].
        set_point: Desired value.
        process_value: Actual value.
        process_value_dot: Its rate.
        error: Desired less actual value.
        time_step: Of the last update [s].
        command: Command.
        p: Gain.
        i: Gain.
        d: Gain.
        i_clamp: Upper bound of the integral term.
        antiwindup: Whether the integral itself is bounded.
    """

    stamp: int
    set_point: Floats
    process_value: Floats
    process_value_dot: Floats
    error: Floats
    time_step: float
    command: Floats
    p: float
    i: float
    d: float
    i_clamp: float
    antiwindup: bool


@dataclass(frozen=True, slots=True)
class PidStatus:
    """Inside of a PID (control_msgs/PidState); arrays have shape (nworld,).

    Attributes:
        stamp: [ns].
        time_step: [s].
        error: Error that it acts on.
        error_dot: Its rate.
        p_error: As ``error``.
        i_error: The integral.
        d_error: As ``error_dot``.
        p_term: Share of the output.
        i_term: Share of the output.
        d_term: Share of the output.
        i_max: Upper bound of the integral term.
        i_min: Lower bound.
        output: The sum.
    """

    stamp: int
    time_step: float
    error: Floats
    error_dot: Floats
    p_error: Floats
    i_error: Floats
    d_error: Floats
    p_term: Floats
    i_term: Floats
    d_term: Floats
    i_max: float
    i_min: float
    output: Floats


@dataclass(frozen=True, slots=True)
class TrajectoryPoint:
    """Desired joint positions at a time (trajectory_msgs/JointTrajectoryPoint).

    Attributes:
        time: Since the start of the trajectory [s].
        positions: [m or rad], one a joint.
        velocities: Likewise, or none.
        accelerations: Likewise, or none.
        effort: Likewise, or none; not used.
    """

    time: float
    positions: tuple[float, ...] = ()
    velocities: tuple[float, ...] = ()
    accelerations: tuple[float, ...] = ()
    effort: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class JointTrajectory:
    """Desired joint positions over time (trajectory_msgs/JointTrajectory).

    Attributes:
        names: Of the joints; None for the controller's, in its order.
        points: In the order of their times; none to hold still.
        stamp: Start [ns]; 0 for now.
    """

    names: tuple[str, ...] | None = None
    points: tuple[TrajectoryPoint, ...] = ()
    stamp: int = 0


@dataclass(frozen=True, slots=True)
class JointTolerance:
    """Tolerance of a joint (control_msgs/JointTolerance).

    Each value: 0 for the controller's own, negative for no bound.
    """

    name: str
    position: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0


@dataclass(frozen=True, slots=True)
class TrajectoryGoal:
    """Goal of control_msgs/FollowJointTrajectory.

    Attributes:
        trajectory: To follow.
        path_tolerance: On the way.
        goal_tolerance: At the end.
        goal_time_tolerance: Allowed delay [s]; 0 for the controller's own.
    """

    trajectory: JointTrajectory
    path_tolerance: tuple[JointTolerance, ...] = ()
    goal_tolerance: tuple[JointTolerance, ...] = ()
    goal_time_tolerance: float = 0.0


@dataclass(frozen=True, slots=True)
class TrajectoryResult:
    """Result of control_msgs/FollowJointTrajectory.

    Attributes:
        error_code: 0, or one of the codes below.
        error_string: For people.
    """

    error_code: int = 0
    error_string: str = ""


INVALID_GOAL = -1
INVALID_JOINTS = -2
OLD_HEADER_TIMESTAMP = -3
PATH_TOLERANCE_VIOLATED = -4
GOAL_TOLERANCE_VIOLATED = -5


@dataclass(frozen=True, slots=True)
class JointSample:
    """State of joints at a moment, in every world; shapes (nworld, joints), or None for unknown."""

    positions: Floats
    velocities: Floats
    accelerations: Floats | None = None


@dataclass(frozen=True, slots=True)
class TrajectoryState:
    """Tracking of a trajectory (control_msgs/JointTrajectoryControllerState and its feedback).

    Attributes:
        stamp: [ns].
        names: Of the joints.
        desired: State by the trajectory.
        actual: Actual state.
        error: The difference.
        time_from_start: Of the first joint's trajectory [s], shape (nworld,).
    """

    stamp: int
    names: tuple[str, ...]
    desired: JointSample
    actual: JointSample
    error: JointSample
    time_from_start: Floats


@dataclass(frozen=True, slots=True)
class TrajectoryQuery:
    """Request of control_msgs/QueryTrajectoryState: a time [ns]."""

    stamp: int


@dataclass(frozen=True, slots=True)
class TrajectoryAnswer:
    """Response of control_msgs/QueryTrajectoryState; its arrays have shape (nworld, joints)."""

    names: tuple[str, ...]
    sample: JointSample


@dataclass(frozen=True, slots=True)
class GripperGoal:
    """Goal of control_msgs/GripperCommand.

    Attributes:
        position: [m or rad].
        max_effort: [N or N m].
    """

    position: float
    max_effort: float = 0.0


@dataclass(frozen=True, slots=True)
class GripperResult:
    """Result and feedback of control_msgs/GripperCommand.

    Attributes:
        position: [m or rad].
        effort: [N or N m].
        stalled: Whether it does not move although it is not there.
        reached_goal: Whether it is there.
    """

    position: float = field(default=0.0)
    effort: float = 0.0
    stalled: bool = False
    reached_goal: bool = False


@dataclass(frozen=True, slots=True)
class ImuSample:
    """An IMU (sensor_msgs/Imu); shapes (nworld, 3), the quaternion (nworld, 4).

    Attributes:
        stamp: [ns].
        frame: Its frame.
        quaternion: (x, y, z, w).
        angular_velocity: [rad/s].
        linear_acceleration: [m/s²].
        orientation_covariance: 9 numbers, row by row.
        angular_velocity_covariance: 9 numbers.
        linear_acceleration_covariance: 9 numbers.
    """

    stamp: int
    frame: str
    quaternion: Floats
    angular_velocity: Floats
    linear_acceleration: Floats
    orientation_covariance: tuple[float, ...] = (0.0,) * 9
    angular_velocity_covariance: tuple[float, ...] = (0.0,) * 9
    linear_acceleration_covariance: tuple[float, ...] = (0.0,) * 9


@dataclass(frozen=True, slots=True)
class StampedWrench:
    """Force and torque in a frame (geometry_msgs/WrenchStamped); shapes (nworld, 3).

    Attributes:
        stamp: [ns].
        frame: Its frame.
        force: [N].
        torque: [N m].
    """

    stamp: int
    frame: str
    force: Floats
    torque: Floats
