"""Pictures of certified poses. Nothing is drawn that the checker did not accept; matplotlib is imported when needed."""
