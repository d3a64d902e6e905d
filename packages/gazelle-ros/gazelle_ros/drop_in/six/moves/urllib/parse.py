"""``urllib.parse``."""

from urllib.parse import *  # noqa: F403  # six has all of it
