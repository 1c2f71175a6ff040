"""Any polynomial systems: read, solved with proofs, and what was found."""
