"""Models to begin with: a robot of any kind from a few numbers, as a commented model file."""
