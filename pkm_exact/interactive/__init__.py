"""What a person meets at a prompt or in a notebook: questions to a robot, results to look at, progress."""
