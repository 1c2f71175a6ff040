"""How a mechanism can move: instantaneous and finite mobility, actuation, and identities for every pose."""
