"""Joysticks of this machine, and what drives robots by them."""
