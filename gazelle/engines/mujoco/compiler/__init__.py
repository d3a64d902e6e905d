"""Compilation of descriptions to MuJoCo models."""
