"""TurtleBot3."""
