"""Table of robots that their own launch files drive to a goal, and the drive itself."""

from __future__ import annotations

import math
import re
from contextlib import ExitStack
from dataclasses import dataclass, field

from launch_table import HUSKY_INCLUDES
from launching import Launched
from ros.graph import until
from travelling import pose_message

from gazelle_ros import Master, Node, WallClock, load_message
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.clock_topic import follow_clock

PATIENCE = 240.0
"""For anything to happen [s of wall time]."""


@dataclass(frozen=True)
class Drive:
    """A robot's launch files, and a goal.

    Attributes:
        name: In the table of docs/reference/navigation.md.
        lines: Launch files and their arguments, the world first.
        truth: The model's name in Gazebo, or a topic with its true odometry.
        velocity: Topic of commands for a robot without move_base; "" sends the goal to move_base.
        ahead: The goal, as the robot sees it before the drive [m].
        environment: Variables that the launch files read.
        begin: Pose in the map that a user gives in RViz, x and y [m] and heading [rad].
        swapped: Whether the description swaps the wheels, so that the robot turns the other way.
    """

    name: str
    lines: tuple[str, ...]
    truth: str
    velocity: str = ""
    ahead: tuple[float, float] = (1.5, 0.3)
    environment: dict[str, str] = field(default_factory=dict)
    begin: tuple[float, float, float] | None = None
    swapped: bool = False


# Husky's and Jackal's descriptions include these whether they use them or not.
DESCRIPTIONS = {
    **HUSKY_INCLUDES,
    "pointgrey_camera_description": ("pointgrey_bumblebee2", "pointgrey_flea3"),
    "sick_tim": ("sick_tim",),
    "velodyne_description": ("HDL-32E", "VLP-16"),
}
_SIMULATOR = "{corpus}/turtlebot__turtlebot_simulator"
_TURTLEBOT = {
    "TURTLEBOT_3D_SENSOR": "kinect",
    "TURTLEBOT_GAZEBO_WORLD_FILE": f"{_SIMULATOR}/turtlebot_gazebo/worlds/playground.world",
    "TURTLEBOT_GAZEBO_MAP_FILE": f"{_SIMULATOR}/turtlebot_gazebo/maps/playground.yaml",
}
DRIVES = (
    Drive(
        "husky",
        ("husky_gazebo husky_playpen.launch", "husky_navigation move_base_mapless_demo.launch"),
        "husky",
        ahead=(1.5, -0.6),
        environment={"HUSKY_UST10_ENABLED": "1"},
    ),
    Drive(
        "jackal",
        (
            "jackal_gazebo jackal_world.launch",
            "jackal_navigation odom_navigation_demo.launch",
        ),
        "jackal",
        environment={"JACKAL_LASER": "1", "JACKAL_LASER_MODEL": "ust10"},
    ),
    Drive(
        "TurtleBot 2",
        ("turtlebot_gazebo turtlebot_world.launch", "turtlebot_gazebo amcl_demo.launch"),
        "mobile_base",
        environment=_TURTLEBOT,
    ),
    Drive("rosbot", ("rosbot_description rosbot.launch",), "rosbot", velocity="/cmd_vel"),
    Drive(
        "navigation_stage",
        ("navigation_stage move_base_fake_localization_10cm.launch",),
        "/base_pose_ground_truth",
        ahead=(-0.9, 0.0),  # within its room, whose doors are narrower than it
        # Its world is of the days when stageros turned Stage's axes by 90 degrees.
        begin=(12.14, 26.068, math.radians(-2.637)),
    ),
    Drive(
        "turtlebot3",
        (
            "turtlebot3_gazebo turtlebot3_world.launch",
            "turtlebot3_navigation turtlebot3_navigation.launch",
        ),
        "turtlebot3_burger",
        ahead=(0.6, 0.0),
        begin=(-2.0, -0.5, 0.0),
    ),
    Drive(
        "kobuki_desktop",
        ("kobuki_gazebo kobuki_playground.launch",),
        "mobile_base",
        velocity="/mobile_base/commands/velocity",
        ahead=(0.6, -0.3),
    ),
    Drive(
        "urdf_sim_tutorial",
        ("urdf_sim_tutorial 13-diffdrive.launch",),
        "robot",
        velocity="/r2d2_diff_drive_controller/cmd_vel",
    ),
    Drive(
        "gazebo_plugins",
        ("gazebo_plugins multi_robot_scenario.launch",),
        "r1",
        velocity="/r1/cmd_vel",
        ahead=(0.5, 1.2),  # the other robot stands a metre ahead
        swapped=True,  # as in Gazebo since ROS Melodic
    ),
    Drive(
        "turtlebot_stage",
        ("turtlebot_stage turtlebot_in_stage.launch",),
        "/base_pose_ground_truth",
        ahead=(0.4, 1.3),
        environment={
            "TURTLEBOT_STAGE_MAP_FILE": f"{_SIMULATOR}/turtlebot_stage/maps/maze.yaml",
            "TURTLEBOT_STAGE_WORLD_FILE": f"{_SIMULATOR}/turtlebot_stage/maps/stage/maze.world",
        },
    ),
    Drive(
        "ridgeback",
        (
            "ridgeback_gazebo ridgeback_world.launch",
            "ridgeback_navigation odom_navigation_demo.launch",
        ),
        "ridgeback",
        environment={"RIDGEBACK_FRONT_HOKUYO_LASER": "1"},
    ),
    Drive(
        "dingo",
        ("dingo_gazebo dingo_world.launch", "dingo_navigation odom_navigation_demo.launch"),
        "dingo",
        environment={"DINGO_LASER": "1", "DINGO_LASER_MODEL": "ust10"},
    ),
    *(
        Drive(
            f"teb_local_planner_tutorials, {name}",
            (f"teb_local_planner_tutorials robot_{name}_in_stage.launch",),
            "/base_pose_ground_truth",
            ahead=(0.4, 1.3),
        )
        for name in ("diff_drive", "carlike")
    ),
)


@dataclass(frozen=True)
class Outcome:
    """Result of a drive.

    Attributes:
        said: By move_base, or "" where the robot has none.
        reached: Whether the robot stands near its goal.
        off: True distance to the goal [m].
        seconds: Of simulated time.
        left_out: Why nodes are left out that are no windows for people.
        ended: Lines about nodes that ended with an error.
    """

    said: str
    reached: bool
    off: float
    seconds: float
    left_out: tuple[str, ...]
    ended: tuple[str, ...]


class Rider:
    """A client of a robot's graph that knows the robot's true pose."""

    def __init__(self, uri, truth, launched):
        self.node = Node("/rider", master_uri=uri, clock=WallClock())
        self.clock = follow_clock(self.node)
        self._truth, self.pose, self.height = truth, None, 0.0
        if truth.startswith("/"):
            self.node.subscribe(truth, load_message("nav_msgs/Odometry"), self._ride)
        else:
            kind = load_message("gazebo_msgs/ModelStates")
            self.node.subscribe("/gazebo/model_states", kind, self._pick)
        until(lambda: self.pose or launched.ended, PATIENCE)
        assert self.pose, launched.said

    def _ride(self, message):
        self._keep(message.pose.pose)

    def _pick(self, message):
        if self._truth in message.name:
            self._keep(message.pose[message.name.index(self._truth)])

    def _keep(self, pose):
        turn = pose.orientation
        yaw = math.atan2(2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y**2 + turn.z**2))
        self.pose, self.height = (pose.position.x, pose.position.y, yaw), pose.position.z

    def settle(self):
        """Wait until the robot neither falls nor rises out of the ground."""
        before = math.inf
        while abs(self.height - before) > 1e-3:
            before = self.height
            self.clock.sleep(1_000_000_000)

    def offset(self, goal):
        """Return a point as the robot sees it: ahead and to the left [m]."""
        x, y, yaw = self.pose
        away = complex(goal[0] - x, goal[1] - y) * complex(math.cos(yaw), -math.sin(yaw))
        return away.real, away.imag

    def point(self, ahead):
        """Return the point of the world that the robot sees ahead and to its left."""
        x, y, yaw = self.pose
        away = complex(*ahead) * complex(math.cos(yaw), math.sin(yaw))
        return x + away.real, y + away.imag

    def begin(self, pose):
        """Publish the robot's pose in the map until it is used."""
        kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
        given, located = self.node.advertise("/initialpose", kind), []
        self.node.subscribe("/amcl_pose", kind, located.append)

        def used():
            given.publish(pose_message(self.clock.now(), pose))
            self.clock.sleep(500_000_000)
            place = located and located[-1].pose.pose.position
            return place and math.dist((place.x, place.y), pose[:2]) < 0.3

        until(used, PATIENCE)
        # Transforms of the map are dated ahead: until then lookups lie between the old one and the new.
        self.clock.sleep(2_000_000_000)

    def send(self, goal):
        """Send a point to move_base; return its outcome."""
        action = load_message("move_base_msgs/MoveBaseAction")
        client = SimpleActionClient(self.node, "/move_base", action)
        assert client.wait_for_server(PATIENCE)
        message = load_message("move_base_msgs/MoveBaseGoal")()
        message.target_pose.header.frame_id = "base_link"
        message.target_pose.pose.orientation.w = 1.0
        place = message.target_pose.pose.position
        place.x, place.y = self.offset(goal)
        client.send_goal(message)
        assert client.wait_for_result(PATIENCE)
        return client.get_state() == GoalStatus.SUCCEEDED, client.get_goal_status_text()

    def steer(self, goal, topic, turn=1.0):
        """Drive to a point with commands of velocity; return whether the robot came near it.

        Rates of turning are multiplied by `turn`.
        """
        kind = load_message("geometry_msgs/Twist")
        commands = self.node.advertise(topic, kind)
        until(lambda: commands.has_subscribers, PATIENCE)
        begun = self.clock.now()
        while math.hypot(*self.offset(goal)) > 0.2 and self.clock.now() - begun < 60e9:
            ahead, left = self.offset(goal)
            command = kind()
            if ahead > 0.0:  # along the arc to the goal, slower where it is tight
                bend = 2.0 * left / (ahead**2 + left**2)
                command.linear.x = min(0.3, 1.0 / max(abs(bend), 1e-6))
                command.angular.z = bend * command.linear.x
            else:
                command.angular.z = math.copysign(0.8, left)
            command.angular.z *= turn
            commands.publish(command)
            self.clock.sleep(50_000_000)
        commands.publish(kind())
        return math.hypot(*self.offset(goal)) <= 0.2, ""


def ride(drive, corpus, paths, folder):
    """Run the launch files of a row, and drive to its goal."""
    environment = {key: value.format(corpus=corpus) for key, value in drive.environment.items()}
    with Master(port=0) as master, ExitStack() as running:
        launches = []
        for number, line in enumerate(drive.lines):
            place = folder / str(number)
            place.mkdir()
            launches.append(
                running.enter_context(
                    Launched(master.uri, paths, place, line, f"/watcher_{number}", environment)
                )
            )
            if number == 0:
                rider = Rider(master.uri, drive.truth, launches[0])
                running.callback(rider.node.close)
        rider.settle()
        if drive.begin:
            rider.begin(drive.begin)
        goal, begun = rider.point(drive.ahead), rider.clock.now()
        try:
            if drive.velocity:
                reached, said = rider.steer(goal, drive.velocity, -1.0 if drive.swapped else 1.0)
            else:
                reached, said = rider.send(goal)
        except AssertionError:
            raise AssertionError("".join(each.said for each in launches)) from None
        seconds = (rider.clock.now() - begun) / 1e9
        off, text = math.hypot(*rider.offset(goal)), "".join(each.said for each in launches)
    return Outcome(said, reached, off, seconds, _left_out(text), _ended(text))


def _left_out(text):
    """Return why nodes are left out that are no windows for people."""
    return tuple(re.findall("ERROR: a node is left out: (.*)", text))


def _ended(text):
    return tuple(
        line for line in text.splitlines() if "process has died" in line or "Traceback" in line
    )
