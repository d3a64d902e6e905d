"""The programs of the package controller_manager."""
