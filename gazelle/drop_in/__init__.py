"""Modules under foreign names, for scripts that import them: openai_ros, gym, moveit_commander.

`gazelle exec` and `gazelle launch` make them importable where the user has none of their own. Those
that scripts may import are entry points of the group ``gazelle_ros.modules`` in ``pyproject.toml``;
see `gazelle_ros.compat.finder`.
"""
