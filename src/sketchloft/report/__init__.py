"""Pictures and the report of a reconstruction."""
