"""What a joint, a leg or a sensor asks of the platform's pose: one type a module, each linear on rigid motions."""
