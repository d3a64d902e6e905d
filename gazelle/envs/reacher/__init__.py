"""Arms of frobs_rl that reach for places."""
