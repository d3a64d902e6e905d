"""Homogeneous transformation matrices, Euler angles and quaternions.

The functions and their arguments are those of ROS 1's ``tf.transformations``; the
formulas come from the literature named beside them. Matrices are 4x4 and act on column
vectors; quaternions are (x, y, z, w); angles are radians.
"""

from gazelle_ros.transformations.arcball import (
    Arcball,
    arcball_constrain_to_axis,
    arcball_map_to_sphere,
    arcball_nearest_axis,
)
from gazelle_ros.transformations.composition import (
    compose_matrix,
    concatenate_matrices,
    decompose_matrix,
    is_same_transform,
    orthogonalization_matrix,
    superimposition_matrix,
)
from gazelle_ros.transformations.euler import (
    euler_from_matrix,
    euler_from_quaternion,
    euler_matrix,
    quaternion_from_euler,
)
from gazelle_ros.transformations.matrices import (
    identity_matrix,
    inverse_matrix,
    reflection_from_matrix,
    reflection_matrix,
    rotation_from_matrix,
    rotation_matrix,
    scale_from_matrix,
    scale_matrix,
    translation_from_matrix,
    translation_matrix,
)
from gazelle_ros.transformations.projections import (
    clip_matrix,
    projection_from_matrix,
    projection_matrix,
    shear_from_matrix,
    shear_matrix,
)
from gazelle_ros.transformations.quaternions import (
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_matrix,
    quaternion_inverse,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
    random_quaternion,
    random_rotation_matrix,
)
from gazelle_ros.transformations.vectors import random_vector, unit_vector, vector_norm

__all__ = [
    "Arcball",
    "arcball_constrain_to_axis",
    "arcball_map_to_sphere",
    "arcball_nearest_axis",
    "clip_matrix",
    "compose_matrix",
    "concatenate_matrices",
    "decompose_matrix",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "orthogonalization_matrix",
    "projection_from_matrix",
    "projection_matrix",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_slerp",
    "random_quaternion",
    "random_rotation_matrix",
    "random_vector",
    "reflection_from_matrix",
    "reflection_matrix",
    "rotation_from_matrix",
    "rotation_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_from_matrix",
    "shear_matrix",
    "superimposition_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
]
