"""Convex polytopes in exact arithmetic: zonotopes, sections of boxes, vertices, facets, volumes."""
