"""Training of headset networks: the one place that imports PyTorch."""
