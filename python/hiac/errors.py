"""What hiac raises. Every message is the one line that the command-line tools print."""


class Error(Exception):
    """Base of hiac's errors; itself: something internal, or a program that is missing."""


class UsageError(Error, ValueError):
    """Something was asked for that does not exist or does not fit together."""


class InputError(Error):
    """A file, a mesh or a specification cannot be read, is malformed, or cannot be written."""


class JudgementError(Error):
    """The input was read and understood, and fails a judgement."""


class Cancelled(Error):
    """The work was asked to stop (Cancellation.request)."""


class PictureWarning(UserWarning):
    """A picture may not show what was meant."""
