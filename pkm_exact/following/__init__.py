"""The pose of a robot whose actuators move, in floating point with proved bounds: in Python, and as C code."""
