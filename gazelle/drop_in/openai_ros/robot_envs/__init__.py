"""The robots: what they sense, and how they are moved."""
