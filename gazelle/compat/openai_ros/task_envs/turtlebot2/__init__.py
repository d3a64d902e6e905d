"""TurtleBot2."""
