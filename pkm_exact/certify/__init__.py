"""Certificates of poses: ``build`` writes them, ``check`` replays them and shares nothing with the solver."""
