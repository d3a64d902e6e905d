"""A task in which a TurtleBot3 finds a coloured post with its camera."""
