"""``urllib.error``."""

from urllib.error import *  # noqa: F403  # six has all of it
