"""The cart and pole."""
