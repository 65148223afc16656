"""The paper's Tables I to VI: measured, beside the published rows."""
