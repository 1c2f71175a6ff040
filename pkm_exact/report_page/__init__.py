"""One web page per certificate: the robot, its poses, a picture to turn, and what was proved. It loads nothing."""
