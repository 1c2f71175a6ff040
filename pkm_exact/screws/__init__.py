"""Screws and their linear systems over the rational numbers: ranks and null spaces as theorems, not by tolerance."""
