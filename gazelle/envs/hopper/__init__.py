"""The hopper tasks of openai_ros: a one-legged robot that balances."""
