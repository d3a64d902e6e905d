"""The WAM-V."""
