"""Orientation from an inertial measurement unit and a magnetometer."""
