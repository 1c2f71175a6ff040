"""Questions about whole regions of poses: reachable, within limits, free of singularities, everywhere or where."""
