"""The reach tasks of frobs_rl for robot arms."""
