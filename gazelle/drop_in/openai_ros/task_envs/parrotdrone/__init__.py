"""The Parrot drone."""
