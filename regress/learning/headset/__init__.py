"""Headset networks: arrays, training, evaluation."""
