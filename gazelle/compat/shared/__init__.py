"""What openai_ros and frobs_rl have in common here; no script imports it."""
