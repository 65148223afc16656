"""What tests, benchmarks and tools share: places, made inputs, faults, a browser and a viewer."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
"""The checkout."""

SAMPLES = ROOT / "sample_data"
"""The rendered sample photographs."""
