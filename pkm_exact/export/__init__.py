"""Polynomial systems in the syntax of other programs, so that anyone can check the solver with a tool of their own."""
