"""The moving-cube task of openai_ros: a cube driven by a reaction wheel."""
