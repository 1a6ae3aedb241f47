"""The command `mixedlub`: its subcommands, its exit status, and what a user reads when something is wrong."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from typing import Annotated

# Before NumPy is loaded: matrices are small here, and threads of BLAS would wait on those of the batch engine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import typer

from mixedlub.commands import check, diagnose, effects, import_files, kinds, new, profile, prove, simulate, study
from mixedlub.commands.console import drop_empty_folders, forget_folder, note, save_traceback, say, tell, what_is_kept
from mixedlub.schema.findings import FindingWarning
from mixedlub.schema.messages import of_option
from profiles.errors import InputError, nearest

COMMANDS = (profile, study, simulate, diagnose, check, import_files, new, kinds, effects, prove)

GOING_ON = (study.NAME, prove.NAME)
"""Commands that keep what they did when they are stopped."""
CTRL_C = 130
"""Status that typer gives a command which Ctrl-C stopped, instead of the interruption."""

app = typer.Typer(add_completion=False, no_args_is_help=False, rich_markup_mode=None, pretty_exceptions_enable=False)


def _say_version(wanted: bool) -> None:
    if wanted:
        from mixedlub.version import installed_version

        say(f"mixedlub {installed_version()}")
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
    app.command(_module.NAME, epilog=f"Example: {_module.EXAMPLE}")(_module.command)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; 0 done, 2 bad input (one message, no traceback), 1 anything else."""
    forget_folder()
    with warnings.catch_warnings():
        # What numbers overflow while far-off parameters are tried is not for the user.
        warnings.simplefilter("ignore", RuntimeWarning)
        warnings.showwarning = _show
        return _run(spread_lists(list(sys.argv[1:] if arguments is None else arguments)))


def _show(message: Warning | str, *rest: object, **named: object) -> None:
    """What nobody collected, as a line for the user."""
    tell([message.finding]) if isinstance(message, FindingWarning) else note(str(message))


def _run(words: list[str]) -> int:
    try:
        if words and not words[0].startswith("-") and words[0] not in (names := [c.NAME for c in COMMANDS]):
            raise InputError(f"no such command; {nearest(words[0], names)}", where="command", value=words[0])
        status = typer.main.get_command(app).main(words, prog_name="mixedlub", standalone_mode=False)
        if status == CTRL_C:
            raise KeyboardInterrupt
        sys.stdout.flush()
        return int(status or 0)
    except InputError as error:
        drop_empty_folders()
        return _failed(str(error), 2)
    except (KeyboardInterrupt, typer.Abort):
        drop_empty_folders()
        return _failed("stopped" + what_is_kept(words[0] in GOING_ON if words else False), 1)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except Exception as error:
        if hasattr(error, "format_message") and hasattr(error, "exit_code"):
            place = getattr(getattr(error, "ctx", None), "command_path", "mixedlub")
            return _failed(f"{of_option(error.format_message())} (see {place} --help)", int(error.exit_code))
        return _failed(f"unexpected {type(error).__name__}: {error}; details in {save_traceback(error)}", 1)


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


def _failed(message: str, status: int) -> int:
    print("mixedlub: " + " ".join(message.split()), file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(main())
