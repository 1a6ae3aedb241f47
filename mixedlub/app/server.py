"""The server of the page: routes, errors in one sentence, and its start on this machine alone."""

from __future__ import annotations

import socket
import webbrowser
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from importlib.resources import files
from pathlib import Path
from typing import Any

import uvicorn
from fastapi import APIRouter, FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, RedirectResponse, Response
from starlette.exceptions import HTTPException

from mixedlub.app import pairings, recordings, surfaces
from mixedlub.app.desk import Desk, archive, desk_of, environment, handed_out, see
from mixedlub.app.jobs import Jobs
from mixedlub.app.security import Guard
from mixedlub.app.store import PAGES, Store
from mixedlub.app.worker import Worker
from mixedlub.commands.console import is_full
from mixedlub.running.version import installed_version
from profiles.errors import InputError

HOST = "127.0.0.1"
API = "/api"
STATIC = {"style.css": "text/css", "app.js": "text/javascript"}
ABOUT = """Every answer of the page as JSON. A run answers with a job: poll it until it is `done`, then fetch the
answer or its files. Errors are one sentence, in `error`."""

general = APIRouter()
pages = APIRouter(include_in_schema=False)


@general.get("/jobs", summary="Runs that wait or run")
async def jobs(request: Request) -> list[dict[str, Any]]:
    """All runs that wait or run."""
    return desk_of(request).jobs.open()


@general.get("/{page}", summary="All recordings, surfaces or pairings")
async def items(request: Request, page: str) -> list[dict[str, Any]]:
    """Items of a page with the state of their last run."""
    desk = desk_of(request)
    if page not in PAGES:
        raise InputError("no such page", value=page[:40])
    return desk.works([page])


@general.get("/{page}/{id}/job", summary="State of the last run")
async def job(request: Request, page: str, id: str) -> dict[str, Any]:
    """State, progress and message of the last run of an item."""
    desk = desk_of(request)
    return desk.jobs.state(desk.store.find(page, id))


@general.delete("/{page}/{id}/job", summary="Cancel the run")
def cancel_job(request: Request, page: str, id: str) -> dict[str, Any]:
    """End the run of an item; earlier results are kept."""
    desk = desk_of(request)
    return desk.jobs.cancel(desk.store.find(page, id))


@general.get("/{page}/{id}/files/{path:path}", summary="A file")
def file(request: Request, page: str, id: str, path: str, download: bool = False) -> Response:
    """File of an item, as the commands write it."""
    return handed_out(desk_of(request).store.find(page, id), path, download)


@general.get("/{page}/{id}/zip/{folder:path}", summary="A folder as an archive")
def zipped(request: Request, page: str, id: str, folder: str) -> Response:
    """Folder `case`, `answer`, `answer/improved`, `earlier` or `result` as an archive."""
    return archive(desk_of(request).store.find(page, id), folder)


@pages.get("/")
async def home(request: Request) -> Response:
    desk = desk_of(request)
    return desk.page("home.html", works=desk.works(), error="", where="")


@pages.get("/docs")
async def docs(request: Request) -> Response:
    app: FastAPI = request.app
    return desk_of(request).page("docs.html", schema=app.openapi())


@pages.get("/static/{name}")
async def static(name: str) -> Response:
    if name not in STATIC:
        raise InputError("no such file", value=name[:40])
    text = files("mixedlub.app").joinpath("pages", name).read_text(encoding="utf-8")
    return Response(text, media_type=STATIC[name])


@pages.post("/{page}/{id}/cancel")
def cancel(request: Request, page: str, id: str) -> Response:
    desk = desk_of(request)
    item = desk.store.find(page, id)
    desk.jobs.cancel(item)
    return see(item)


@pages.post("/{page}/{id}/remove")
def remove(request: Request, page: str, id: str) -> Response:
    desk = desk_of(request)
    item = desk.store.find(page, id)
    desk.refuse_open(item)
    desk.store.remove(item)
    return RedirectResponse("/", 303)


def application(desk: Desk, hosts: list[str]) -> FastAPI:
    """The server with all routes, for the given values of the header Host."""

    @asynccontextmanager
    async def living(app: FastAPI) -> AsyncIterator[None]:
        yield
        desk.jobs.close()
        desk.worker.close()
        desk.store.release()

    app = FastAPI(
        title="mixedlub",
        version=installed_version(),
        description=ABOUT,
        docs_url=None,
        redoc_url=None,
        openapi_url=f"{API}/openapi.json",
        lifespan=living,
    )
    app.state.desk = desk
    for made in (recordings, surfaces, pairings):
        app.include_router(made.router, prefix=API, tags=[made.PAGE])
        app.include_router(made.pages)
    app.include_router(general, prefix=API, tags=["runs and files"])
    app.include_router(pages)
    app.add_middleware(Guard, hosts=hosts)
    app.add_exception_handler(InputError, _of_input)
    app.add_exception_handler(HTTPException, _of_request)
    app.add_exception_handler(RequestValidationError, _of_form)
    app.add_exception_handler(OSError, _of_system)
    app.add_exception_handler(Exception, _unexpected)
    return app


def _answer(request: Request, status: int, sentence: str) -> Response:
    """One sentence, as JSON or as a page."""
    if request.url.path.startswith(API):
        return JSONResponse({"error": sentence}, status)
    return desk_of(request).page("problem.html", status, sentence=sentence)


def _of_input(request: Request, error: Exception) -> Response:
    return _answer(request, 404 if "no such" in str(error) else 422, str(error))


def _of_request(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    sentence = "There is no such page." if error.status_code == 404 else f"{error.detail}."
    return _answer(request, error.status_code, sentence)


def _of_form(request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)
    first = error.errors()[0]
    place = ".".join(str(part) for part in first["loc"][1:])
    return _answer(request, 422, f"{place}: {first['msg'].lower()}")


def _of_system(request: Request, error: Exception) -> Response:
    assert isinstance(error, OSError)
    folder = desk_of(request).store.folder
    if is_full(error):
        return _answer(request, 507, f"the disk of {folder} is full; make room and send it again")
    return _answer(request, 500, f"{error.filename or folder}: cannot be used ({error.strerror})")


def _unexpected(request: Request, error: Exception) -> Response:
    return _answer(request, 500, f"unexpected {type(error).__name__}: {error}")


def desk(folder: Path) -> Desk:
    """Desk on a folder, which is claimed."""
    store = Store(folder)
    store.claim()
    templates = environment()
    return Desk(store, Jobs(store), Worker(), templates)


def hosts_of(port: int) -> list[str]:
    """Values of the header Host by which a browser calls the page; it leaves port 80 out.

    >>> hosts_of(8765)
    ['127.0.0.1:8765', 'localhost:8765']
    """
    names = [HOST, "localhost"]
    return [f"{name}:{port}" for name in names] + (names if port == 80 else [])


def serve(folder: Path, port: int, browser: bool, say: Callable[[str], None]) -> None:
    """Serve the page on this machine until Ctrl-C."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, port))
            listening.listen()
        except OSError as error:
            rule = f"cannot be used ({error.strerror}); name another port, or 0 for a free one"
            raise InputError(rule, where="--port", value=port) from None
        port = listening.getsockname()[1]
        app = application(desk(folder), hosts_of(port))
        address = f"http://{HOST}:{port}/"
        say(f"{address}  (work in {folder}; Ctrl-C ends the page)")
        if browser:
            webbrowser.open(address)
        quiet: dict[str, Any] = {"log_level": "error", "access_log": False, "server_header": False}
        uvicorn.Server(uvicorn.Config(app, timeout_graceful_shutdown=3, **quiet)).run([listening])
