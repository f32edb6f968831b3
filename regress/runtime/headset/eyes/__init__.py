"""What an eye's traced points say: how far its lids are open, how wide its pupil is, and where it looks."""
