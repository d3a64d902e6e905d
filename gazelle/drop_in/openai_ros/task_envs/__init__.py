"""The tasks: what is seen, done and rewarded."""
