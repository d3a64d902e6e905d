"""The quadrotor task of openai_ros: fly to a goal."""
