"""Mechanisms with passive bodies: their polynomial systems, solved, and single solutions near a start."""
