"""rosbridge v2: a ROS 1 graph for programs that speak JSON or CBOR over WebSockets, with rosapi.

The protocol is that of rosbridge_suite (its ROSBRIDGE_PROTOCOL.md, of ROS 1).
"""
