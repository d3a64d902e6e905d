"""Rollouts in other processes and on other machines.

All copies of a task are divided into shards of a size that depends on their number alone. A
worker holds some of the shards; a policy goes out to it once an iteration, and whole rollouts
come back, with what it takes to continue from their end. So the result depends neither on how many
workers there are nor on which of them are lost on the way.
"""

from __future__ import annotations

from gazelle.training.workers.shards import ShardHost, ShardSpec, divided
from gazelle.training.workers.team import WorkerGroup, WorkerLink, WorkerLostError

__all__ = ["ShardHost", "ShardSpec", "WorkerGroup", "WorkerLink", "WorkerLostError", "divided"]
