"""The page in the browser: a small server on this machine, and what it shows."""
