"""Common parts of openai_ros and frobs_rl; no script imports it."""
