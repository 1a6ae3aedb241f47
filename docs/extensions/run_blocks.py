"""Blocks of a page that run while it is built: files, commands, Python, pictures. A block that fails breaks the build.

Each page has a copy of the examples and traces of its own; its blocks run there from top to bottom.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, ClassVar

import forked
from docutils import nodes
from docutils.parsers.rst import directives
from docutils.parsers.rst.directives.images import Figure
from sphinx.application import Sphinx
from sphinx.directives.code import CodeBlock
from sphinx.util.docutils import SphinxDirective
from sphinx.util.parallel import make_chunks

ROOT = Path(__file__).parents[2]
COPIED = ("examples", "profiles/traces")
FEW = 10
"""Blocks that load by themselves sooner than the whole package."""
LIMIT_S = 300
"""Seconds after which a block has hung: the slowest takes some ten on two cores."""


class _InPage:
    """What the blocks of one page share: the folder that they run in."""

    env: Any

    @property
    def folder(self) -> Path:
        base = Path(self.env.app.page_folders.name)
        folder = base / self.env.docname.replace("/", "-")
        if not folder.exists():
            for name in COPIED:
                shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", "build.py"))
        return folder

    @property
    def surroundings(self) -> dict[str, str]:
        """Environment of the commands: this Python's programs first, plain output of one width."""
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
        # The page's copy of profiles/traces must not hide the package: a whole package further on the path wins.
        packages = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")]).rstrip(os.pathsep)
        plain = {"COLUMNS": "88", "NO_COLOR": "1", "MPLBACKEND": "agg"}
        return {**os.environ, "PATH": path, "PYTHONPATH": packages, **plain}

    def start(self, script: str) -> subprocess.Popen[bytes]:
        """A script of the page started in the background, with a process group of its own."""
        log = (self.folder / f"{script}.log").open("wb")
        words = ["bash", "-c", f". ./{script}; wait"]
        return subprocess.Popen(
            words, cwd=self.folder, env=self.surroundings, stdout=log, stderr=log, start_new_session=True
        )

    def wait_for(self, script: str, text: str) -> None:
        """Until a script in the background has printed a text."""
        end = time.monotonic() + LIMIT_S
        while text not in (self.folder / f"{script}.log").read_text(encoding="utf-8") and time.monotonic() < end:
            time.sleep(0.1)

    def output(self, program: str, *, python: bool = False, status: int = 0) -> str:
        """Output of a program in the page's folder; RuntimeError where its exit status is another."""
        words = None if python else forked.words(program)
        if python:
            ended, output = self._forked(partial(forked.python, program))
        elif words is not None:
            ended, output = self._forked(partial(forked.command, words))
        else:
            ended, output = self._of_shell(program)
        if ended != status or "Exception ignored" in output:
            raise RuntimeError(f"{program!r} ended with status {ended}, not {status}:\n{output}")
        return output.rstrip()

    def _forked(self, act: Callable[[], int]) -> tuple[int, str]:
        return forked.run(act, self.folder, self.surroundings, LIMIT_S)

    def _of_shell(self, program: str) -> tuple[int, str]:
        found = subprocess.run(
            ["bash", "-c", program],
            cwd=self.folder,
            env=self.surroundings,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=LIMIT_S,
            check=False,
        )
        return found.returncode, found.stdout


def shortened(text: str, head: int | None, tail: int | None) -> str:
    """The first and the last lines of an output, with an ellipsis for those between.

    >>> shortened("a\\nb\\nc\\nd", 1, 1)
    'a\\n...\\nd'
    >>> shortened("a\\nb", 2, None), shortened("a\\nb", None, None)
    ('a\\nb', 'a\\nb')
    """
    lines = text.splitlines()
    first, last = head or 0, tail or 0
    if (head is None and tail is None) or len(lines) <= first + last:
        return text
    return "\n".join([*lines[:first], "...", *lines[len(lines) - last :]])


class Run(SphinxDirective, _InPage):
    """Commands of a shell (or one Python program) with what they print, cut to ``head`` and ``tail`` lines.

    ``quiet`` leaves out what they print; a ``hidden`` one shows nothing, and holds what the text around it says.
    ``wrap`` folds long lines. ``with`` names a script of the page that runs meanwhile, ``once`` it has
    printed a text.
    """

    has_content = True
    optional_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {
        "head": directives.nonnegative_int,
        "tail": directives.nonnegative_int,
        "status": directives.nonnegative_int,
        "quiet": directives.flag,
        "hidden": directives.flag,
        "wrap": directives.flag,
        "with": directives.unchanged_required,
        "once": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        shown: list[nodes.Node] = []
        python = bool(self.arguments) and self.arguments[0] == "python"
        whole = "\n".join(self.content)
        programs = [whole] if python else re.findall(r"^(?:.*\\\n)*.+$", whole, re.MULTILINE)
        meanwhile = self.start(self.options["with"]) if "with" in self.options else None
        if meanwhile is not None:
            self.wait_for(self.options["with"], self.options.get("once", ""))
        try:
            for program in programs:
                output = self.output(program, python=python, status=self.options.get("status", 0))
                output = shortened(output, self.options.get("head"), self.options.get("tail"))
                shown += (
                    [_literal(program, "python")]
                    if python
                    else [_literal("$ " + program.replace("\n", "\n> "), "console")]
                )
                if output and "quiet" not in self.options:
                    shown.append(_literal(output, "text", "output", *(["wrap"] if "wrap" in self.options else [])))
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            raise self.error(f"{self.env.docname}: {error}") from None
        finally:
            if meanwhile is not None:
                os.killpg(meanwhile.pid, signal.SIGKILL)
                meanwhile.wait()
        for node in shown:
            self.set_source_info(node)
        return [] if "hidden" in self.options else shown


def _literal(text: str, language: str, *classes: str) -> nodes.literal_block:
    return nodes.literal_block(text, text, language=language, classes=list(classes))


class File(CodeBlock, _InPage):
    """A file that the reader writes: shown under its name, and written for the blocks below."""

    required_arguments, optional_arguments = 1, 0
    LANGUAGES: ClassVar[dict[str, str]] = {".toml": "toml", ".py": "python", ".csv": "text", ".sh": "bash"}

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(self.content) + "\n", encoding="utf-8")
        self.arguments[0] = self.LANGUAGES[path.suffix]
        self.options["caption"] = name
        return super().run()


class Picture(Figure, _InPage):
    """A figure that a block above has drawn: the first that matches the pattern."""

    @property
    def env(self) -> Any:
        return self.state.document.settings.env

    def run(self) -> list[nodes.Node]:
        drawn = next(iter(sorted(self.folder.glob(self.arguments[0]))), None)
        if drawn is None:
            raise self.error(f"{self.env.docname}: no block above has drawn {self.arguments[0]}")
        made = Path(self.env.srcdir) / "made" / self.env.docname
        made.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(drawn, made / drawn.name)
        self.arguments[0] = f"/made/{self.env.docname}/{drawn.name}"
        return super().run()


def _open(app: Sphinx) -> None:
    # Sphinx declares no attributes of extensions.
    app.page_folders = TemporaryDirectory(prefix="pages-")  # type: ignore[attr-defined]


def _deal(app: Sphinx, env: Any, docnames: list[str]) -> None:
    """Deal the pages with most blocks out over the parts that are read at once; by name they would lie in one."""
    parts = len(make_chunks(docnames, app.parallel))
    blocks = {name: Path(env.doc2path(name)).read_text(encoding="utf-8").count("```{run}") for name in docnames}
    ordered = sorted(docnames, key=lambda name: -blocks[name])
    docnames[:] = [name for part in range(parts) for name in ordered[part::parts]]
    if sum(blocks.values()) > FEW:
        forked.load()


def _close(app: Sphinx, error: Exception | None) -> None:
    app.page_folders.cleanup()  # type: ignore[attr-defined]


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("run", Run)
    app.add_directive("file", File)
    app.add_directive("picture", Picture)
    app.connect("builder-inited", _open)
    app.connect("env-before-read-docs", _deal)
    app.connect("build-finished", _close)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
