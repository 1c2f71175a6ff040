"""The groups of rigid motions in which a platform may move, each a projective variety of known dimension and degree."""
