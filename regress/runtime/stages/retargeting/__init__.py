"""Weights for avatars with other shapes than ARKit's: a matrix for each target, read from a TOML file.

A target that ships is a file in ``targets``; a new one is a new file there, and the tests run over them all.
"""
