"""Tasks of frobs_rl in which a Kobuki drives to goals among walls and boxes."""
