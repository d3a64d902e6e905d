"""Robotnik's Summit XL."""
