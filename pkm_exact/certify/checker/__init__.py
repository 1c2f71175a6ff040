"""The parts of the certificate checker; they import each other, the standard library and python-flint, nothing else."""
