"""A trained headset network: what it takes and gives, its folder, and its graph, which runs on one core."""
