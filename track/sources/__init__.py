"""Where pictures come from: webcams, films, folders, addresses; each gives one camera's pictures with their times."""
