"""A Stage world on a ROS 1 graph, as stage_ros puts Stage on it."""

from __future__ import annotations

import threading
import time

from gazelle.simulation import Simulation
from gazelle.simulation.clock import Schedule
from gazelle.stage import stage_of
from gazelle.stage.bridge.naming import Naming
from gazelle.stage.bridge.parameters import read_parameters
from gazelle.stage.bridge.place import GraphRobot
from gazelle.stage.bridge.poses import PoseServices
from gazelle.stage.bridge.robot import Messages, RobotInputs, RobotTopics, graph_state
from gazelle.stage.bridge.services import Services
from gazelle.stage.bridge.watchdog import Watchdog
from gazelle_ros import Node, Time
from gazelle_ros.base.closing import Closeable
from gazelle_ros.msgs import rosgraph_msgs, tf2_msgs
from gazelle_ros.rosout_log import report_on_rosout

_SLICE = 0.005  # wall time between two looks at a pause [s]
_LOOK = 0.05  # longest wait without a look at pause, pace and end [s]
_LATE = 0.1  # what is later than this is not caught up with in a burst [s]


class StageInterface(Closeable):
    """ROS interface of a Stage world; also a context manager.

    Topics, frames, parameters and services are those of stage_ros (wiki.ros.org/stage_ros);
    the docs list what is added. Everything is published after each step to subscribers,
    unless ``~publish_rate`` says less often.

    Args:
        simulation: Runs.
        node: Called ``stageros``; it stays open when the interface is closed.
        world: World of a batch that the graph uses.
        rate: Simulated seconds a wall second that ``run`` keeps to; None for as fast as
            possible.
        model_names: Name robots by their models (``stageros -u``).

    Attributes:
        rate: As above; settable while it runs.
        naming: Of topics and frames.
    """

    def __init__(
        self,
        simulation: Simulation,
        node: Node,
        *,
        world: int = 0,
        rate: float | None = 1.0,
        model_names: bool = False,
    ) -> None:
        self._simulation, self._node, self._world = simulation, node, world
        self.rate = rate
        self._stage = stage = stage_of(simulation)
        if stage.description.paused and simulation.time == 0.0:
            simulation.pause()
        self._stop = threading.Event()
        self._make_time()
        node.on_new_master.append(self._make_time)
        self._reports = report_on_rosout(node)
        settings = read_parameters(node)
        self._monotonic, self._offset_ns = settings.monotonic_clock, 0
        self.naming = Naming(
            [robot.name for robot in stage.robots],
            model_names=model_names,
            slashed_frames=settings.slashed_frames,
        )
        self._schedule = Schedule(settings.publish_rate)
        self._watchdog = Watchdog(stage, settings.base_watchdog_timeout, world)
        self._clock = node.advertise("/clock", rosgraph_msgs.msg.Clock, 10, on_connect=self._greet)
        self._tf = node.advertise("/tf", tf2_msgs.msg.TFMessage, 100)
        messages = Messages()
        robots = [GraphRobot(stage, robot, node, self.naming, world) for robot in stage.robots]
        metres = settings.is_depth_canonical
        self._topics = [RobotTopics(robot, messages, metres=metres) for robot in robots]
        self._inputs = [
            RobotInputs(
                robot,
                flat_poses=settings.flat_poses,
                commanded=self._watchdog.note_command,
                placed=self._show,
            )
            for robot in robots
        ]
        self._services = Services(simulation, node, self, world)
        self._poses = PoseServices(stage, node, self.naming, world, settings.pose_service)
        self._unsubscribe = simulation.subscribe(self._after_step)
        node.on_shutdown.append(lambda _reason: self.stop())

    # -- publishing ------------------------------------------------------------------------

    def _make_time(self) -> None:
        """Set nodes to simulated time."""
        self._node.set_param("/use_sim_time", True)

    def now(self) -> Time:
        """Return the simulated time as a time of the graph."""
        return Time(nsecs=self._simulation.clock.now_ns + self._offset_ns)

    def publish(self) -> None:
        """Publish the present values and the time, to all subscribers."""
        self._tick()
        facts = graph_state(self._stage, self._world, self.now())
        watched = [key for topics in self._topics for key in topics.cameras.watched()]
        if watched:
            self._stage.draw(watched)
        for topics in self._topics:
            topics.publish(facts)
        if self._tf.has_subscribers and self._topics:
            message = tf2_msgs.msg.TFMessage()
            for topics in self._topics:
                message.transforms += topics.transforms(facts)
            self._tf.publish(message)

    def _after_step(self) -> None:
        self._watchdog.check()
        now = self._simulation.clock.now_ns
        if self._schedule.rate <= 0.0 or self._schedule.is_due(now):
            self._schedule.done(now)
            self.publish()
        else:
            self._tick()

    def _tick(self) -> None:
        """Publish the time; zero means to ROS that there is none."""
        if self._clock.has_subscribers and (now := self.now()).to_nsec() > 0:
            message = rosgraph_msgs.msg.Clock()
            message.clock = now
            self._clock.publish(message)

    def _greet(self, _peer: str) -> None:
        """Send the time to a new subscriber, also while the world is paused."""
        self._simulation.lock.post(self._tick)

    def _show(self) -> None:
        """Publish a change of poses at once while no step follows."""
        if self._simulation.paused:
            self.publish()

    def rewind(self) -> None:
        """Start over; the graph's time goes back to zero unless ``~monotonic_clock``."""
        if self._monotonic:
            self._offset_ns += self._simulation.clock.now_ns
        self._simulation.reset()
        self._watchdog.forget()
        self._schedule.restart()

    # -- time ------------------------------------------------------------------------------

    @property
    def rate(self) -> float | None:
        """Real-time factor that ``run`` keeps to, as the physics properties have it."""
        return self._simulation.physics.target_rate

    @rate.setter
    def rate(self, rate: float | None) -> None:
        physics = self._simulation.physics
        physics.update_rate = (rate or 0.0) / physics.time_step

    def run(self, seconds: float | None = None) -> None:
        """Run the world until ``stop``, at ``rate``, or until its ``quit_time``.

        Args:
            seconds: Simulated time at which to end; None for the file's ``quit_time``.
        """
        end = self._stage.description.quit_time if seconds is None else seconds
        while not self._stop.is_set():
            if self._simulation.paused:
                self._stop.wait(_SLICE)
            elif not self._stretch(end):
                return

    def stop(self) -> None:
        """Stop ``run``; from any thread."""
        self._stop.set()

    def _stretch(self, end: float) -> bool:
        """Run at one pace until it changes, or there is a pause; False at the end."""
        simulation, rate = self._simulation, self.rate
        step, start, done = simulation.engine.time_step, time.monotonic(), 0
        while not (self._stop.is_set() or simulation.paused) and self.rate == rate:
            if end > 0.0 and simulation.time >= end - step / 2.0:
                return False
            self._step_on()
            if rate is None:
                continue
            done += 1
            ahead = start + done * step / rate - time.monotonic()
            if ahead < -_LATE:
                return True
            self._wait(start + done * step / rate)
        return True

    def _step_on(self) -> None:
        """Make one step unless there is a pause: once that is answered, none is made."""
        with self._simulation.lock:
            if not self._simulation.paused:
                self._simulation.step()

    def _wait(self, until: float) -> None:
        """Wait for a wall time, but not when there is a pause, another pace or the end."""
        rate = self.rate
        while (ahead := until - time.monotonic()) > 0.0 and self.rate == rate:
            if self._simulation.paused or self._stop.wait(min(ahead, _LOOK)):
                return

    def close(self) -> None:
        """Remove everything from the graph; the simulation continues."""
        self.stop()
        self._unsubscribe()
        self._services.close()
        self._poses.close()
        for inputs in self._inputs:
            inputs.close()
        for topics in self._topics:
            topics.close()
        self._clock.close()
        self._tf.close()
        if self._make_time in self._node.on_new_master:  # a second call finds it gone
            self._node.on_new_master.remove(self._make_time)
        if self._reports is not None:
            self._reports.close()
