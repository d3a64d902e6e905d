"""Poses obey the laws of the group of rigid motions, and agree with numpy."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.description.pose import quaternion_from_matrix
from gazelle.errors import FormatError

lengths = st.floats(-100, 100, allow_nan=False)
angles = st.floats(-math.pi, math.pi, allow_nan=False)
poses = st.builds(Pose, lengths, lengths, lengths, angles, angles, angles)


def rotation(roll, pitch, yaw):
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    rx = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    ry = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    rz = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return rz @ ry @ rx


@given(poses, poses, poses)
def test_composition_is_associative(a, b, c):
    assert ((a * b) * c).is_close(a * (b * c), position=1e-9, angle=1e-7)


@given(poses)
def test_inverse_undoes_from_both_sides(pose):
    assert (pose * pose.inverse()).is_close(Pose(), position=1e-9, angle=1e-7)
    assert (pose.inverse() * pose).is_close(Pose(), position=1e-9, angle=1e-7)


@given(poses, poses)
def test_composition_is_the_product_of_matrices(a, b):
    np.testing.assert_allclose((a * b).matrix(), a.matrix() @ b.matrix(), atol=1e-9)


@given(angles, angles, angles)
def test_angles_turn_about_fixed_axes_in_the_order_x_y_z(roll, pitch, yaw):
    matrix = Pose(0, 0, 0, roll, pitch, yaw).matrix()[:3, :3]
    np.testing.assert_allclose(matrix, rotation(roll, pitch, yaw), atol=1e-12)


@given(poses, lengths, lengths, lengths)
def test_apply_moves_a_point_as_the_matrix_does(pose, x, y, z):
    np.testing.assert_allclose(
        pose.apply((x, y, z)), (pose.matrix() @ [x, y, z, 1.0])[:3], atol=1e-9
    )


@given(poses)
def test_a_matrix_gives_back_its_pose(pose):
    assert Pose.from_matrix(pose.matrix()).is_close(pose, position=1e-12, angle=1e-7)


@given(poses)
def test_rpy_give_back_the_rotation(pose):
    again = Pose(*pose.position, *pose.rpy)
    # near pitch = pi/2 the angles are only known to the square root of the precision
    assert again.is_close(pose, position=1e-12, angle=1e-5)


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2])
@pytest.mark.parametrize(("roll", "yaw"), [(0.3, 0.0), (0.0, 0.4), (0.3, -0.4)])
def test_rpy_hold_where_pitch_is_a_right_angle(pitch, roll, yaw):
    pose = Pose(0, 0, 0, roll, pitch, yaw)
    assert pose.rpy[0] == 0.0
    assert Pose(0, 0, 0, *pose.rpy).is_close(pose, angle=1e-6)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_half_turns_survive_the_way_through_a_matrix(axis):
    rpy = [0.0, 0.0, 0.0]
    rpy[axis] = math.pi
    pose = Pose(0, 0, 0, *rpy)
    quaternion = quaternion_from_matrix(pose.matrix()[:3, :3])
    assert Pose.from_quaternion((0, 0, 0), quaternion).is_close(pose, angle=1e-9)


@given(poses, st.floats(0.1, 10))
def test_quaternions_are_normalised(pose, factor):
    scaled = [factor * q for q in pose.quaternion]
    assert Pose.from_quaternion(pose.position, scaled).is_close(pose, angle=1e-7)


def test_a_quaternion_of_length_zero_is_the_identity():
    assert Pose.from_quaternion((1, 2, 3), (0, 0, 0, 0)) == Pose(1, 2, 3)


@pytest.mark.parametrize("position", [(1.0, 2.0), (1.0, 2.0, 3.0, 0.5)])
def test_a_position_has_three_numbers(position):
    with pytest.raises(FormatError, match="three numbers and a quaternion of four"):
        Pose.from_quaternion(position, (0, 0, 0, 1))


@given(poses)
def test_poses_survive_pickling_and_hashing(pose):
    again = pickle.loads(pickle.dumps(pose))
    assert again.is_close(pose, position=0.0, angle=1e-7)
    assert hash(Pose(1, 2, 3)) == hash(Pose(1, 2, 3))


def test_is_close_sees_small_differences():
    assert not Pose().is_close(Pose(x=1e-6), position=1e-9)
    assert not Pose().is_close(Pose(yaw=1e-6), angle=1e-9)


def test_repr_shows_what_is_not_zero():
    assert repr(Pose(x=1.0, yaw=0.5)) == "Pose(x=1, yaw=0.5)"
