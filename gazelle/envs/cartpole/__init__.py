"""The cart and pole of openai_ros."""
