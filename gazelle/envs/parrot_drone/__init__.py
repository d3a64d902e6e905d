"""The quadrotor of openai_ros that flies to a place."""
