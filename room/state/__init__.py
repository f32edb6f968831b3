"""What a room knows of each person, and one buffer a tick for all."""
