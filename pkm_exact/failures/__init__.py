"""What the program does when it contradicts itself or breaks: an exception with the facts, and a file to send."""
