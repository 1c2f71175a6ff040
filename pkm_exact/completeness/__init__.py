"""Proofs that nothing is missing from a list of poses, or that the poses are infinitely many; a module for each way."""
