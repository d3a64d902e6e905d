"""Calls of Gazebo's services that cannot be done, and what it answers."""

from graph_client import BALL

FRAME = (
    "SpawnModel: reference reference_frame not found, did you forget to scope the link by model "
    "name?"
)
NO_ENTITY = (
    "GetModelState: reference relative_entity_name not found, did you forget to scope the body "
    "by model name?"
)
UNSCOPED = "link not found, did you forget to scope the link by model name?"
NEITHER = (
    "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be "
    "converted to Gazebo compatible format."
)
TAKEN = "SpawnModel: Failure - entity already exists."
LAMP = '<sdf version="1.6"><light type="point" name="lamp"/></sdf>'
# Service, request, success, status message: nothing of this changes anything.
ODD = [
    ("spawn_sdf_model", {"model_name": "x", "model_xml": BALL, "reference_frame": "no"}, FRAME),
    ("spawn_sdf_model", {"model_name": "x", "model_xml": "", "reference_frame": "no"}, FRAME),
    ("spawn_sdf_model", {"model_name": "r1", "model_xml": "", "reference_frame": ""}, NEITHER),
    ("spawn_sdf_model", {"model_name": "r1", "model_xml": BALL, "reference_frame": "map"}, TAKEN),
    ("spawn_sdf_model", {"model_name": "r1", "model_xml": LAMP}, TAKEN),
    ("delete_model", {"model_name": ""}, "DeleteModel: model does not exist"),
    ("delete_model", {"model_name": "r1::base_link"}, "DeleteModel: model does not exist"),
    (
        "delete_light",
        {"light_name": "none"},
        'DeleteLight: Timeout reached while removing light "none"',
    ),
    ("get_model_properties", {"model_name": "no"}, "GetModelProperties: model does not exist"),
    ("get_model_state", {"model_name": "no"}, "GetModelState: model does not exist"),
    (
        "get_model_state",
        {"model_name": "no", "relative_entity_name": "no"},
        "GetModelState: model does not exist",
    ),
    (
        "get_model_state",
        {"model_name": "r1", "relative_entity_name": "no"},
        NO_ENTITY,
    ),
    ("get_joint_properties", {"joint_name": ""}, "GetJointProperties: joint not found"),
    ("get_joint_properties", {"joint_name": "r1"}, "GetJointProperties: joint not found"),
    ("get_link_properties", {"link_name": ""}, f"GetLinkProperties: {UNSCOPED}"),
    ("get_link_properties", {"link_name": "r1"}, f"GetLinkProperties: {UNSCOPED}"),
    ("get_link_properties", {"link_name": "r1::no"}, f"GetLinkProperties: {UNSCOPED}"),
    ("get_link_state", {"link_name": "no"}, f"GetLinkState: {UNSCOPED}"),
    (
        "get_link_state",
        {"link_name": "r1::base_footprint", "reference_frame": "no"},
        f"GetLinkState: {FRAME.partition(': ')[2]}",
    ),
    (
        "get_light_properties",
        {"light_name": "none"},
        "getLightProperties: Requested light none not found!",
    ),
    (
        "set_light_properties",
        {"light_name": "none"},
        "setLightProperties: Requested light none not found!",
    ),
    ("set_link_properties", {"link_name": "r1"}, f"SetLinkProperties: {UNSCOPED}"),
    (
        "set_model_configuration",
        {"model_name": "no"},
        "SetModelConfiguration: model does not exist",
    ),
    (
        "set_model_configuration",
        {"model_name": "no", "joint_names": ["a"]},
        "SetModelConfiguration: model does not exist",
    ),
    (
        "set_model_configuration",
        {"model_name": "r1", "joint_names": ["a"]},
        "SetModelConfiguration: joint name and position list have different lengths",
    ),
    ("set_joint_properties", {"joint_name": "no"}, "SetJointProperties: joint not found"),
    ("apply_body_wrench", {"body_name": "r1"}, "ApplyBodyWrench: body does not exist"),
    (
        "apply_body_wrench",
        {"body_name": "no", "reference_frame": "no"},
        "ApplyBodyWrench: body does not exist",
    ),
    (
        "apply_body_wrench",
        {"body_name": "r1::base_footprint", "reference_frame": "no"},
        "ApplyBodyWrench: reference_frame not found",
    ),
    ("apply_joint_effort", {"joint_name": "no"}, "ApplyJointEffort: joint not found"),
]


def kind_of(service):
    """Return the type of a service of Gazebo's, without its package."""
    if service.startswith("spawn"):
        return "SpawnModel"
    return "".join(part.title() for part in service.split("_"))
