"""SVM-DCSI: a linear support vector machine on the grey pixels around every pixel.

The machine sees a patch ``p`` with its mean taken away, over its deviation. Its decision
``w . (p - mean) / deviation + b`` is one filter, ``w`` less its mean, and two box filters for the
deviation, so the whole score image takes no longer than a few blurs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, Bool
from skyline_viz.datasets.item import Item
from skyline_viz.edges import to_grey
from skyline_viz.method import Model, shown_to_learners
from skyline_viz.methods.extras import needed
from skyline_viz.methods.score_images import (
    BEFORE,
    LEAST_DEVIATION,
    PATCH,
    DenseScores,
    draw_samples,
    fusions,
    logistic,
    normalised_parts,
    patches,
)
from skyline_viz.system.settings import Presets

SOFTNESS = 0.001
"""``C`` of the support vector machine: what a sample on the wrong side costs."""


@dataclass(frozen=True)
class SvmScores(DenseScores):
    """The model: ``weights`` (16, 16), ``bias`` (1,), and ``logistic`` (2,), slope and offset."""

    PRESETS: ClassVar[Presets] = fusions("svm")

    @property
    def family(self) -> str:
        """All its fusions learn the same."""
        return "svm-dcsi"

    def learn(self, items: Sequence[Item], seed: int) -> Model:
        """See `method.Learner.fit`; needs scikit-learn."""
        svm = needed("sklearn.svm", "methods", self.name)
        linear = needed("sklearn.linear_model", "methods", self.name)
        forms: list[F32] = []
        on_line: list[Bool] = []
        for photo, truth in shown_to_learners(items):
            rows, columns, labels = draw_samples(photo, truth, seed)
            seen = patches(to_grey(photo), rows, columns)
            # a photo's mirror image is as good a photo
            rng = np.random.default_rng([seed, len(forms)])
            mirrored = rng.random(len(seen)) < 0.5
            seen[mirrored] = seen[mirrored, :, ::-1]
            forms.append(normalised(seen).reshape(len(seen), -1))
            on_line.append(labels)
        samples, labels = np.concatenate(forms), np.concatenate(on_line)
        if labels.all() or not labels.any():
            raise ValueError("training needs pixels on a true skyline, and pixels off it.")
        machine = svm.LinearSVC(
            C=SOFTNESS, class_weight="balanced", dual=False, tol=1e-3, random_state=seed
        ).fit(samples, labels)
        decisions = machine.decision_function(samples)[:, None]
        # Platt: the score is the chance that a decision belongs to the skyline
        platt = linear.LogisticRegression(C=1e6).fit(decisions, labels)
        return {
            "weights": machine.coef_.reshape(seen.shape[1:]).astype(np.float32),
            "bias": machine.intercept_.astype(np.float64),
            "logistic": np.array([platt.coef_[0, 0], platt.intercept_[0]]),
        }

    def model_shapes(self) -> Mapping[str, tuple[int | None, ...]]:
        """See `LearnedMethod.model_shapes`."""
        return {"weights": (PATCH, PATCH), "bias": (1,), "logistic": (2,)}

    def dense_score(self, photo: U8) -> F32:
        """See `DenseScores.dense_score`."""
        slope, offset = self.part("logistic").astype(np.float64)
        return logistic(slope * self.decisions(photo) + offset).astype(np.float32)

    def decisions(self, photo: U8) -> F32:
        """``w . (p - mean) / deviation + b`` of every pixel, ``(H, W)``; above 0 for skyline.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            MethodError: The method has not been trained.
        """
        weights = self.part("weights").astype(np.float32)
        grey = to_grey(photo)
        _, deviation = normalised_parts(grey)
        answer = cv2.filter2D(
            grey,
            cv2.CV_32F,
            weights - weights.mean(),  # which takes the mean of the patch away
            anchor=(BEFORE, BEFORE),
            borderType=cv2.BORDER_REPLICATE,
        )
        decisions: F32 = (answer / deviation + self.part("bias")).astype(np.float32)
        return decisions


def normalised(seen: F32) -> F32:
    """Patches ``(n, 16, 16)`` less their means, over their deviations.

    The deviation is ``sqrt(variance + LEAST_DEVIATION ** 2)``, so that grain stays small.
    """
    centred = seen - seen.mean(axis=(1, 2), keepdims=True)
    variance = np.square(centred).mean(axis=(1, 2), keepdims=True)
    form: F32 = centred / np.sqrt(variance + np.float32(LEAST_DEVIATION**2))
    return form
