"""Tasks of openai_ros in which a base with a laser is told one of a few velocities."""
