"""What a frame passes through: each stage takes one sample and gives one, live or in a file's loop."""
