"""Tasks of openai_ros in which a base with a laser is commanded one of a few velocities."""
