"""Where answers go: avatar programs by their own protocols, files, the page, the room."""
