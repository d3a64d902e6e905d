"""rospy's interface on a `gazelle_ros.Node`: one node a process."""

from __future__ import annotations

from gazelle_ros.compat.rospy import (
    client,
    core,
    exceptions,
    impl,
    logs,
    msg,
    names,
    rostime,
    service,
    timer,
    topics,
)
from gazelle_ros.compat.rospy.client import (
    get_master,
    get_param,
    get_param_cached,
    get_param_names,
    get_published_topics,
    has_param,
    init_node,
    myargv,
    on_shutdown,
    search_param,
    set_param,
    spin,
    wait_for_message,
)
from gazelle_ros.compat.rospy.core import (
    get_node_uri,
    get_ros_root,
    is_shutdown,
    parse_rosrpc_uri,
    signal_shutdown,
)
from gazelle_ros.compat.rospy.exceptions import (
    ROSException,
    ROSInitException,
    ROSInternalException,
    ROSInterruptException,
    ROSSerializationException,
    ROSTimeMovedBackwardsException,
    ServiceException,
    TransportException,
    TransportInitError,
    TransportTerminated,
)
from gazelle_ros.compat.rospy.logs import *  # noqa: F403  levels and functions, listed there
from gazelle_ros.compat.rospy.msg import AnyMsg
from gazelle_ros.compat.rospy.msproxy import MasterProxy
from gazelle_ros.compat.rospy.names import (
    get_caller_id,
    get_name,
    get_namespace,
    remap_name,
    resolve_name,
)
from gazelle_ros.compat.rospy.params import delete_param
from gazelle_ros.compat.rospy.rostime import Duration, Time, get_rostime, get_time
from gazelle_ros.compat.rospy.service import Service, ServiceProxy, wait_for_service
from gazelle_ros.compat.rospy.timer import Rate, Timer, TimerEvent, sleep
from gazelle_ros.compat.rospy.topics import Publisher, SubscribeListener, Subscriber
from gazelle_ros.messages import Message
from gazelle_ros.msgs import std_msgs

Header = std_msgs.msg.Header

__all__ = [
    "AnyMsg",
    "Duration",
    "Header",
    "MasterProxy",
    "Message",
    "Publisher",
    "ROSException",
    "ROSInitException",
    "ROSInternalException",
    "ROSInterruptException",
    "ROSSerializationException",
    "ROSTimeMovedBackwardsException",
    "Rate",
    "Service",
    "ServiceException",
    "ServiceProxy",
    "SubscribeListener",
    "Subscriber",
    "Time",
    "Timer",
    "TimerEvent",
    "TransportException",
    "TransportInitError",
    "TransportTerminated",
    "client",
    "core",
    "delete_param",
    "exceptions",
    "get_caller_id",
    "get_master",
    "get_name",
    "get_namespace",
    "get_node_uri",
    "get_param",
    "get_param_cached",
    "get_param_names",
    "get_published_topics",
    "get_ros_root",
    "get_rostime",
    "get_time",
    "has_param",
    "impl",
    "init_node",
    "is_shutdown",
    "msg",
    "myargv",
    "names",
    "on_shutdown",
    "parse_rosrpc_uri",
    "remap_name",
    "resolve_name",
    "rostime",
    "search_param",
    "service",
    "set_param",
    "signal_shutdown",
    "sleep",
    "spin",
    "timer",
    "topics",
    "wait_for_message",
    "wait_for_service",
]
__all__ += logs.__all__
