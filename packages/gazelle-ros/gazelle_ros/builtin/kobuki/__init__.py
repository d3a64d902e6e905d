"""Nodelets that run beside the driver of a Kobuki base."""
