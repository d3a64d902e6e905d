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
    """Return the row of a known plugin that is not simulated; a warning names the missing parts."""
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
    _simulated("gazebo_ros_tricycle_drive", "one wheel with drive and steering; `angular.z` is its angle", "tricycle_drive:TricycleDrive"),
    _simulated("gazebo_ros_planar_move", "moves at the commanded velocity", "planar_move:PlanarMove"),
    _simulated("gazebo_ros_force_based_move ridgeback_ros_force_based_move", "accelerates to the commanded velocity by forces", "force_based_move:ForceBasedMove"),
    _simulated("gazebo_ros_kobuki", "the Kobuki base", "kobuki:Kobuki"),
    _simulated("DiffDrivePlugin", "Gazebo's own two wheels; sizes from the model", "builtin_drives:BuiltinDiffDrive"),
    _simulated("SkidSteerDrivePlugin", "Gazebo's own four wheels; sizes from the model", "builtin_drives:BuiltinSkidSteer"),
    _simulated("plugin_drone", "SJTU's quadrotor: take-off, flight, landing", "drone:Drone"),
    _simulated("usv_gazebo_thrust_plugin", "propellers of a vessel", "usv_thrust:UsvThrust"),
    _simulated("gazelle_go_to_goal", "drives a model with a drive and a laser to goals", "gazelle.navigation.plugin:GoToGoal"),
    _simulated("gazelle_navigation", "drives a model with a drive and a laser to goals as move_base does", "gazelle.navigation.robot_navigation:RobotNavigation"),
)

_SENSORS = (
    _simulated("gazebo_ros_laser gazebo_ros_gpu_laser", "a lidar's scan", "laser:Laser"),
    _simulated("gazebo_ros_block_laser", "all rays as points", "laser_points:BlockLaser"),
    _simulated("gazebo_ros_velodyne_laser gazebo_ros_velodyne_gpu_laser", "rays with a return as points with rings", "laser_points:Velodyne"),
    _simulated("gazebo_ros_ray_sensor", "rays as any message (ROS 2's file)", "ray_sensor:RaySensor"),
    _simulated("gazebo_ros_range", "the shortest ray", "range_finder:RangeFinder"),
    _simulated("gazebo_ros_imu", "IMU of a body", "imu:ImuPlugin"),
    _simulated("gazebo_ros_imu_sensor", "an IMU sensor", "imu_sensor:ImuSensor"),
    _simulated("gazebo_ros_p3d", "the true pose of a body", "p3d:P3D"),
    _simulated("gazebo_ros_f3d", "the sum of all forces on a body", "resultant:ResultantForce"),
    _simulated("gazebo_ros_ft_sensor", "the wrench on a joint", "force_torque:ForceTorqueSensor"),
    _simulated("gazebo_ros_bumper", "contacts", "bumper:Bumper"),
    _simulated("gazebo_ros_joint_state_publisher", "joint states", "joint_state_publisher:JointStatePublisher"),
    _simulated("hector_gazebo_ros_imu", "Hector's IMU", "hector_imu:HectorImu"),
    _simulated("hector_gazebo_ros_gps", "Hector's GPS", "hector_position:HectorGps"),
    _simulated("hector_gazebo_ros_magnetic", "Hector's magnetometer", "hector_position:HectorMagnetic"),
    _simulated("hector_gazebo_ros_baro", "Hector's barometer: height, altitude and pressure", "hector_barometer:HectorBarometer"),
    _simulated("gazebo_ros_camera gazebo_ros_prosilica plugin_ros_cam", "images, JPEG too, and camera info", "camera:CameraPlugin"),
    _simulated("gazebo_ros_triggered_camera", "an image for each message on `image_trigger`", "camera:TriggeredCameraPlugin"),
    _simulated("gazebo_ros_multicamera", "synchronised cameras", "camera:MultiCameraPlugin"),
    _simulated("gazebo_ros_triggered_multicamera", "the same, each for a message on its `image_trigger`", "camera:TriggeredMultiCameraPlugin"),
    _simulated("gazebo_ros_thermal_camera gazebo_ros_thermal_depth_camera", "Hector's thermal image: pure red is white, the rest dark",
               "camera:ThermalCameraPlugin"),
    _simulated("gazebo_ros_depth_camera", "images, depths and points", "depth_camera:DepthCameraPlugin"),
    _simulated("gazebo_ros_openni_kinect", "the same of a Kinect", "depth_camera:KinectPlugin"),
    _simulated("realsense_gazebo_plugin", "Intel's RealSense: colour, depth, infrared, points", "realsense:RealSense"),
    _simulated("hector_gazebo_ros_sonar", "Hector's sonar", "hector_sonar:HectorSonar"),
    _simulated("plugin_ros_imu plugin_ros_imu_native", "the IMU of SJTU's quadrotor", "drone_sensors:DroneImu"),
    _simulated("plugin_ros_sonar", "the sonar of SJTU's quadrotor", "drone_sensors:DroneSonar"),
)

_JOINTS = (
    _simulated("gazebo_ros_force", "pushes a body", "force:Force"),
    _simulated("gazebo_ros_hand_of_god", "pulls a weightless link to a frame of tf", "hand_of_god:HandOfGod"),
    _simulated("roboticsgroup_gazebo_mimic_joint_plugin roboticsgroup_upatras_gazebo_mimic_joint_plugin"
               " gazebo_mimic_joint_plugin mimic_joint_plugin", "a mimic joint; `hasPID`: by a motor", "mimic_joint:MimicJoint"),
    _simulated("roboticsgroup_gazebo_disable_link_plugin roboticsgroup_upatras_gazebo_disable_link_plugin",
               "a link without weight, at rest", "disable_link:DisableLink"),
    _simulated("gazebo_ros_joint_pose_trajectory", "sets joints to waypoints", "joint_path:JointPoseTrajectory"),
    _simulated("gazebo_ros_link_attacher", "attaches and detaches links (world)", "link_attacher:LinkAttacher"),
    _simulated("gazebo_ros_vacuum_gripper", "pulls bodies within 5 cm", "vacuum_gripper:VacuumGripper"),
    _simulated("gazebo_grasp_fix", "attaches grasped bodies", "grasp_fix:GraspFix"),
    _simulated("gazebo_ros_harness HarnessPlugin", "joints from the model to the world, with a winch, until detached", "harness:Harness"),
    _simulated("hector_servo_plugin", "one to three servos that turn to an orientation in a frame of `/tf` or of the model", "hector_servo:HectorServo"),
    _simulated("gazebo_ros_wheel_slip WheelSlipPlugin", "wheel slip by compliance · radius · spin · force / normal force", "wheel_slip:WheelSlip"),
    _simulated("gazebo_ros_elevator ElevatorPlugin", "a lift with a door", "elevator:Elevator"),
    _simulated("gazebo_ros_control", "joints under ros_control's controllers", "ros_control:RosControl"),
    _simulated("gazebo_ros_control_select_joints", "the same for the joints that `<joints>` names", "select_joints:SelectedRosControl"),
    _simulated("JointControlPlugin", "joints under PID, or driven", "joint_control:JointControl"),
)

_WORLDS = (
    _simulated("gazelle_scripted_motion", "waypoints of a model, script of an `<actor>`", "scripted_motion:ScriptedMotion"),
    _simulated("ActorPlugin", "an actor that walks to random targets, repelled by models within 4 m", "actor:ActorWalk"),
    _simulated("RandomVelocityPlugin", "random velocities, changed periodically", "velocities:RandomVelocity"),
    _simulated("InitialVelocityPlugin", "initial velocity", "velocities:InitialVelocity"),
    _simulated("ContainPlugin", "publishes when a model or link enters or leaves a box (world)", "boxes:Contain"),
    _simulated("SimEventsPlugin", "regions that trigger plugins, such as lifts, while occupied (world)", "regions:RegionEvents"),
    _simulated("TransporterPlugin", "moves models from one pad to another (world)", "boxes:Transporter"),
    _simulated("TouchPlugin", "publishes when contact sensors have touched only one model long enough", "touch:Touch"),
    _simulated("GravityCompensationPlugin", "gravity compensation of joints", "gravity_compensation:GravityCompensation"),
    _simulated("LiftDragPlugin", "wings and keels", "lift_drag:LiftDrag"),
    _simulated("BuoyancyPlugin", "buoyancy in water", "buoyancy:Buoyancy"),
    _simulated("usv_gazebo_dynamics_plugin", "a vessel with two hulls on still water", "usv_dynamics:UsvDynamics"),
    _simulated("LinearBatteryPlugin", "a battery that discharges", "battery:LinearBattery"),
    _simulated("LinearBatteryConsumerPlugin", "consumes power", "battery:BatteryConsumer"),
    _simulated("hector_gazebo_reset_plugin", "publishes resets", "hector_reset:HectorReset"),
    _simulated("WindPlugin", "steady wind of the engine", "wind:Wind"),
)

_NOT_SIMULATED = (
    _left_out("gazebo_ros_projector gazebo_ros_video", "images projected on models", "projected images are not shown; its topic is ignored"),
    _left_out("CessnaGUIPlugin HydraDemoPlugin HydraPlugin JoyPlugin KeysToCmdVelPlugin KeysToJointsPlugin PlaneDemoPlugin",
              "control by keys, joysticks and buttons", "keys, joysticks and buttons are not supported; command it by topics, or from Python"),
    _left_out("AttachLightPlugin FlashLightPlugin LedPlugin RosFlashLightPlugin", "lights that flash, or lights on links",
              "lights neither flash nor move with links"),
    _left_out("MudPlugin", "mud that holds links", "mud does not hold bodies"),
    _left_out("FiducialCameraPlugin MisalignmentPlugin PressurePlugin TriggerPlugin", "markers, alignment, pressure and triggers, published on Gazebo's own topics",
              "nothing is published on Gazebo's own topics"),
    _left_out("CessnaPlugin", "propellers and rudders of a demonstration", "its propellers and rudders are not driven"),
    _left_out("CartDemoPlugin JointTrajectoryPlugin LookAtDemoPlugin", "motions of demonstrations", "the motion of this plugin is not simulated"),
    _left_out("VariableGearboxPlugin", "a gearbox with a variable ratio", "the ratio does not change; the gearbox keeps that of its joint"),
    _left_out("RubblePlugin StaticMapPlugin", "random models, maps of the Earth", "its models are left out"),
    _left_out("ActuatorPlugin", "models of motors", "its motor models have no effect; joints have the limits of the file"),
    _left_out("RaySensorNoisePlugin", "noise of rays for a demonstration", "it adds no noise to the rays; give the sensor a <noise>"),
)

_NOTHING_TO_DO = (
    _needless("gazebo_ros_api_plugin gazebo_ros_paths_plugin gazebo_ros_init gazebo_ros_factory gazebo_ros_force_system",
              "services, topics and paths of Gazebo on a ROS graph", "every world on a graph has them"),
    _needless("gazebo_ros gazebo_ros_utils gazebo_ros_camera_utils vision_reconfigure gazebo_ros_template",
              "libraries and examples for other plugins", "they have no effect by themselves"),
    _needless("RayPlugin GpuRayPlugin CameraPlugin DepthCameraPlugin MultiCameraPlugin ContactPlugin", "base classes of sensor plugins",
              "sensors do not need them"),
    _needless("gz-sim-physics-system gz-sim-sensors-system gz-sim-imu-system gz-sim-contact-system gz-sim-user-commands-system gz-sim-scene-broadcaster-system"
              " ignition-gazebo-physics-system ignition-gazebo-sensors-system ignition-gazebo-imu-system ignition-gazebo-contact-system"
              " ignition-gazebo-user-commands-system ignition-gazebo-scene-broadcaster-system",
              "parts of newer Gazebo versions", "every simulation has physics, sensors and commands"),
    _needless("AmbientOcclusionVisualPlugin BlinkVisualPlugin LensFlareSensorPlugin LightVisualPlugin LinkPlot3DPlugin ReflectancePlugin ShaderParamVisualPlugin",
              "visual effects in Gazebo's window", "no such window; no effect on the simulation"),
    _needless("KeyboardGUIPlugin TimerGUIPlugin RestUiPlugin RestWebPlugin", "parts of Gazebo's window, and of web courses", "no such window"),
)
# fmt: on

TABLE = (*_DRIVES, *_SENSORS, *_JOINTS, *_WORLDS, *_NOT_SIMULATED, *_NOTHING_TO_DO)
"""All rows."""
