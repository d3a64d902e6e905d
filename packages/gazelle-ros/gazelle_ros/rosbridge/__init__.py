"""rosbridge v2 and rosapi: a ROS 1 graph for JSON or CBOR clients over WebSockets.

The protocol is that of rosbridge_suite (its ROSBRIDGE_PROTOCOL.md, of ROS 1).
"""
