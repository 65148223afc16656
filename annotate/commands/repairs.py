"""``skyline-annotate repair``: a folder whose labels are damaged is made to work again."""

from __future__ import annotations

from dataclasses import dataclass

from annotate.commands.options import PROGRAM, PhotoFolder, check_folder, locked
from skyline_viz.command_line.messages import GOOD, SOME_FAILED, say, tell


@dataclass(frozen=True)
class Repair:
    """Save what can be read of damaged labels, and set aside those that cannot; none is deleted.

    Examples:
        skyline-annotate repair photos
        skyline-annotate repair photos/june
        skyline-annotate repair /data/photos
    """

    folder: PhotoFolder
    """Folder of the photos."""

    def run(self) -> int:
        """Repair; return the exit status."""
        from annotate.rescue.repair import repair

        with locked(check_folder(self.folder)):
            done = repair(self.folder)
        for sentence in done.said:
            say(sentence, PROGRAM)
        if not done.said:
            tell(f"All labels in {self.folder} can be read; nothing was changed.")
        return GOOD if done.whole else SOME_FAILED
