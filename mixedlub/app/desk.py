"""The parts that the pages share: store, jobs, worker, templates, and files handed out."""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from fastapi import Request, UploadFile
from fastapi.responses import FileResponse, HTMLResponse, RedirectResponse, Response
from jinja2 import Environment, PackageLoader, StrictUndefined
from starlette.concurrency import run_in_threadpool

from mixedlub.app.jobs import OPEN, Jobs
from mixedlub.app.security import RESULT
from mixedlub.app.store import MOST_FILES, PAGES, UPLOADS, Item, Store
from mixedlub.app.worker import Worker
from profiles.errors import InputError

SHOWN = {".svg": "image/svg+xml", ".html": "text/html", ".png": "image/png", ".json": "application/json"}
"""Types of files that the browser shows; other files are handed out to be saved."""
TEXTS = {".txt": "text/plain", ".toml": "text/plain", ".csv": "text/csv"}
ZIPPED = ("case", "answer", "answer/improved", "result", "earlier")
"""Folders of an item that are handed out as an archive."""


@dataclass(frozen=True)
class Desk:
    """Everything that a request needs."""

    store: Store
    jobs: Jobs
    worker: Worker
    templates: Environment

    def page(self, template: str, status: int = 200, **content: Any) -> HTMLResponse:
        """A page from its template."""
        text = self.templates.get_template(template).render(pages=PAGES, open_jobs=self.jobs.open(), **content)
        return HTMLResponse(text, status)

    def works(self, pages: Iterable[str] = tuple(PAGES)) -> list[dict[str, Any]]:
        """Items with the state of their last job, the newest first."""
        found = [self.work(item) for page in pages for item in self.store.items(page)]
        return sorted(found, key=lambda one: str(one["id"]), reverse=True)

    def work(self, item: Item) -> dict[str, Any]:
        """Item with the state of its last job."""
        record = item.record
        return {
            "page": item.page,
            "id": item.id,
            "name": record.get("name", item.id),
            "created": record.get("created", ""),
            "job": self.jobs.state(item),
        }

    def refuse_open(self, item: Item) -> None:
        """Raise an error while a job of the item runs."""
        if self.jobs.state(item).get("state") in OPEN:
            raise InputError("has a run that is not over; wait for its end or cancel it", where=item.record["name"])

    async def saved(self, item: Item, files: Iterable[UploadFile], folder: str = UPLOADS) -> list[str]:
        """Names of the files that were sent, now in the folder of the item."""
        sent: list[tuple[str, BinaryIO]] = [(one.filename or "", one.file) for one in files if one.filename]
        if not sent:
            raise InputError("no file was sent; drop one, or click to choose one")
        if len(sent) > MOST_FILES:
            raise InputError(f"{len(sent)} files at once are too many; send at most {MOST_FILES}")
        return await run_in_threadpool(item.save, sent, folder)


def desk_of(request: Request) -> Desk:
    """Desk of the server."""
    desk: Desk = request.app.state.desk
    return desk


def environment() -> Environment:
    """Templates of the pages; texts are escaped."""
    made = Environment(
        loader=PackageLoader("mixedlub.app", "pages"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["number"] = number
    made.filters["words"] = lambda text: str(text).replace("_", " ")
    return made


def number(value: Any, digits: int = 4) -> str:
    """Number for a table; a dash for none.

    >>> number(1234.5678), number(None), number("auto")
    ('1235', '-', 'auto')
    """
    return "-" if value is None else f"{value:.{digits}g}" if isinstance(value, int | float) else str(value)


def see(item: Item) -> RedirectResponse:
    """Redirection to the page of an item."""
    return RedirectResponse(f"/{item.page}/{item.id}", 303)


def handed_out(item: Item, path: str, download: bool) -> Response:
    """File of an item: shown in the browser, or saved; files that were sent are only saved."""
    found = item.file(path)
    kind = {**SHOWN, **TEXTS}.get(found.suffix, "application/octet-stream")
    if download or found.suffix not in SHOWN or found.is_relative_to(item.uploads):
        plain = kind if not found.is_relative_to(item.uploads) else "application/octet-stream"
        return FileResponse(found, media_type=plain, filename=found.name)
    return FileResponse(found, media_type=kind, headers={"content-security-policy": RESULT})


def archive(item: Item, folder: str) -> Response:
    """Folder of an item as a zip archive."""
    root = item.folder / folder
    if folder not in ZIPPED or not root.is_dir():
        raise InputError("no such folder", where=folder[:40])
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in sorted(_files(root)):
            packed.write(path, path.relative_to(root).as_posix())
    name = f"{Path(folder).name}.zip"
    return Response(
        content.getvalue(),
        media_type="application/zip",
        headers={"content-disposition": f'attachment; filename="{name}"'},
    )


def _files(root: Path) -> Iterator[Path]:
    """Files below a folder, without hidden ones and links."""
    for path in root.rglob("*"):
        hidden = any(part.startswith(".") for part in path.relative_to(root).parts)
        if path.is_file() and not path.is_symlink() and not hidden:
            yield path


def table_of(path: Path, rows: int) -> dict[str, Any] | None:
    """Header and first rows of a CSV file; None without the file."""
    if not path.is_file():
        return None
    with path.open(encoding="utf-8", newline="") as file:
        reader = csv.reader(file)
        header = next(reader, [])
        found = list(reader)
    return {"header": header, "rows": found[:rows], "count": len(found)}
