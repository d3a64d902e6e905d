"""TCPROS (http://wiki.ros.org/ROS/TCPROS): connection headers, then length-prefixed messages."""
