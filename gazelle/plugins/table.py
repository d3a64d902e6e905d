"""Every plugin library that Gazelle knows by its file name, without ``lib`` and ``.so``: one row each.

A plugin of Gazelle's own is found by its row here. Other packages add theirs by entry
points of the group ``gazelle.plugins``, scripts by ``gazelle.simulation.register``.
"""

from __future__ import annotations

from gazelle.simulation import KnownPlugin


def _simulated(files: str, what: str, code: str) -> KnownPlugin:
    """Return the row of a plugin that a class simulates: ``module:Class``, or one of another package."""
    full = code if code.startswith("gazelle.") else f"gazelle.plugins.{code}"
    return KnownPlugin(tuple(files.split()), what, code=full)


def _left_out(files: str, what: str, missing: str) -> KnownPlugin:
    """Return the row of a plugin that is known and not simulated; a warning names what is missing."""
    return KnownPlugin(tuple(files.split()), what, missing=missing)


def _needless(files: str, what: str, done_by: str) -> KnownPlugin:
    """Return the row of a plugin that has nothing to do here; no warning is given."""
    return KnownPlugin(tuple(files.split()), what, done_by=done_by)


# fmt: off
_DRIVES = (
    _simulated("gazebo_ros_diff_drive", "two driven wheels", "diff_drive:DiffDrive"),
    _simulated("gazebo_ros_skid_steer_drive", "four driven wheels", "skid_steer_drive:SkidSteerDrive"),
    _simulated("diffdrive_plugin_multi_wheel", "any number of wheels a side", "multi_wheel_drive:MultiWheelDrive"),
    _simulated("diffdrive_plugin_6w", "three wheels a side", "multi_wheel_drive:SixWheelDrive"),
    _simulated("gazebo_ros_tricycle_drive", "one wheel that drives and steers; `angular.z` is its angle", "tricycle_drive:TricycleDrive"),
    _simulated("gazebo_ros_planar_move", "slides at its commanded velocity", "planar_move:PlanarMove"),
    _simulated("gazebo_ros_force_based_move ridgeback_ros_force_based_move", "is pushed to its commanded velocity", "force_based_move:ForceBasedMove"),
    _simulated("gazebo_ros_kobuki", "the Kobuki base", "kobuki:Kobuki"),
    _simulated("DiffDrivePlugin", "Gazebo's own two wheels; sizes of the model", "builtin_drives:BuiltinDiffDrive"),
    _simulated("SkidSteerDrivePlugin", "Gazebo's own four wheels; sizes of the model", "builtin_drives:BuiltinSkidSteer"),
    _simulated("plugin_drone", "SJTU's quadrotor: takes off, flies as commanded, lands", "drone:Drone"),
    _simulated("usv_gazebo_thrust_plugin", "propellers of a vessel", "usv_thrust:UsvThrust"),
    _simulated("gazelle_go_to_goal", "drives a model with a drive and a laser to goals", "gazelle.navigation.plugin:GoToGoal"),
    _simulated("gazelle_navigation", "takes a model with a drive and a laser to goals as move_base does", "gazelle.navigation.robot_navigation:RobotNavigation"),
)

_SENSORS = (
    _simulated("gazebo_ros_laser gazebo_ros_gpu_laser", "a lidar's scan", "laser:Laser"),
    _simulated("gazebo_ros_block_laser", "all rays as points", "laser_points:BlockLaser"),
    _simulated("gazebo_ros_velodyne_laser gazebo_ros_velodyne_gpu_laser", "rays that meet something as points with rings", "laser_points:Velodyne"),
    _simulated("gazebo_ros_ray_sensor", "rays under any message (ROS 2's file)", "ray_sensor:RaySensor"),
    _simulated("gazebo_ros_range", "the shortest of its rays", "range_finder:RangeFinder"),
    _simulated("gazebo_ros_imu", "inertia of a body", "imu:ImuPlugin"),
    _simulated("gazebo_ros_imu_sensor", "an IMU sensor", "imu_sensor:ImuSensor"),
    _simulated("gazebo_ros_p3d", "the true pose of a body", "p3d:P3D"),
    _simulated("gazebo_ros_f3d", "the sum of all forces on a body", "resultant:ResultantForce"),
    _simulated("gazebo_ros_ft_sensor", "the wrench on a joint", "force_torque:ForceTorqueSensor"),
    _simulated("gazebo_ros_bumper", "what touches", "bumper:Bumper"),
    _simulated("gazebo_ros_joint_state_publisher", "joints as they are", "joint_state_publisher:JointStatePublisher"),
    _simulated("hector_gazebo_ros_imu", "Hector's IMU", "hector_imu:HectorImu"),
    _simulated("hector_gazebo_ros_gps", "Hector's GPS", "hector_position:HectorGps"),
    _simulated("hector_gazebo_ros_magnetic", "Hector's magnetometer", "hector_position:HectorMagnetic"),
    _simulated("hector_gazebo_ros_baro", "Hector's barometer: height, altitude and pressure", "hector_barometer:HectorBarometer"),
    _simulated("gazebo_ros_camera gazebo_ros_prosilica plugin_ros_cam", "pictures, JPEG too, and what the lens is", "camera:CameraPlugin"),
    _simulated("gazebo_ros_triggered_camera", "a picture for each message on `image_trigger`", "camera:TriggeredCameraPlugin"),
    _simulated("gazebo_ros_multicamera", "cameras that see at once", "camera:MultiCameraPlugin"),
    _simulated("gazebo_ros_triggered_multicamera", "the same, each for a message on its `image_trigger`", "camera:TriggeredMultiCameraPlugin"),
    _simulated("gazebo_ros_thermal_camera gazebo_ros_thermal_depth_camera", "Hector's picture of heat: pure red is white, all else dark",
               "camera:ThermalCameraPlugin"),
    _simulated("gazebo_ros_depth_camera", "pictures, depths and points", "depth_camera:DepthCameraPlugin"),
    _simulated("gazebo_ros_openni_kinect", "the same of a Kinect", "depth_camera:KinectPlugin"),
    _simulated("realsense_gazebo_plugin", "Intel's RealSense: colour, depth, infrared, points", "realsense:RealSense"),
    _simulated("hector_gazebo_ros_sonar", "Hector's sonar", "hector_sonar:HectorSonar"),
    _simulated("plugin_ros_imu plugin_ros_imu_native", "the IMU of SJTU's quadrotor", "drone_sensors:DroneImu"),
    _simulated("plugin_ros_sonar", "the sonar of SJTU's quadrotor", "drone_sensors:DroneSonar"),
)

_JOINTS = (
    _simulated("gazebo_ros_force", "pushes a body", "force:Force"),
    _simulated("gazebo_ros_hand_of_god", "draws a weightless link to a frame of tf", "hand_of_god:HandOfGod"),
    _simulated("roboticsgroup_gazebo_mimic_joint_plugin roboticsgroup_upatras_gazebo_mimic_joint_plugin"
               " gazebo_mimic_joint_plugin mimic_joint_plugin", "a joint that follows another; `hasPID`: by a motor", "mimic_joint:MimicJoint"),
    _simulated("roboticsgroup_gazebo_disable_link_plugin roboticsgroup_upatras_gazebo_disable_link_plugin",
               "a link without weight, at rest", "disable_link:DisableLink"),
    _simulated("gazebo_ros_joint_pose_trajectory", "puts joints at waypoints", "joint_path:JointPoseTrajectory"),
    _simulated("gazebo_ros_link_attacher", "joins and parts links (world)", "link_attacher:LinkAttacher"),
    _simulated("gazebo_ros_vacuum_gripper", "draws what is within 5 cm", "vacuum_gripper:VacuumGripper"),
    _simulated("gazebo_grasp_fix", "holds what is squeezed", "grasp_fix:GraspFix"),
    _simulated("gazebo_ros_harness HarnessPlugin", "hangs the model on joints to the world, with a winch, until it is let go", "harness:Harness"),
    _simulated("hector_servo_plugin", "one to three servos that turn to an orientation in a frame of `/tf` or of the model", "hector_servo:HectorServo"),
    _simulated("gazebo_ros_wheel_slip WheelSlipPlugin", "wheel slip by compliance · radius · spin · force / normal force", "wheel_slip:WheelSlip"),
    _simulated("gazebo_ros_elevator ElevatorPlugin", "a lift with a door", "elevator:Elevator"),
    _simulated("gazebo_ros_control", "joints under ros_control's controllers", "ros_control:RosControl"),
    _simulated("gazebo_ros_control_select_joints", "the same for the joints that `<joints>` names", "select_joints:SelectedRosControl"),
    _simulated("JointControlPlugin", "joints held by PID, or turned", "joint_control:JointControl"),
)

_WORLDS = (
    _simulated("gazelle_scripted_motion", "a model that follows waypoints, an `<actor>` its script", "scripted_motion:ScriptedMotion"),
    _simulated("ActorPlugin", "an actor that moves to random targets, pushed away by models less than 4 m off", "actor:ActorWalk"),
    _simulated("RandomVelocityPlugin", "a velocity drawn from time to time", "velocities:RandomVelocity"),
    _simulated("InitialVelocityPlugin", "a velocity to start with", "velocities:InitialVelocity"),
    _simulated("ContainPlugin", "publishes whether a model or link is in a box, when that changes (world)", "boxes:Contain"),
    _simulated("SimEventsPlugin", "regions that call plugins of models, such as lifts, while something is in them (world)", "regions:RegionEvents"),
    _simulated("TransporterPlugin", "puts what is on a pad to another one (world)", "boxes:Transporter"),
    _simulated("TouchPlugin", "publishes when contact sensors have touched one thing alone long enough", "touch:Touch"),
    _simulated("GravityCompensationPlugin", "gravity compensation of joints", "gravity_compensation:GravityCompensation"),
    _simulated("LiftDragPlugin", "wings and keels", "lift_drag:LiftDrag"),
    _simulated("BuoyancyPlugin", "bodies in water", "buoyancy:Buoyancy"),
    _simulated("usv_gazebo_dynamics_plugin", "a vessel with two hulls on still water", "usv_dynamics:UsvDynamics"),
    _simulated("LinearBatteryPlugin", "a battery that runs down", "battery:LinearBattery"),
    _simulated("LinearBatteryConsumerPlugin", "takes power", "battery:BatteryConsumer"),
    _simulated("hector_gazebo_reset_plugin", "publishes resets", "hector_reset:HectorReset"),
    _simulated("WindPlugin", "steady wind, blown by the engine", "wind:Wind"),
)

_NOT_SIMULATED = (
    _left_out("gazebo_ros_projector gazebo_ros_video", "pictures on models", "pictures on models are not shown; its topic is not listened to"),
    _left_out("CessnaGUIPlugin HydraDemoPlugin HydraPlugin JoyPlugin KeysToCmdVelPlugin KeysToJointsPlugin PlaneDemoPlugin",
              "what keys, joysticks and buttons drive", "there are no keys, joysticks or buttons; command it by topics, or from Python"),
    _left_out("AttachLightPlugin FlashLightPlugin LedPlugin RosFlashLightPlugin", "lights that flash, or lights on links",
              "lights neither flash nor move with links; they shine as the file says"),
    _left_out("MudPlugin", "mud that holds links", "mud does not hold what is in it"),
    _left_out("FiducialCameraPlugin MisalignmentPlugin PressurePlugin TriggerPlugin", "markers, alignment, pressure and triggers, published on Gazebo's own topics",
              "nothing is published on Gazebo's own topics"),
    _left_out("CessnaPlugin", "propellers and rudders of a demonstration", "its propellers and rudders are not driven"),
    _left_out("CartDemoPlugin JointTrajectoryPlugin LookAtDemoPlugin", "motions of demonstrations", "the motion that is written in this plugin is not made"),
    _left_out("VariableGearboxPlugin", "a gearbox with a variable ratio", "its ratio does not change; the gearbox keeps that of its joint"),
    _left_out("RubblePlugin StaticMapPlugin", "models strewn at random, maps of the Earth", "the models that it would put into the world are left out"),
    _left_out("ActuatorPlugin", "models of motors", "its models of motors limit nothing; joints have the limits of the file"),
    _left_out("RaySensorNoisePlugin", "noise of rays for a demonstration", "it adds no noise to the rays; give the sensor a <noise>"),
)

_NOTHING_TO_DO = (
    _needless("gazebo_ros_api_plugin gazebo_ros_paths_plugin gazebo_ros_init gazebo_ros_factory gazebo_ros_force_system",
              "services, topics and paths of Gazebo on a ROS graph", "they are there whenever a world is on a graph"),
    _needless("gazebo_ros gazebo_ros_utils gazebo_ros_camera_utils vision_reconfigure gazebo_ros_template",
              "libraries and examples for other plugins", "they do nothing by themselves"),
    _needless("RayPlugin GpuRayPlugin CameraPlugin DepthCameraPlugin MultiCameraPlugin ContactPlugin", "base classes that hand on what a sensor measures",
              "sensors measure without them"),
    _needless("gz-sim-physics-system gz-sim-sensors-system gz-sim-imu-system gz-sim-contact-system gz-sim-user-commands-system gz-sim-scene-broadcaster-system"
              " ignition-gazebo-physics-system ignition-gazebo-sensors-system ignition-gazebo-imu-system ignition-gazebo-contact-system"
              " ignition-gazebo-user-commands-system ignition-gazebo-scene-broadcaster-system",
              "parts of a newer Gazebo, which is put together from plugins", "physics, sensors and commands are part of every simulation"),
    _needless("AmbientOcclusionVisualPlugin BlinkVisualPlugin LensFlareSensorPlugin LightVisualPlugin LinkPlot3DPlugin ReflectancePlugin ShaderParamVisualPlugin",
              "how things look in Gazebo's window", "there is no such window, and nothing moves by it"),
    _needless("KeyboardGUIPlugin TimerGUIPlugin RestUiPlugin RestWebPlugin", "parts of Gazebo's window, and of courses on the web", "there is no such window"),
)
# fmt: on

TABLE = (*_DRIVES, *_SENSORS, *_JOINTS, *_WORLDS, *_NOT_SIMULATED, *_NOTHING_TO_DO)
"""All rows."""
