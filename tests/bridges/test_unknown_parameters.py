"""Nodes of navigation warn of the parameters that their originals do not have, and of no others."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from gazelle.bridges.navigation import mapping_node
from gazelle.bridges.navigation.amcl import AmclNode
from gazelle.bridges.navigation.explore import ExploreNode
from gazelle.bridges.navigation.fake_localization import FakeLocalizationNode
from gazelle.bridges.navigation.gmapping import GmappingNode
from gazelle.bridges.navigation.hector import HectorNode
from gazelle.bridges.navigation.karto import KartoNode
from gazelle.bridges.navigation.map_server import MapService
from gazelle.description.occupancy import OccupancyMap
from gazelle_ros import Master, Node

OWN = {
    AmclNode: """
        bag_scan_period base_frame_id beam_skip_distance beam_skip_error_threshold
        beam_skip_error_threshold_ beam_skip_threshold do_beamskip first_map_only
        force_update_after_initialpose force_update_after_set_map global_frame_id gui_publish_rate
        initial_cov_aa initial_cov_xx initial_cov_yy initial_pose_a initial_pose_x initial_pose_y
        kld_err kld_z laser_lambda_short laser_likelihood_max_dist laser_max_beams laser_max_range
        laser_min_range laser_model_type laser_sigma_hit laser_z_hit laser_z_max laser_z_rand
        laser_z_short max_particles min_particles odom_alpha1 odom_alpha2 odom_alpha3 odom_alpha4
        odom_alpha5 odom_frame_id odom_model_type recovery_alpha_fast recovery_alpha_slow
        resample_interval restore_defaults save_pose_rate selective_resampling std_warn_level_x
        std_warn_level_y std_warn_level_yaw tf_broadcast transform_tolerance update_min_a update_min_d
        use_map_topic
    """,
    GmappingNode: """
        angularUpdate astep base_frame delta iterations kernelSize lasamplerange lasamplestep
        linearUpdate llsamplerange llsamplestep lsigma lskip lstep map_frame map_update_interval
        maxRange maxUrange minimumScore occ_thresh odom_frame ogain particles resampleThreshold sigma
        srr srt str stt temporalUpdate tf_delay throttle_scans transform_publish_period xmax xmin ymax
        ymin
    """,
    HectorNode: """
        advertise_map_service base_frame laser_max_dist laser_min_dist laser_z_max_value
        laser_z_min_value map_frame map_multi_res_levels map_pub_period map_resolution map_size
        map_start_x map_start_y map_update_angle_thresh map_update_distance_thresh
        map_with_known_poses odom_frame output_timing pose_update_topic pub_debug_output pub_drawings
        pub_map_odom_transform pub_map_scanmatch_transform pub_odometry scan_subscriber_queue_size
        scan_topic sys_msg_topic tf_map_scanmatch_transform_frame_name update_factor_free
        update_factor_occupied use_tf_pose_start_estimate use_tf_scan_transformation
    """,
    KartoNode: """
        angle_variance_penalty base_frame coarse_angle_resolution coarse_search_angle_offset
        correlation_search_space_dimension correlation_search_space_resolution
        correlation_search_space_smear_deviation delta distance_variance_penalty do_loop_closing
        fine_search_angle_offset link_match_minimum_response_fine link_scan_maximum_distance
        loop_match_maximum_variance_coarse loop_match_minimum_chain_size
        loop_match_minimum_response_coarse loop_match_minimum_response_fine
        loop_search_maximum_distance loop_search_space_dimension loop_search_space_resolution
        loop_search_space_smear_deviation map_frame map_update_interval minimum_angle_penalty
        minimum_distance_penalty minimum_time_interval minimum_travel_distance
        minimum_travel_heading odom_frame resolution scan_buffer_maximum_scan_distance
        scan_buffer_size throttle_scans transform_publish_period transform_tolerance
        use_response_expansion use_scan_barycenter use_scan_matching
    """,
    ExploreNode: """
        costmap_topic costmap_updates_topic gain_scale min_frontier_size orientation_scale
        planner_frequency potential_scale progress_timeout robot_base_frame transform_tolerance
        visualize
    """,
    FakeLocalizationNode: """
        base_frame_id delta_x delta_y delta_yaw global_frame_id odom_frame_id transform_tolerance
    """,
}
"""Parameters of the originals."""


@pytest.fixture
def node():
    with Master(port=0, rosout=False) as master, Node("/made", master_uri=master.uri) as made:
        yield made


@pytest.mark.parametrize("kind", OWN, ids=lambda each: each.__name__)
def test_parameters_of_the_original_are_known(kind, node, monkeypatch):
    found = []

    def note(where, values, known):
        assert where == "/made"
        found.extend(known)

    home = (
        mapping_node if issubclass(kind, mapping_node.MappingNode) else sys.modules[kind.__module__]
    )
    monkeypatch.setattr(home, "warn_of_unknown", note)
    kind(node)
    assert set(OWN[kind].split()) - set(found) == set()


@pytest.mark.parametrize("kind", OWN, ids=lambda each: each.__name__)
def test_an_unknown_parameter_is_warned_of(kind, node, caplog):
    node.set_param("~base_fram_id", "base")
    kind(node)
    assert "/made/base_fram_id is an unknown parameter" in caplog.text


def test_map_server_has_one_parameter(node, caplog):
    node.set_param("~frame_id", "floor")
    made = MapService(node, OccupancyMap(np.zeros((2, 3), np.int8), 0.1))
    assert made._message.header.frame_id == "floor"
    assert "unknown" not in caplog.text
    node.set_param("~frame", "floor")
    MapService(
        Node("/made", master_uri=node.master.uri), OccupancyMap(np.zeros((2, 3), np.int8), 0.1)
    )
    assert "/made/frame is an unknown parameter" in caplog.text
