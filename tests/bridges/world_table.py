"""What is in the worlds of gazebo_ros_pkgs: models, topics, and what has no model here."""

WORLDS = {
    "test/test_worlds/gazebo_ros_depth_camera.world": (
        "box_reflectance model_1 model_2",
        "",
        "model_1::link_1::sensor_camera",
    ),
    "test/bumper_test/gazebo_ros_bumper.world": (
        "model_1 gplane",
        "/test_bumper",
        "",
    ),
    "test/camera/camera.world": (
        "ground_plane model_1 camera_model",
        "",
        "camera_model::camera_link::camera1",
    ),
    "test/camera/camera16bit.world": (
        "ground_plane model_1 camera_model",
        "",
        "camera_model::camera_link::camera1",
    ),
    "test/camera/depth_camera.world": (
        "ground_plane model_1 camera_model",
        "",
        "camera_model::camera_link::camera1",
    ),
    "test/camera/distortion_barrel.world": (
        "camera_distorted camera_undistorted",
        "",
        "camera_distorted::camera_link::camera_distorted camera_undistorted::camera_link::camera_undistorted",
    ),
    "test/camera/distortion_pincushion.world": (
        "camera_distorted camera_undistorted",
        "",
        "camera_distorted::camera_link::camera_distorted camera_undistorted::camera_link::camera_undistorted",
    ),
    "test/camera/multicamera.world": (
        "ground_plane model_1",
        "",
        "model_1::link_1::stereo_camera",
    ),
    "test/camera/triggered_camera.world": (
        "ground_plane model_1 camera_model",
        "",
        "camera_model::camera_link::camera1",
    ),
    "test/p3d_test/worlds/3_double_pendulums.world": (
        "model_1 model_2 model_3",
        "/model_1/link_1/pose /model_1/link_2/pose /model_2/link_1/pose /model_2/link_2/pose /model_3/link_1/pose /model_3/link_2/pose",
        "",
    ),
    "test/p3d_test/worlds/3_single_pendulums.world": (
        "model_1 model_2 model_3",
        "/model_1/link_1/pose /model_2/link_1/pose /model_3/link_1/pose",
        "",
    ),
    "test/p3d_test/worlds/double_pendulum.world": (
        "model_1",
        "/model_1/link_1/pose /model_1/link_2/pose",
        "",
    ),
    "test/p3d_test/worlds/single_pendulum.world": (
        "model_1",
        "/model_1/link_1/pose",
        "",
    ),
    "test/set_model_state_test/set_model_state_test_p2dx.world": (
        "ground_plane pioneer2dx",
        "",
        "",
    ),
    "test/test_worlds/bumper_test.world": (
        "gplane simple_box reference_box",
        "/box1_bumper /box_bumper",
        "",
    ),
    "test/test_worlds/elevator.world": (
        "ground_plane elevator elevator_shaft floor0 floor1",
        "",
        "",
    ),
    "test/test_worlds/gazebo_ros_block_laser.world": (
        "model_1 camera_model finger_model object1 chair1_model",
        "/test_block_laser",
        "camera_model::link_1::sensor_camera libmove_model_test.so",
    ),
    "test/test_worlds/gazebo_ros_block_laser_clipping.world": (
        "test_block_laser slope",
        "/test_block_laser",
        "",
    ),
    "test/test_worlds/gazebo_ros_camera.world": (
        "model_1",
        "",
        "model_1::link_1::sensor_camera",
    ),
    "test/test_worlds/gazebo_ros_gpu_laser.world": (
        "model_1 model_2",
        "/laser_scan",
        "",
    ),
    "test/test_worlds/gazebo_ros_laser.world": (
        "model_1 model_2 model_3 model_1a",
        "/base_scan /tilt_scan",
        "",
    ),
    "test/test_worlds/gazebo_ros_range.world": (
        "model_1 model_2",
        "/sonar /sonar2",
        "",
    ),
    "test/test_worlds/gazebo_ros_trimesh_collision.world": (
        "model_1 camera_model chair1_model chair2_model chair3_model chair4_model chair5_model",
        "/test_block_laser",
        "camera_model::link_1::sensor_camera",
    ),
    "test/test_worlds/test_lasers.world": (
        "model_1 model_2 model_3 model_1a",
        "/base_scan /tilt_scan",
        "",
    ),
    "test/test_worlds/trisphere_cycle_wheel_slip.world": (
        "ground_plane",
        "",
        "",
    ),
    "test2/large_models/large_models.world": (
        "",
        "",
        "",
    ),
    "test2/lcp_tests/balance.world": (
        "plane1_model sphere2_1_model sphere2_2_model balance_board_model balance_hinge_model",
        "",
        "",
    ),
    "test2/lcp_tests/stack.world": (
        "plane1_model sphere_1_model sphere_2_model sphere_3_model",
        "",
        "",
    ),
    "test2/lcp_tests/stacks.world": (
        "plane1_model box_1_model box_2_model box_3_model sphere2_1_model sphere2_2_model sphere2_3_model sphere_1_model sphere_2_model sphere_3_model",
        "",
        "",
    ),
}
REFUSED = {
    "test2/worlds/empty.world": r"worlds of Gazebo before 1\.0 cannot be read",
}
