"""The TurtleBot3 DQN tasks of ROBOTIS: drive to goals in four arenas with a lidar."""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])
