"""Numbers that are shown at every pose, in all outputs alike: one module and one row each."""
