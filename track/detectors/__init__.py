"""What finds a face: each detector is a stage that gives a sample its 68 points, irises and head, as far as it can."""
