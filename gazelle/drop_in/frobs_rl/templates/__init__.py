"""Beginnings of environments: copy them, and fill them in."""
