"""The cube of openai_ros that a wheel inside moves."""
