"""The node ``octomap_server``: occupied and free space in three dimensions."""
