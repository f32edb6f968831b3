"""What a frame passes through: needs NumPy, onnxruntime and OpenCV only, and imports nothing that learns."""
