"""The Python code of the package controller_manager: functions that call a manager's services."""
