"""Names of the methods, and where each is at home; light to import, for command lines."""

from __future__ import annotations

from collections.abc import Mapping

HOMES: Mapping[str, str] = {
    "default": "skyline_viz.detector:Detector",
    "paper": "skyline_viz.detector:Detector",
    "edges": "skyline_viz.methods.edges_only:EdgesOnly",
    "gradient": "skyline_viz.methods.gradient:GradientCost",
    "sift-hog-edges": "skyline_viz.methods.sift_hog:SiftHogEdges",
    "sift-hog-scores": "skyline_viz.methods.sift_hog:SiftHogScores",
    "sift-hog-scores-gradient": "skyline_viz.methods.sift_hog:SiftHogScoresGradient",
    "svm-dcsi": "skyline_viz.methods.dense_scores:SvmScores",
    "svm-mdcsi": "skyline_viz.methods.dense_scores:SvmScores",
    "svm-dcsi-gradient": "skyline_viz.methods.dense_scores:SvmScores",
    "svm-dcsi-msee": "skyline_viz.methods.dense_scores:SvmScores",
    "svm-dcsi-canny": "skyline_viz.methods.dense_scores:SvmScores",
    "cnn-dcsi": "skyline_viz.methods.cnn_scores:CnnScores",
    "cnn-mdcsi": "skyline_viz.methods.cnn_scores:CnnScores",
    "cnn-dcsi-gradient": "skyline_viz.methods.cnn_scores:CnnScores",
    "cnn-dcsi-msee": "skyline_viz.methods.cnn_scores:CnnScores",
    "cnn-dcsi-canny": "skyline_viz.methods.cnn_scores:CnnScores",
    "fcn-8s": "skyline_viz.methods.parsing:Fcn8s",
    "fcn-16s": "skyline_viz.methods.parsing:Fcn16s",
    "fcn-32s": "skyline_viz.methods.parsing:Fcn32s",
    "segnet": "skyline_viz.methods.parsing:SegNet",
}
"""Module and class of our detector, with its default and with the published settings, and of the
earlier methods, in the order of the paper's Table I."""

NAMES: tuple[str, ...] = tuple(HOMES)
"""All names."""
