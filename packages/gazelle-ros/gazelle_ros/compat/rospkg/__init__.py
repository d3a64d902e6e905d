"""rospkg's interface: packages on ROS_PACKAGE_PATH."""

from gazelle_ros.compat.rospkg.common import (
    MANIFEST_FILE,
    PACKAGE_FILE,
    STACK_FILE,
    ResourceNotFound,
)
from gazelle_ros.compat.rospkg.environment import (
    get_log_dir,
    get_ros_home,
    get_ros_package_path,
    get_ros_paths,
    get_ros_root,
    get_test_results_dir,
    on_ros_path,
)
from gazelle_ros.compat.rospkg.manifest import (
    Depend,
    InvalidManifest,
    Manifest,
    parse_manifest_file,
)
from gazelle_ros.compat.rospkg.rospack import (
    RosPack,
    RosStack,
    expand_to_packages,
    get_package_name,
    list_by_path,
)

__all__ = [
    "MANIFEST_FILE",
    "PACKAGE_FILE",
    "STACK_FILE",
    "Depend",
    "InvalidManifest",
    "Manifest",
    "ResourceNotFound",
    "RosPack",
    "RosStack",
    "expand_to_packages",
    "get_log_dir",
    "get_package_name",
    "get_ros_home",
    "get_ros_package_path",
    "get_ros_paths",
    "get_ros_root",
    "get_test_results_dir",
    "list_by_path",
    "on_ros_path",
    "parse_manifest_file",
]
