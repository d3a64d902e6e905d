"""The catamaran task of openai_ros: drive between buoys."""
