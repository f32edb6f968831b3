"""Brings any camera's pictures to what a network was trained on: place, turn and light."""
