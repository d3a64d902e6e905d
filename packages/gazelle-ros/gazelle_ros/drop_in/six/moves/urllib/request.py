"""``urllib.request``."""

from urllib.request import *  # noqa: F403  # six has all of it
