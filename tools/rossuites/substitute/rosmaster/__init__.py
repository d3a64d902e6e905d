"""Stands in for rosmaster in rostest, which makes its masters by importing this name."""

DEFAULT_MASTER_PORT = 11311
