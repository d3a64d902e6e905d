"""The modules of openai_ros, frobs_rl and the old gym, for scripts that import them by name.

`gazelle exec` and `gazelle launch` make them importable as ``openai_ros``, ``frobs_rl`` and ``gym``
where the user has none of their own; see `gazelle.ros.compat.finder`.
"""
