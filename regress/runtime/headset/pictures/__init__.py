"""What one picture of a headset's camera is: how it is read, what is wrong with it, which part is looked at."""
