"""What Gazebo's plugin libraries do, one module each; ``table`` has them by file name."""
