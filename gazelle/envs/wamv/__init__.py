"""The catamaran of openai_ros that goes between buoys."""
