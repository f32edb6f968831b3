"""How voices reach each other: by a mesh of peers, or by Janus."""
