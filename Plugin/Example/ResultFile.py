"""The .vtu file that a command is to leave: whether there may be one of a name, and writing it."""
import os
import sys

from paraview.simple import SaveData


def can_be(result):
    """Whether there may be a file of that name."""
    is_other = os.path.exists(result) and not os.path.isfile(result)
    return result.endswith(".vtu") and os.path.isdir(os.path.dirname(result) or ".") and not is_other


def write(result, path):
    """Beside its place first, as SaveData does not tell a script that it failed; False if it did."""
    path = os.path.realpath(path)
    part = path + ".part.vtu"
    # Not the default mode: Debian 12's ParaView cannot read back its own appended raw data.
    SaveData(part, proxy=result, DataMode="Binary")
    try:
        os.replace(part, path)
    except OSError:
        return False
    return True


def save(result, path):
    """The same; ends the command where it fails."""
    if not write(result, path):
        sys.exit(os.path.realpath(path) + " cannot be written")
