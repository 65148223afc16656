"""Published figures: Tables I to VI of the paper, to stand beside measured ones.

Ahmad et al., *Resource Efficient Mountainous Skyline Extraction using Shallow Learning*, IJCNN
2021. A_err in pixels; times on a 1.8 GHz Intel Core i5 for photos of 519x1388 pixels.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Errors:
    """A_err over a data set, in pixels."""

    mean: float
    standard_deviation: float
    minimum: float | None = None
    maximum: float | None = None


TITLES = {
    "default": "Ours, default",
    "paper": "Proposed",
    "edges": "Edges only",
    "gradient": "G_r",
    "sift-hog-edges": "SIFT+HOG edges",
    "sift-hog-scores": "SIFT+HOG scores",
    "sift-hog-scores-gradient": "SIFT+HOG scores + G_r",
    "svm-dcsi": "SVM-DCSI",
    "svm-mdcsi": "SVM-mDCSI",
    "svm-dcsi-gradient": "SVM-DCSI + G_r",
    "svm-dcsi-msee": "SVM-DCSI + MSEE edges",
    "svm-dcsi-canny": "SVM-DCSI + Canny edges",
    "cnn-dcsi": "CNN-DCSI",
    "cnn-mdcsi": "CNN-mDCSI",
    "cnn-dcsi-gradient": "CNN-DCSI + G_r",
    "cnn-dcsi-msee": "CNN-DCSI + MSEE edges",
    "cnn-dcsi-canny": "CNN-DCSI + Canny edges",
    "fcn-8s": "FCN-8s",
    "fcn-16s": "FCN-16s",
    "fcn-32s": "FCN-32s",
    "segnet": "SegNet",
}
"""What the paper calls each method."""

TABLE_1: dict[str, dict[str, Errors]] = {
    "Basalt Hills (36)": {
        "edges": Errors(5.55, 9.46, 0.53, 49.31),
        "gradient": Errors(3.99, 6.35, 0.18, 31.33),
        "sift-hog-edges": Errors(0.57, 1.02, 0.00, 3.58),
        "sift-hog-scores": Errors(0.41, 0.81, 0.00, 3.08),
        "sift-hog-scores-gradient": Errors(0.43, 0.81, 0.00, 3.08),
        "svm-mdcsi": Errors(1.01, 0.29, 0.62, 1.76),
        "cnn-mdcsi": Errors(0.75, 0.23, 0.42, 1.28),
        "svm-dcsi-gradient": Errors(0.60, 0.29, 0.17, 1.31),
        "svm-dcsi-msee": Errors(0.73, 0.32, 0.48, 2.07),
        "svm-dcsi-canny": Errors(0.77, 0.35, 0.48, 2.07),
        "paper": Errors(1.45, 1.55, 0.24, 5.69),
    },
    "Web (80)": {
        "edges": Errors(9.15, 17.92, 0.38, 93.02),
        "gradient": Errors(11.86, 26.81, 0.15, 121.48),
        "sift-hog-edges": Errors(0.87, 1.03, 0.43, 7.05),
        "sift-hog-scores": Errors(0.97, 1.57, 0.38, 12.19),
        "sift-hog-scores-gradient": Errors(1.30, 3.98, 0.38, 34.95),
        "svm-mdcsi": Errors(1.28, 1.20, 0.37, 6.21),
        "cnn-mdcsi": Errors(1.41, 1.49, 0.27, 10.79),
        "svm-dcsi-gradient": Errors(4.86, 15.98, 0.14, 98.46),
        "svm-dcsi-msee": Errors(0.85, 0.89, 0.35, 5.05),
        "svm-dcsi-canny": Errors(0.78, 0.76, 0.35, 4.84),
        "paper": Errors(7.85, 32.64, 0.29, 203.34),
    },
}
"""Methods by data set. Edges and G_r learn nothing, the proposed method was trained on 203 photos
of CH1, the others, by their own papers, on nine of the 45 of Basalt Hills, the other 36 of which
are the test (section IV of the paper)."""

TABLE_2 = {
    "Basalt Hills (45)": Errors(1.33, 1.45, 0.23, 5.69),
    "Web (73)": Errors(0.79, 0.68, 0.29, 4.66),
}
"""The published method on all photos of Basalt Hills, and on those of Web under 4 px."""

TABLE_3: dict[str, dict[int, Errors]] = {
    "Basalt Hills (45)": {
        7: Errors(1.3334, 1.4542, 0.23, 5.69),
        9: Errors(1.3402, 1.4559, 0.23, 5.69),
        11: Errors(1.3419, 1.4547, 0.23, 5.69),
        13: Errors(1.3557, 1.4639, 0.23, 5.69),
        15: Errors(1.3649, 1.4593, 0.23, 5.69),
    },
    "Web (73)": {
        7: Errors(0.7919, 0.6864, 0.29, 4.66),
        9: Errors(0.7921, 0.6610, 0.29, 4.33),
        11: Errors(0.7830, 0.6366, 0.29, 4.45),
        13: Errors(0.7887, 0.6691, 0.29, 4.54),
        15: Errors(0.7941, 0.6872, 0.29, 4.68),
    },
}
"""By filter size, in pixels a side."""

TABLE_4: dict[tuple[str, str], Errors] = {
    ("CH1", "Basalt Hills (45)"): Errors(1.33, 1.45),
    ("CH1", "Web (80)"): Errors(7.85, 32.64),
    ("Basalt Hills (45)", "CH1"): Errors(109.84, 144.34),
    ("Basalt Hills (45)", "Web (80)"): Errors(14.62, 54.81),
    ("Web (80)", "CH1"): Errors(101.87, 140.18),
    ("Web (80)", "Basalt Hills (45)"): Errors(1.27, 1.39),
}
"""By training set and test set."""

TABLE_5: dict[str, tuple[float, Errors]] = {
    "FCN8s-Pascal": (0.9551, Errors(32.161, 57.510)),
    "FCN16s-Pascal": (0.9539, Errors(32.888, 58.193)),
    "FCN32s-Pascal": (0.9520, Errors(33.534, 57.588)),
    "FCN8s-SiftFlow-g": (0.9491, Errors(34.975, 53.334)),
    "FCN8s-SiftFlow-s": (0.9563, Errors(31.399, 55.052)),
    "Horizon-ALE-CH1": (0.9411, Errors(43.959, 86.038)),
    "Horizon-DCSI-CH1": (0.8743, Errors(99.742, 160.252)),
    "SegNet-CH1": (0.8437, Errors(114.893, 99.021)),
    "FCN8s-SiftFlow-s-CH1": (0.9486, Errors(37.947, 69.435)),
    "FCN8s-Pascal-CH1": (0.9432, Errors(41.596, 71.707)),
    "Proposed": (0.8652, Errors(105.712, 164.224)),
}
"""Segmentation accuracy and A_err over 2895 photos of GeoPose3K."""

TABLE_6: dict[str, tuple[float, float]] = {
    "FCN8s-Pascal": (513.0, 15.39),
    "FCN16s-Pascal": (514.3, 15.31),
    "FCN32s-Pascal": (519.4, 16.16),
    "FCN8s-SiftFlow": (514.0, 15.65),
    "Horizon-DCSI": (0.0022, 20.45),
    "Proposed": (0.057, 10.59),
}
"""Size of the model in megabytes, and seconds for one photo."""
