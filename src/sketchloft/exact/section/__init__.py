"""Sections: the outlines and walls of one segment, chosen by evidence."""
