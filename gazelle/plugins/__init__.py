"""What Gazebo's plugin libraries do, one module each; found by file name, see ``pyproject.toml``."""
