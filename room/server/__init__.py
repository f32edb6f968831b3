"""The process that people connect to: rooms, keys, the roster, signalling, the page, figures for operators."""
