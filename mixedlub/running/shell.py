"""Quoting of command lines for the shell of this system."""

from __future__ import annotations

import shlex
import subprocess
import sys


def quoted(word: str) -> str:
    """A word as one argument: in single quotes for POSIX shells, in double quotes on Windows.

    >>> quoted("columns.load_N=Force (N)")
    "'columns.load_N=Force (N)'"
    """
    return subprocess.list2cmdline([word]) if sys.platform == "win32" else shlex.quote(word)
