"""Where a head is and how it is turned: the camera, the shape of heads, and the fit of one to a face's points."""
