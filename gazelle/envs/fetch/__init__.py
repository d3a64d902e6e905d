"""Fetch at its table: Gymnasium-Robotics' four tasks, on the batch engine."""
