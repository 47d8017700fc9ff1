"""The search: from a first stack to the model that explains the points best."""
