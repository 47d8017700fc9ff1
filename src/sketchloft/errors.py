"""The one error tree of sketchloft.

::

    SketchloftError                 exit code 1
    ├── UsageError                  2   an option has a value that it cannot have
    ├── InputError                  3   a file is missing, unreadable or malformed
    ├── CloudError                  4   the points cannot describe a solid
    ├── StageError                  5   a stage of the reconstruction cannot go on
    ├── ModelError                  6   the solid is not valid, so it is not given out
    └── OutputError                 7   a result cannot be written

Every message is one sentence or two that say what was found, what was expected and
what to try. `StageError` also names the stage and, where there is one, the slice.
"""

__all__ = [
    "CloudError",
    "InputError",
    "ModelError",
    "OutputError",
    "SketchloftError",
    "StageError",
    "UsageError",
]


class SketchloftError(Exception):
    """Base of every error that sketchloft raises on purpose."""

    exit_code = 1


class UsageError(SketchloftError):
    """An option or a parameter has a value that it cannot have."""

    exit_code = 2


class InputError(SketchloftError):
    """A file is missing, unreadable, or not in the format that its name says."""

    exit_code = 3


class CloudError(SketchloftError):
    """The points cannot describe a solid: too few, all equal, on a line, on a plane."""

    exit_code = 4


class StageError(SketchloftError):
    """A stage of the reconstruction cannot go on.

    Parameters
    ----------
    message : str
        What was found, what was expected, what to try.
    stage : str
        The stage, in the words of the README ("edge points").
    slice_index : int, optional
        The slice it happened on, counted from 0 along the slicing direction.
    """

    exit_code = 5

    def __init__(self, message: str, *, stage: str, slice_index: int | None = None) -> None:
        self.stage = stage
        self.slice_index = slice_index
        where = stage if slice_index is None else f"{stage}, slice {slice_index}"
        super().__init__(f"{where}: {message}")


class ModelError(SketchloftError):
    """The solid that was built fails a validity check."""

    exit_code = 6


class OutputError(SketchloftError):
    """A result cannot be written where it was asked for."""

    exit_code = 7
