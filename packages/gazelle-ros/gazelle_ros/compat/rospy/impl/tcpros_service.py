"""Services, where rospy keeps them."""

from gazelle_ros.compat.rospy.exceptions import ServiceException
from gazelle_ros.compat.rospy.service import (
    DEFAULT_BUFF_SIZE,
    Service,
    ServiceProxy,
    convert_return_to_response,
    wait_for_service,
)

__all__ = [
    "DEFAULT_BUFF_SIZE",
    "Service",
    "ServiceException",
    "ServiceProxy",
    "convert_return_to_response",
    "wait_for_service",
]
