"""Trains, evaluates and probes models: needs the extra ``learn``, for headset networks ``headset``."""
