"""A TurtleBot3 finds a post of a colour by sight."""
