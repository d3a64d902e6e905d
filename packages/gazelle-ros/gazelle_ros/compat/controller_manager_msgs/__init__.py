"""The Python code of the package controller_manager_msgs: which managers and controllers there are."""
