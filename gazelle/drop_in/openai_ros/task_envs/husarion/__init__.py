"""Husarion's ROSbot."""
