"""Page and REST of a recording: dropped file, questions, diagnosis, downloads, added readings."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Body, File, Request, UploadFile
from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from mixedlub.app import reading
from mixedlub.app.desk import Desk, desk_of, see, table_of
from mixedlub.app.store import Item, read_record, write_record
from mixedlub.importers.base import flat
from mixedlub.schema.toml_file import read_toml
from profiles.errors import InputError

PAGE = "recordings"
DRAFT, PLOT, ANSWER, EARLIER = "draft.json", "plot.svg", "answer", "earlier"
SHOWN_TESTS = 12
"""Judgement. Rows of the next tests on the page."""
TITLES = {
    "gears": "Gears",
    "contact": "Contact",
    "lubricant": "Oil",
    "recording": "Recording",
    "recording.noise": "Scatter of the readings",
    "uncertainty": "What calibration may move: one standard deviation each",
    "import": "Import",
    "case": "Case",
}
"""Headings of the groups of questions, by the table of system.toml."""
Files = Annotated[list[UploadFile], File(description="The files of the instrument; a system.toml and traces too.")]

router = APIRouter()
pages = APIRouter(include_in_schema=False)


async def created(desk: Desk, files: list[UploadFile]) -> Item:
    """A new recording; nothing is kept of files that cannot be read."""
    item = desk.store.create(PAGE, "recording")
    try:
        names = await desk.saved(item, files)
        item.update(**_sorted(item, names), texts={}, asked={}, over="")
        item.update(name=Path(item.record["files"][0]).name)
        await drafted(desk, item)
    except BaseException:
        shutil.rmtree(item.folder, ignore_errors=True)
        raise
    return item


def _sorted(item: Item, names: list[str]) -> dict[str, list[str]]:
    """Names of the recorded files, of answers in TOML, and of files that these answers name."""
    answers = [name for name in names if name.lower().endswith(".toml")]
    values = [value for name in answers for value in flat(read_toml(item.uploads / name)).values()]
    named = {str(one) for value in values for one in (value if isinstance(value, list) else [value])}
    files = [name for name in names if name not in answers and name not in named]
    if not files:
        raise InputError("no recording is among the files; send the table of readings too")
    return {"files": files, "answers": answers, "attached": sorted(named & set(names))}


def _inputs(item: Item) -> tuple[list[Path], list[Path], dict[str, str], dict[str, str]]:
    """Recorded files, files with answers, typed answers, and examples of their form."""
    record = item.record
    files, answers = ([item.uploads / name for name in record[key]] for key in ("files", "answers"))
    return files, answers, record["texts"], {key: one["type"] for key, one in record["asked"].items()}


async def drafted(desk: Desk, item: Item) -> dict[str, Any]:
    """Draft of the recording, written beside it for its page."""
    found: dict[str, Any] = await desk.worker.call(reading.preview, *_inputs(item), item.record["over"])
    plot = found.pop("plot")
    (item.folder / PLOT).write_text(plot or "<svg xmlns='http://www.w3.org/2000/svg'/>", encoding="utf-8")
    asked = {**item.record["asked"], **{one["key"]: one for one in found["fields"]}}
    shown = {one["key"] for one in found["fields"]}
    # An answered question is asked no more, and stays in the form, so that the answer can be changed.
    kept = [{**asked[key], "value": text} for key, text in item.record["texts"].items() if key in asked]
    found["fields"] = [*(one for one in kept if one["key"] not in shown), *found["fields"]]
    item.update(asked=asked, error="")
    write_record(item.folder / DRAFT, found)
    return found


async def answered(desk: Desk, item: Item, texts: dict[str, str], over: str | None = None) -> dict[str, Any]:
    """Draft with further answers; an empty text takes an answer back."""
    desk.refuse_open(item)
    record = item.record
    given = {key: text.strip() for key, text in texts.items() if key in record["asked"]}
    kind = given.get(reading.KIND, "")
    kept = record["texts"]
    if kind and kind != read_record(item.folder / DRAFT).get("kind"):
        # Answers for another kind of recording do not fit.
        kept, given = {}, {reading.KIND: kind}
    merged = {key: text for key, text in {**kept, **given}.items() if text}
    offered = {key: one["value"] for key, one in record["asked"].items() if one["offered"]}
    merged = {key: text for key, text in merged.items() if offered.get(key) != text or key in kept}
    before = record["texts"], record["over"]
    item.update(texts=merged, over=record["over"] if over is None else over)
    try:
        return await drafted(desk, item)
    except InputError:
        item.update(texts=before[0], over=before[1])
        raise


async def diagnosed(desk: Desk, item: Item) -> dict[str, Any]:
    """Job of the diagnosis, after the case is written."""
    desk.refuse_open(item)
    case = item.folder / "case" / _slug(item)
    shutil.rmtree(case.parent, ignore_errors=True)
    await desk.worker.call(reading.write, *_inputs(item), case)
    draft = read_record(item.folder / DRAFT)
    if draft["blocking"]:
        raise InputError(f"needed before the diagnosis: {'; '.join(draft['blocking'])}", where=item.record["name"])
    item.update(error="", added=[])
    shutil.rmtree(item.folder / EARLIER, ignore_errors=True)
    return desk.jobs.start(item, ["diagnose", str(case), "--out", str(item.folder / ANSWER), "--replace"])


async def added(desk: Desk, item: Item, file: UploadFile) -> dict[str, Any]:
    """Job of a diagnosis that goes on with added readings; the earlier answer is kept beside the new one."""
    desk.refuse_open(item)
    if not (item.folder / ANSWER / "diagnosis.json").is_file():
        raise InputError("has no answer to go on from; diagnose it first", where=item.record["name"])
    number = len(item.record.get("added", [])) + 1
    folder = f"added/{number}"
    shutil.rmtree(item.folder / folder, ignore_errors=True)
    (item.folder / "added").mkdir(exist_ok=True)
    (name,) = await desk.saved(item, [file], folder)
    aside = item.folder / EARLIER
    shutil.rmtree(aside, ignore_errors=True)
    await run_in_threadpool(shutil.copytree, item.folder / ANSWER, aside)
    case = item.folder / "case" / _slug(item)
    words = ["diagnose", str(case), "--out", str(item.folder / ANSWER), "--add", str(item.folder / folder / name)]
    return desk.jobs.start(item, words, ended=lambda: item.update(added=[*item.record.get("added", []), name]))


def answer(item: Item) -> dict[str, Any] | None:
    """Content of `diagnosis.json`; None before the first answer."""
    return read_record(item.folder / ANSWER / "diagnosis.json") or None


def headline(folder: Path) -> str:
    """First sentences of a report."""
    try:
        text = (folder / "report.txt").read_text(encoding="utf-8")
    except OSError:
        return ""
    found = re.search(r"^ANSWER\n(.*?)(?:\n\s*\n|\Z)", text, re.DOTALL | re.MULTILINE)
    return " ".join(found[1].split()) if found else ""


def _slug(item: Item) -> str:
    """Name of the case: name of the file without its ending, in plain characters."""
    stem = item.record["name"].removesuffix(".gz").rpartition(".")[0] or item.record["name"]
    return re.sub(r"[^\w-]+", "_", stem).strip("_")[:60] or "recording"


def _shown(desk: Desk, item: Item, error: str = "", status: int = 200) -> Response:
    draft = read_record(item.folder / DRAFT)
    found = answer(item)
    ranked = sorted(found["probabilities"].items(), key=lambda one: -one[1])[:6] if found else []
    return desk.page(
        "recording.html",
        status,
        item=desk.work(item),
        record=item.record,
        draft=draft,
        groups=_grouped(draft.get("fields", [])),
        titles=TITLES,
        error=error or item.record.get("error", ""),
        answer=found,
        ranked=ranked,
        headline=headline(item.folder / ANSWER),
        before=headline(item.folder / EARLIER),
        campaign=read_record(item.folder / ANSWER / "campaign.json") or None,
        improved=(item.folder / ANSWER / "improved" / "system.toml").is_file(),
        tests=table_of(item.folder / ANSWER / "next_tests.csv", SHOWN_TESTS),
    )


def _grouped(fields: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Inputs by their group; taken and needed ones come first."""
    groups: dict[str, list[dict[str, Any]]] = {"offered": [], "needed": []}
    for one in fields:
        groups.setdefault("offered" if one["offered"] else one["group"], []).append(one)
    return groups


@router.post("/recordings", status_code=201, summary="Send a recording")
async def post(request: Request, files: Files) -> dict[str, Any]:
    """Send instrument files; the answer has the draft with its open questions."""
    item = await created(desk_of(request), files)
    return {"id": item.id, "draft": read_record(item.folder / DRAFT)}


@router.get("/recordings/{id}", summary="A recording")
async def get(request: Request, id: str) -> dict[str, Any]:
    """Draft, last job and answer of a recording."""
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    return {**desk.work(item), "draft": read_record(item.folder / DRAFT), "answer": answer(item)}


@router.put("/recordings/{id}/answers", summary="Answer questions")
async def put_answers(request: Request, id: str, answers: Annotated[dict[str, str], Body()]) -> dict[str, Any]:
    """Answer questions of the importer, by key of system.toml and value in TOML; returns the draft."""
    desk = desk_of(request)
    return await answered(desk, desk.store.find(PAGE, id), answers)


@router.post("/recordings/{id}/diagnosis", status_code=202, summary="Diagnose")
async def post_diagnosis(request: Request, id: str) -> dict[str, Any]:
    """Write the case and start `mixedlub diagnose`; returns the job."""
    desk = desk_of(request)
    return await diagnosed(desk, desk.store.find(PAGE, id))


@router.get("/recordings/{id}/answer", summary="The answer")
async def get_answer(request: Request, id: str) -> dict[str, Any]:
    """Content of `diagnosis.json`."""
    found = answer(desk_of(request).store.find(PAGE, id))
    if found is None:
        raise InputError("no such answer yet; start the diagnosis", value=id)
    return found


@router.post("/recordings/{id}/readings", status_code=202, summary="Add readings")
async def post_readings(request: Request, id: str, file: UploadFile) -> dict[str, Any]:
    """Add a filled-in next_tests.csv and diagnose again with `mixedlub diagnose --add`; returns the job."""
    desk = desk_of(request)
    return await added(desk, desk.store.find(PAGE, id), file)


@pages.post("/recordings")
async def drop(request: Request, files: Files) -> Response:
    desk = desk_of(request)
    try:
        return see(await created(desk, files))
    except InputError as error:
        return desk.page("home.html", 422, works=desk.works(), error=str(error), where=PAGE)


@pages.get("/recordings/{id}")
async def show(request: Request, id: str) -> Response:
    desk = desk_of(request)
    return _shown(desk, desk.store.find(PAGE, id))


@pages.post("/recordings/{id}/answers")
async def answers(request: Request, id: str) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    sent = await request.form()
    texts = {key: value for key, value in sent.items() if isinstance(value, str)}
    try:
        draft = await answered(desk, item, texts, texts.get("over"))
        if texts.get("do") == "diagnose":
            if draft["open"]:
                raise InputError(f"still to be answered: {_open(draft)}")
            await diagnosed(desk, item)
    except InputError as error:
        return _shown(desk, item, str(error), 422)
    return see(item)


def _open(draft: dict[str, Any]) -> str:
    """The open questions in words."""
    texts = {one["key"]: one["text"] for one in draft["fields"]}
    return "; ".join(texts[key] for key in draft["open"])


@pages.post("/recordings/{id}/attached")
async def attach(request: Request, id: str, files: Files) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    try:
        names = await desk.saved(item, files)
        item.update(attached=sorted({*item.record["attached"], *names}))
    except InputError as error:
        return _shown(desk, item, str(error), 422)
    return see(item)


@pages.post("/recordings/{id}/readings")
async def readings(request: Request, id: str, file: Annotated[UploadFile | None, File()] = None) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    try:
        if file is None:
            raise InputError("no file was sent; choose the filled-in next_tests.csv")
        await added(desk, item, file)
    except InputError as error:
        return _shown(desk, item, str(error), 422)
    return see(item)
