"""Many length vectors of one robot: a solver for rows like each other, and arrays of what it finds."""
