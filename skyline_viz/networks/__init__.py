"""Networks from ONNX files: read, tried where they can do no harm, and run by OpenCV."""
