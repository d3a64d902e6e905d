"""Inverse kinematics between limits of joints."""
