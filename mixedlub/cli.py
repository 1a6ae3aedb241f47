"""The command `mixedlub`: subcommands, exit status and error messages."""

from __future__ import annotations

import errno
import os
import re
import sys
import warnings
from collections.abc import Sequence
from functools import cache
from textwrap import indent
from typing import Annotated, Any

# Before NumPy is loaded: matrices are small here, and threads of BLAS would wait on those of the batch engine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import typer

from mixedlub.app import command as app_command
from mixedlub.commands import (
    bevel,
    check,
    condense,
    diagnose,
    effects,
    efficiency,
    ehl,
    evaluate,
    factors,
    fit,
    friction_laws,
    gear,
    import_files,
    kinds,
    law_errors,
    new,
    parts,
    profile,
    prove,
    schema,
    simulate,
    study,
    worm,
)
from mixedlub.commands.console import (
    drop_empty_folders,
    echo,
    fail,
    forget_traceback,
    is_full,
    note,
    opened,
    print_findings,
    reset_output,
    resume_hint,
    save_traceback,
)
from mixedlub.running.atomic import PARTS
from mixedlub.schema.findings import FindingWarning
from mixedlub.schema.messages import of_option
from profiles.errors import InputError, RunError, nearest

COMMANDS = (
    profile,
    study,
    factors,
    simulate,
    gear,
    bevel,
    worm,
    efficiency,
    ehl,
    law_errors,
    condense,
    evaluate,
    fit,
    diagnose,
    check,
    import_files,
    new,
    kinds,
    schema,
    effects,
    friction_laws,
    parts,
    prove,
    app_command,
)

PARTIAL = {
    study.NAME: f"{PARTS}*/*.parquet",
    **dict.fromkeys((ehl.NAME, law_errors.NAME, condense.NAME), f"{PARTS}*/*.npz"),
    prove.NAME: "**/*",
}
"""Commands that save their work when stopped, with the pattern of the saved files."""
UNUSABLE = (errno.ENAMETOOLONG, errno.EACCES, errno.EPERM, errno.EROFS, errno.ELOOP, errno.ENOTDIR, errno.EISDIR)
"""Errors of a path on the user's system: too long, not readable, not a folder."""
CTRL_C = 130
"""Exit status of a command stopped by Ctrl-C, the convention of shells and typer."""

app = typer.Typer(
    no_args_is_help=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _say_version(wanted: bool) -> None:
    if wanted:
        from mixedlub.running.version import installed_version

        echo(f"mixedlub {installed_version()}")
        raise typer.Exit


@app.callback()
def _about(
    version: Annotated[
        bool, typer.Option("--version", callback=_say_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Surface finish, oil film and gear loss.

    From roughness traces to power loss, and from recordings to the missing physics.
    """


for _module in COMMANDS:
    # The mark keeps the lines of the example apart.
    app.command(_module.NAME, epilog="\b\nExample:\n" + indent(_module.EXAMPLE, "  "))(_module.command)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; 0 done, 2 bad input, 130 stopped by Ctrl-C, 1 anything else: one message, no traceback."""
    reset_output()
    with warnings.catch_warnings():
        # What numbers overflow while far-off parameters are tried is not for the user.
        warnings.simplefilter("ignore", RuntimeWarning)
        warnings.showwarning = _show
        words = map(with_home, sys.argv[1:] if arguments is None else arguments)
        return _run(spread_lists(list(words)) or ["--help"])


def _show(message: Warning | str, *rest: object, **named: object) -> None:
    """Print an uncollected warning as a line for the user."""
    print_findings([message.finding]) if isinstance(message, FindingWarning) else note(str(message))


@cache
def _program() -> Any:
    """The commands with their options; parsing them takes longer than many commands."""
    return typer.main.get_command(app)


def _run(words: list[str]) -> int:
    try:
        if not words[0].startswith("-") and words[0] not in (names := [c.NAME for c in COMMANDS]):
            raise InputError(f"no such command; {nearest(words[0], names)}", where="command", value=words[0])
        status = _program().main(words, prog_name="mixedlub", standalone_mode=False)
        if status == CTRL_C:
            raise KeyboardInterrupt
        sys.stdout.flush()
        if not status:
            forget_traceback()
        return int(status or 0)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (Exception, KeyboardInterrupt) as error:
        message, status = _what_went_wrong(error, resume_hint(PARTIAL.get(words[0], "")))
        drop_empty_folders()
        fail(message)
        return status


def _what_went_wrong(error: BaseException, kept: str) -> tuple[str, int]:
    """Message and exit status for an error; ``kept``: text on the saved work."""
    if isinstance(error, InputError):
        return str(error), 2
    if isinstance(error, (KeyboardInterrupt, typer.Abort)):
        return f"stopped{kept}", CTRL_C
    if isinstance(error, RunError):
        return f"{error}{kept}", 1
    if isinstance(error, OSError) and is_full(error):
        left = kept or "; the same command starts anew"
        return f"the disk of {opened() or error.filename} is full{left} once there is room", 1
    if isinstance(error, OSError) and error.errno in UNUSABLE and error.filename is not None:
        return str(InputError(f"cannot be used ({error.strerror})", where="path", value=str(error.filename))), 2
    if hasattr(error, "format_message") and hasattr(error, "exit_code"):
        place = getattr(getattr(error, "ctx", None), "command_path", "mixedlub")
        return f"{of_option(error.format_message())} (see {place} --help)", int(error.exit_code)
    return f"unexpected {type(error).__name__}: {error}; {save_traceback(error)}", 1


def with_home(word: str) -> str:
    """A word with the home folder in place of a leading ``~``, also after the name of an option.

    >>> with_home("--out=~/gears") == "--out=" + os.path.expanduser("~/gears"), with_home("a~b")
    (True, 'a~b')
    """
    option, path = re.fullmatch(r"(--[\w-]+=)?(.*)", word, re.DOTALL).groups("")  # type: ignore[union-attr]
    return option + os.path.expanduser(path)


def spread_lists(words: list[str]) -> list[str]:
    """``--exclude a b`` as ``--exclude a --exclude b``: the option takes every word up to the next option.

    >>> spread_lists(["diagnose", "CASE", "--exclude", "windage", "churning", "--level", "0.05"])
    ['diagnose', 'CASE', '--exclude', 'windage', '--exclude', 'churning', '--level', '0.05']
    """
    found: list[str] = []
    listing = False
    for word in words:
        if listing and not word.startswith("-") and found[-1] != "--exclude" and not os.path.isdir(word):
            found += ["--exclude", word]
        else:
            found.append(word)
            listing = word == "--exclude" or (listing and not word.startswith("-") and not os.path.isdir(word))
    return found


if __name__ == "__main__":
    sys.exit(main())
