"""Machines by their names in the field: each a recipe over constraints, in a file of its own."""
