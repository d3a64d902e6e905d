"""Limits of what the arguments of environments make large."""

from __future__ import annotations

from gazelle.engines.limits import MAX_WORLDS

MAX_ENVS = MAX_WORLDS
"""Copies of an environment."""

MAX_LIDAR_SAMPLES = 100_000
"""Ranges in an observation."""

MAX_AGENTS = 10_000
"""Robots that share a world."""

MAX_STEPS = 1 << 53
"""Control steps of an episode."""

MAX_COURSE_STEPS = 10_000
"""Control steps over which a course is shown: all places in them are kept."""

MAX_DRAWS = 2**20
"""Random numbers that a task draws for a world at once."""
