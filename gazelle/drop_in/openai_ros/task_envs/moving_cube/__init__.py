"""The cube that walks by a wheel."""
