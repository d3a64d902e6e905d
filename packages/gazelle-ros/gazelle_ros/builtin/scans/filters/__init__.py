"""Filters of laser scans, by the names of laser_filters (http://wiki.ros.org/laser_filters)."""
