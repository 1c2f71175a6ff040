"""Which parameters measurements can tell apart: exact ranks of observation matrices."""
