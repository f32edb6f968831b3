"""Headset networks: their arrays, training and judgement."""
