"""The exceptions and warnings of ibmfair. Each exception stands for one exit code of the program."""


class Error(Exception):
    """Base of everything that ibmfair raises on purpose.

    Attributes
    ----------
    exit_code : int
        The exit code with which the command line reports the same.
    """

    exit_code = 70


class NotReached(Error, RuntimeError):
    """The computation ran, but did not achieve the requested result."""

    exit_code = 1


class BadOption(Error, ValueError):
    """An option or argument has a value that cannot be used."""

    exit_code = 2


class BadFile(Error, ValueError, OSError):
    """A file cannot be read or is malformed; the message names the place."""

    exit_code = 3


class BadMesh(Error, ValueError):
    """The geometry cannot be processed, although its arrays are well formed."""

    exit_code = 4


class FactorizationFailed(Error, ArithmeticError):
    """The matrix is not positive definite, or a limit is exceeded."""

    exit_code = 4


class OutOfMemory(Error, MemoryError):
    """Memory ran out, or the limit `memory` leaves no solver that fits."""

    exit_code = 5


class CannotWrite(Error, OSError):
    """An output could not be written; the target is as it was before."""

    exit_code = 6


class MeshWarning(UserWarning):
    """A defect of a mesh, or something about a result that may surprise."""
