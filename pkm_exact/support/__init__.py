"""Whether an installation works, and what it consists of."""
