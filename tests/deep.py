"""What tests of the deep methods need."""

from importlib.util import find_spec

import pytest

needs_deep = pytest.mark.skipif(
    find_spec("torch") is None or find_spec("onnx") is None,
    reason="needs the extra deep: pip install 'skyline-viz[deep]'",
)
