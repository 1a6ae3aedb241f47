"""Commands and programs in a fork of the build: the package is loaded once for all pages."""

from __future__ import annotations

import os
import pkgutil
import shlex
import signal
import sys
import traceback
import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path

LATE = (
    "jinja2",
    "matplotlib.backends.backend_svg",
    "matplotlib.figure",
    "openpyxl",
    "pyarrow.parquet",
    "rich.progress",
    "scipy.interpolate",
    "scipy.optimize",
    "scipy.spatial",
    "scipy.stats",
    "xarray",
)
"""Libraries that the package loads where it needs them."""
OF_SHELL = frozenset("|&;<>$*?~`()#")
QUIET = (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning)


def load() -> None:
    """Load the package and its libraries."""
    import mixedlub

    for one in pkgutil.walk_packages(mixedlub.__path__, "mixedlub."):
        if not one.name.endswith("__main__"):
            import_module(one.name)
    for name in LATE:
        import_module(name)


def words(program: str) -> list[str] | None:
    """Words of a plain command of mixedlub, or None if it needs a shell.

    >>> words("mixedlub check \\\\\\n 'my case'"), words("mixedlub new gear && ls"), words("head -1 a.csv")
    (['check', 'my case'], None, None)
    """
    if OF_SHELL & set(program):
        return None
    name, *rest = shlex.split(program.replace("\\\n", " "))
    return rest if name == "mixedlub" else None


def command(arguments: list[str]) -> int:
    """Exit status of a command of mixedlub."""
    from mixedlub.cli import main

    for category in QUIET:
        warnings.simplefilter("ignore", category)
    sys.argv = ["mixedlub", *arguments]
    return main(arguments)


def python(program: str) -> int:
    """Exit status of a Python program; any warning is an error but those about the numbers of a result."""
    warnings.simplefilter("error")
    for start in ("caution", "doubt"):
        warnings.filterwarnings("default", start)
    sys.argv = ["-c"]
    sys.path.insert(0, "")
    exec(compile(program, "<string>", "exec"), {"__name__": "__main__"})
    return 0


def run(act: Callable[[], int], folder: Path, surroundings: Mapping[str, str], limit_s: int) -> tuple[int, str]:
    """Exit status and output of an action in a fork, in a folder and with an environment; killed after the limit."""
    sys.stdout.flush()
    sys.stderr.flush()
    source, sink = os.pipe()
    child = os.fork()
    if child == 0:
        os._exit(_inside(act, folder, surroundings, limit_s, sink))
    os.close(sink)
    with open(source, encoding="utf-8") as stream:
        output = stream.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), output


def _inside(act: Callable[[], int], folder: Path, surroundings: Mapping[str, str], limit_s: int, sink: int) -> int:
    status = 1
    try:
        signal.alarm(limit_s)
        os.chdir(folder)
        os.environ.update(surroundings)
        os.dup2(sink, 1)
        os.dup2(sink, 2)
        os.close(sink)
        # Buffers are those of a program whose output goes to a pipe.
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        sys.stdin, sys.stdout = os.fdopen(0, encoding="utf-8"), os.fdopen(1, "w", encoding="utf-8")
        sys.stderr = os.fdopen(2, "w", encoding="utf-8", buffering=1)
        warnings.resetwarnings()
        status = act()
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
    return status
