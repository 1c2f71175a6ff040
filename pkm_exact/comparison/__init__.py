"""All formulations of the forward kinematics problem on one robot, side by side."""
