"""A published launch file with stageros, fake_localization and move_base, as it is.

Its world is of the days when stageros turned Stage's axes by 90 degrees, so the robot stands beside
the map, and no goal on it can be reached.
"""

from __future__ import annotations

import pytest
from launching import Launched
from ros.graph import until

from gazelle_ros import Master, load_message

PACKAGE = "ros-planning__navigation_tutorials/roomba_stage"


@pytest.mark.long
@pytest.mark.corpus
def test_the_true_pose_connects_the_map_with_odometry(corpus, tmp_path):
    file = corpus / PACKAGE / "move_base_lse_arena.launch"
    with (
        Master(port=0) as master,
        Launched(master.uri, corpus, tmp_path, str(file)) as launched,
    ):
        launched.wait_for([], {"/amcl_pose", "/particlecloud", "/cmd_vel"}, {"map>odom"})
        poses = []
        kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
        launched.node.subscribe("/amcl_pose", kind, poses.append)
        until(lambda: poses)
        place = poses[-1].pose.pose.position
        assert (poses[-1].header.frame_id, place.x, place.y) == ("map", -1.0, 1.0)
        kind = load_message("nav_msgs/OccupancyGrid")
        costs = []
        launched.node.subscribe("/move_base/local_costmap/costmap", kind, costs.append)
        until(lambda: costs)  # move_base knows where its robot is
