"""Plan: everything that was found about a cloud, as a file that a person can edit and give back."""
