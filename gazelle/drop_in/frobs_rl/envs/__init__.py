"""The environment that robots and tasks derive from."""

from __future__ import annotations

from gazelle.drop_in.frobs_rl.envs import robot_BasicEnv

__all__ = ["robot_BasicEnv"]
