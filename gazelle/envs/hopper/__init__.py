"""The leg of openai_ros that shall stay up."""
