"""The wire message that browsers, `track` and the server exchange."""
