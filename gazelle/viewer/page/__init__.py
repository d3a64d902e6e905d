"""The page in a browser: what it shows, and what can be done on it."""
