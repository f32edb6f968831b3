"""What trains, judges and measures models: needs the extra ``learn``, for headset networks ``headset``."""
