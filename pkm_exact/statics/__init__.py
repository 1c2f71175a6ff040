"""What a machine can do at a pose: wrenches, Jacobians, singularities, forces, indices."""
