"""Small files that the tests of the formats build upon."""

from gazelle import formats


def sdf(body, version="1.7"):
    """Return SDF text with something in it."""
    return f"<?xml version='1.0'?>\n<sdf version='{version}'>\n{body}\n</sdf>"


def model(body, version="1.7", name="m"):
    """Return the model with some links, joints and so on."""
    text = sdf(f"<model name='{name}'>\n{body}\n</model>", version)
    return formats.load_model_string(text, name="test.sdf")


def world(body, version="1.7"):
    """Return the world with something in it."""
    text = sdf(f"<world name='w'>\n{body}\n</world>", version)
    return formats.load_string(text, name="test.sdf")


def link(model_, name):
    """Return a link by name."""
    return next(link for link in model_.links if link.name == name)


def joint(model_, name):
    """Return a joint by name."""
    return next(joint for joint in model_.joints if joint.name == name)


INERTIAL = (
    "<inertial><mass value='1'/>"
    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
)


def robot(body):
    """Return URDF text."""
    return f"<robot name='r'>\n{body}\n</robot>"


def urdf_link(name, body=INERTIAL):
    """Return a URDF link, by default with a mass."""
    return f"<link name='{name}'>{body}</link>"


def urdf_joint(name, parent, child, kind="fixed", body=""):
    """Return a URDF joint."""
    return (
        f"<joint name='{name}' type='{kind}'><parent link='{parent}'/>"
        f"<child link='{child}'/>{body}</joint>"
    )


def urdf(body):
    """Return the model of a URDF."""
    return formats.load_model_string(robot(body), name="test.urdf")
