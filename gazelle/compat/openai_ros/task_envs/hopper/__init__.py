"""The monoped."""
