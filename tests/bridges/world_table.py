"""Table of the worlds of gazebo_ros_pkgs: models, topics, and missing models."""

WORLDS = {
    "test/test_worlds/gazebo_ros_depth_camera.world": (
        "box_reflectance model_1 model_2",
        (
            "/depth_cam/camera_info /depth_cam/depth/camera_info /depth_cam/depth/image_raw "
            "/depth_cam/image_raw /depth_cam/image_raw/compressed /depth_cam/points"
        ),
        "",
    ),
    "test/bumper_test/gazebo_ros_bumper.world": (
        "model_1 gplane",
        "/test_bumper",
        "",
    ),
    "test/camera/camera.world": (
        "ground_plane model_1 camera_model",
        "/camera1/camera_info /camera1/image_raw /camera1/image_raw/compressed",
        "",
    ),
    "test/camera/camera16bit.world": (
        "ground_plane model_1 camera_model",
        "/camera1/camera_info /camera1/image_raw /camera1/image_raw/compressed",
        "",
    ),
    "test/camera/depth_camera.world": (
        "ground_plane model_1 camera_model",
        (
            "/camera1/camera_info /camera1/depth/camera_info /camera1/depth/image_raw "
            "/camera1/image_raw /camera1/image_raw/compressed /camera1/points"
        ),
        "",
    ),
    "test/camera/distortion_barrel.world": (
        "camera_distorted camera_undistorted",
        (
            "/camera_distorted/camera_info /camera_distorted/image_raw "
            "/camera_distorted/image_raw/compressed /camera_undistorted/camera_info "
            "/camera_undistorted/image_raw /camera_undistorted/image_raw/compressed"
        ),
        "",
    ),
    "test/camera/distortion_pincushion.world": (
        "camera_distorted camera_undistorted",
        (
            "/camera_distorted/camera_info /camera_distorted/image_raw "
            "/camera_distorted/image_raw/compressed /camera_undistorted/camera_info "
            "/camera_undistorted/image_raw /camera_undistorted/image_raw/compressed"
        ),
        "",
    ),
    "test/camera/multicamera.world": (
        "ground_plane model_1",
        (
            "/stereo/camera/left/camera_info /stereo/camera/left/image_raw "
            "/stereo/camera/left/image_raw/compressed /stereo/camera/right/camera_info "
            "/stereo/camera/right/image_raw /stereo/camera/right/image_raw/compressed"
        ),
        "",
    ),
    "test/camera/triggered_camera.world": (
        "ground_plane model_1 camera_model",
        "/camera1/camera_info /camera1/image_raw /camera1/image_raw/compressed",
        "",
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
        "/test/camera_info /test/image_raw /test/image_raw/compressed /test_block_laser",
        "libmove_model_test.so",
    ),
    "test/test_worlds/gazebo_ros_block_laser_clipping.world": (
        "test_block_laser slope",
        "/test_block_laser",
        "",
    ),
    "test/test_worlds/gazebo_ros_camera.world": (
        "model_1",
        "/camera_info /image_raw /image_raw/compressed",
        "",
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
        (
            "/test_block_laser /test_depth/camera_info /test_depth/depth/camera_info "
            "/test_depth/depth/image_raw /test_depth/image_raw /test_depth/image_raw/compressed "
            "/test_depth/points"
        ),
        "",
    ),
    "test/test_worlds/test_lasers.world": (
        "model_1 model_2 model_3 model_1a",
        "/base_scan /tilt_scan",
        "",
    ),
    "test/test_worlds/trisphere_cycle_wheel_slip.world": (
        "ground_plane trisphere_cycle_slip0 trisphere_cycle_slip1",
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
