"""What a diagnosis found in a segment, in sentences."""

from skyline_viz.diagnosis.counterfactual import Case
from testing.injected import cases, main_cause


def test_evidence_says_which_columns_it_counts(flat):
    (one,) = cases("missed edge", 1)
    segment = main_cause(one)
    case = Case(one.detection, one.truth, 4.0)
    reach = case.excursion(*segment.columns)
    assert reach != segment.columns
    assert segment.evidence.startswith(
        f"Between columns {reach[0]} and {reach[1]}, where the path leaves the truth, the truth "
    )
