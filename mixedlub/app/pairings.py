"""Page and REST of pairings: gears, oil, surfaces and conditions; the study, its ranking and its map."""

from __future__ import annotations

import shutil
from typing import Annotated, Any

from fastapi import APIRouter, Body, Request
from fastapi.responses import Response
from starlette.datastructures import UploadFile

from mixedlub.app import study_form
from mixedlub.app.desk import Desk, desk_of, see
from mixedlub.app.jobs import DONE
from mixedlub.app.store import Item, read_record, write_record
from profiles.errors import InputError

PAGE = "pairings"
RESULT, RANKING, MAP, STUDY = "result", "ranking.json", "map.svg", "study.toml"
FIGURES = ("ranking", "ranking_probabilities", "saving_over_cost")
"""Figures of the study that the page shows beside the map."""

router = APIRouter()
pages = APIRouter(include_in_schema=False)


def run(desk: Desk, item: Item, study: dict[str, Any]) -> dict[str, Any]:
    """Write the study file and start `mixedlub study`."""
    desk.refuse_open(item)
    text = study_form.study_text(study)
    (item.folder / STUDY).write_text(text, encoding="utf-8")
    for name in (RANKING, MAP):
        (item.folder / name).unlink(missing_ok=True)
    item.update(name=str(study.get("title", "Pairings"))[:80], error="")
    words = ["study", str(item.folder / STUDY), "--out", str(item.folder / RESULT), "--replace", "--xlsx"]
    return desk.jobs.start(item, words)


async def ranking(desk: Desk, item: Item) -> list[dict[str, Any]]:
    """Ranking of the last result; empty before one."""
    if desk.jobs.state(item).get("state") != DONE or not (item.folder / RESULT / "ranking.parquet").is_file():
        return []
    if not (item.folder / RANKING).is_file():
        found = await desk.worker.call(study_form.ranked, item.folder / RESULT)
        (item.folder / MAP).write_text(found["map"], encoding="utf-8")
        write_record(item.folder / RANKING, {"rows": found["rows"]})
    rows: list[dict[str, Any]] = read_record(item.folder / RANKING).get("rows", [])
    return rows


async def _filled(desk: Desk, request: Request, item: Item) -> None:
    """Take the form into the item: files that are sent, and texts."""
    sent = await request.form()
    item.update(texts={key: value.strip() for key, value in sent.items() if isinstance(value, str)})
    files = [one for one in sent.getlist("files") if isinstance(one, UploadFile) and one.filename]
    if files:
        names = await desk.saved(item, files)  # type: ignore[arg-type]
        for name in names:
            try:
                kind = await desk.worker.call(study_form.kind_of_surface, item.uploads / name)
            except InputError:
                (item.uploads / name).unlink(missing_ok=True)
                raise
            texts = {**item.record["texts"], f"place.{name}": "both"}
            item.update(files={**item.record["files"], name: kind}, texts=texts)


async def _shown(desk: Desk, item: Item | None, texts: dict[str, str], error: str = "", status: int = 200) -> Response:
    rows = [] if item is None else await ranking(desk, item)
    return desk.page(
        "pairing.html",
        status,
        item=None if item is None else desk.work(item),
        texts=texts,
        files=[] if item is None else list(item.record["files"]),
        inputs=study_form.inputs(),
        presets=study_form.presets(),
        oils=study_form.oils(),
        shipped=study_form.SHIPPED,
        places=study_form.PLACES,
        ranking=rows,
        figures=[] if item is None else [f for f in FIGURES if (item.folder / RESULT / f"figures/{f}.svg").is_file()],
        has_page=item is not None and (item.folder / RESULT / "index.html").is_file(),
        error=error,
    )


@router.post("/pairings", status_code=201, summary="Run a study")
async def post(request: Request, study: Annotated[dict[str, Any], Body()]) -> dict[str, Any]:
    """Start `mixedlub study`; the body is a study file as JSON, with shipped traces or moments as surfaces."""
    desk = desk_of(request)
    item = desk.store.create(PAGE, "pairings", texts={}, files={}, error="")
    try:
        return {"id": item.id, "job": run(desk, item, study)}
    except BaseException:
        shutil.rmtree(item.folder, ignore_errors=True)
        raise


@router.get("/pairings/{id}", summary="Ranking of a study")
async def get(request: Request, id: str) -> dict[str, Any]:
    """Last job and ranking of a study."""
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    return {**desk.work(item), "ranking": await ranking(desk, item)}


@pages.get("/pairings")
async def new(request: Request) -> Response:
    return await _shown(desk_of(request), None, study_form.START)


@pages.post("/pairings")
async def start(request: Request) -> Response:
    desk = desk_of(request)
    item = desk.store.create(PAGE, "pairings", texts={}, files={}, error="")
    try:
        await _filled(desk, request, item)
        run(desk, item, study_form.study_of(item.record["texts"], item.record["files"]))
    except InputError as error:
        if item.record["files"]:
            return await _shown(desk, item, item.record["texts"], str(error), 422)
        texts = item.record["texts"]
        shutil.rmtree(item.folder, ignore_errors=True)
        return await _shown(desk, None, texts or study_form.START, str(error), 422)
    except BaseException:
        shutil.rmtree(item.folder, ignore_errors=True)
        raise
    return see(item)


@pages.get("/pairings/{id}")
async def show(request: Request, id: str) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    return await _shown(desk, item, item.record["texts"] or study_form.START)


@pages.post("/pairings/{id}")
async def again(request: Request, id: str) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    try:
        desk.refuse_open(item)
        await _filled(desk, request, item)
        run(desk, item, study_form.study_of(item.record["texts"], item.record["files"]))
    except InputError as error:
        return await _shown(desk, item, item.record["texts"], str(error), 422)
    return see(item)
