"""Names of the methods; light to import, for command lines."""

from typing import Literal, TypeAlias

MethodName: TypeAlias = Literal[
    "default",
    "paper",
    "edges",
    "gradient",
    "sift-hog-edges",
    "sift-hog-scores",
    "sift-hog-scores-gradient",
    "svm-dcsi",
    "svm-mdcsi",
    "svm-dcsi-gradient",
    "svm-dcsi-msee",
    "svm-dcsi-canny",
    "cnn-dcsi",
    "cnn-mdcsi",
    "cnn-dcsi-gradient",
    "cnn-dcsi-msee",
    "cnn-dcsi-canny",
    "fcn-8s",
    "fcn-16s",
    "fcn-32s",
    "segnet",
]
"""Our detector with its default and with the published settings, and the earlier methods."""
