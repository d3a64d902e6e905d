"""Hints for modules that a ROS 1 machine has and this one may lack.

One table for what pip brings under the same or another name, one for what is not on PyPI.
"""

from __future__ import annotations

from gazelle_ros.base.program import program_name

PIP = {
    "Cryptodome": "pycryptodomex",
    "PIL": "pillow",
    "PySide2": "PySide2",
    "baselines": "'gazelle[train]', whose stable_baselines3 took its place",
    "bson": "pymongo",
    "catkin_pkg": "catkin_pkg",
    "cbor": "cbor",
    "cv2": "opencv-python-headless",
    "defusedxml": "defusedxml",
    "distro": "distro",
    "docutils": "docutils",
    "em": "empy==3.3.4",
    "evdev": "evdev-binary",
    "gnupg": "python-gnupg",
    "h5py": "h5py",
    "joblib": "joblib",
    "keras": "keras",
    "lxml": "lxml",
    "matplotlib": "'gazelle[plots]'",
    "mock": "mock",
    "netifaces": "netifaces2",
    "networkx": "networkx",
    "nose": "nose",
    "numba": "numba",
    "pandas": "pandas",
    "paramiko": "paramiko",
    "pkg_resources": "'setuptools<81'",
    "psutil": "psutil",
    "py_trees": "'py_trees<2'",
    "pyassimp": "pyassimp",
    "pydot": "pydot",
    "pygame": "pygame",
    "pygraphviz": "pygraphviz",
    "pymongo": "pymongo",
    "pynput": "pynput",
    "rosdep2": "rosdep",
    "rosdistro": "rosdistro",
    "scipy": "scipy",
    "serial": "pyserial",
    "skimage": "scikit-image",
    "sklearn": "scikit-learn",
    "stable_baselines": "'gazelle[train]', whose stable_baselines3 took its place",
    "stable_baselines3": "'gazelle[train]'",
    "sympy": "sympy",
    "tensorboard": "'gazelle[train]'",
    "tensorflow": "tensorflow",
    "torch": "'gazelle[train]'",
    "tornado": "tornado",
    "tqdm": "tqdm",
    "transforms3d": "transforms3d",
    "trimesh": "trimesh",
    "twisted": "twisted",
    "urdf_parser_py": "urdfdom-py",
    "usb": "pyusb",
    "vcstools": "vcstools",
    "yaml": "pyyaml",
    "zmq": "pyzmq",
}
"""From a module to what ``pip install`` takes."""

_SOURCE = "it is Python code of ROS: put a checkout of {} on ROS_PACKAGE_PATH"
_WINDOW = "it is for windows, which Gazelle does not open; 'gazelle view' shows what runs"
_ARM = (
    "it is not on PyPI: kdl_parser_py with PyKDL, trac_ik_python and moveit_commander, which are here, "
    "do the same"
)

_PICTURES = "the old gym here makes no pictures and films: 'gazelle film' does"
_ATARI = "pip install ale-py, and take Gymnasium's"
_MUJOCO = "pip install gymnasium-robotics, which has its successors"

ADVICE = {
    **dict.fromkeys(
        ("bondpy", "smclib"), _SOURCE.format("bond_core, https://github.com/ros/bond_core,")
    ),
    **dict.fromkeys(("hrl_geom", "pykdl_utils"), _ARM),
    **dict.fromkeys(
        ("python_qt_binding", "qt_gui", "qt_dotgraph", "rqt_gui", "rqt_gui_py", "rviz"), _WINDOW
    ),
    **dict.fromkeys(
        ("smach_ros.ActionServerWrapper", "smach_ros.IntrospectionClient"),
        _SOURCE.format("executive_smach, https://github.com/ros/executive_smach,"),
    ),
    "camera_info_manager": _SOURCE.format("camera_info_manager_py"),
    "catkin": "it is of ROS's build tool: rospkg, which is here, finds packages and their files",
    "flexbe_core": _SOURCE.format("flexbe_behavior_engine"),
    "genmsg": "definitions are read without it: import PACKAGE.msg is enough",
    "gym.envs.algorithmic": "gym took it out in 0.20",
    "gym.envs.atari": _ATARI,
    "gym.envs.box2d": "pip install 'gymnasium[box2d]'; gym.make finds its environments",
    "gym.envs.classic_control.rendering": _PICTURES,
    "gym.envs.mujoco": _MUJOCO,
    "gym.envs.robotics": _MUJOCO,
    "gym.utils.play": "'gazelle view' lets people drive",
    "gym.wrappers.AtariPreprocessing": _ATARI,
    "gym.wrappers.atari_preprocessing": _ATARI,
    "gym.wrappers.monitoring.video_recorder": _PICTURES,
    **dict.fromkeys(
        (
            "gym.wrappers.GrayScaleObservation",
            "gym.wrappers.PixelObservationWrapper",
            "gym.wrappers.RecordVideo",
            "gym.wrappers.ResizeObservation",
            "gym.wrappers.gray_scale_observation",
            "gym.wrappers.pixel_observation",
            "gym.wrappers.record_video",
            "gym.wrappers.resize_observation",
        ),
        _PICTURES,
    ),
    "moveit_python": _SOURCE.format("moveit_python"),
    "pcl": "it is C++: sensor_msgs.point_cloud2 and ros_numpy read clouds",
    "py_trees_ros": _SOURCE.format("py_trees_ros"),
    "roswtf": "'{program} node info' and '{program} topic info' say who speaks with whom",
    "stage_ros": "stage_ros has no messages and services of its own: put the fork that has them on ROS_PACKAGE_PATH",
    "sound_play": _SOURCE.format("audio_common"),
}
"""From a module to what to do where pip does not bring it."""

_KINDS = {"msg", "srv", "action"}


def module_hint(name: str) -> str | None:
    """Return what to do about a missing module; None where nothing is known.

    Args:
        name: As ``import`` has it, with dots.
    """
    top, _, rest = name.partition(".")
    if top in PIP:
        return f"pip install {PIP[top]}"
    advice = _longest(name)
    if advice is not None:
        return advice
    if top.endswith(("_msgs", "_srvs", "_interfaces")) or rest.partition(".")[0] in _KINDS:
        return f"the definitions of '{top}' are not bundled: put the package on ROS_PACKAGE_PATH"
    return None


def attribute_hint(module: str, name: str) -> str | None:
    """Return what to do about something that a module of Gazelle lacks; None where nothing is known.

    Args:
        module: Its public name, such as ``gym.wrappers``.
        name: Name of the import.
    """
    if module == "PyKDL":
        return "Gazelle's PyKDL has frames, chains and kinematics; dynamics are not there"
    return _longest(f"{module}.{name}")


def _longest(name: str) -> str | None:
    """Return the advice about a name with dots, or about the longest part of it that has some."""
    while name:
        if name in ADVICE:
            return ADVICE[name].format(program=program_name())
        name = name.rpartition(".")[0]
    return None
