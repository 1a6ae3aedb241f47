"""Page and REST of surfaces: dropped traces and maps, their parameters, curves, and the choice of cut-offs."""

from __future__ import annotations

import json
import shutil
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Body, File, Request, UploadFile
from fastapi.responses import Response

from mixedlub.app.desk import Desk, desk_of, see
from mixedlub.app.jobs import FAILED
from mixedlub.app.store import Item
from profiles.errors import InputError

PAGE = "surfaces"
RESULT = "result"
SETTINGS = {
    "form": ("Form to remove", "line", "none, mean, line, polynomial-N, circle, involute-MM"),
    "cutoff_mm": ("Long cut-off (mm)", "", "by ISO 4288"),
    "short_cutoff_um": ("Short cut-off (µm)", "", "by ISO 3274"),
    "method": ("Filter of the long cut-off", "gaussian", "gaussian, robust, spline"),
    "outliers": ("Mask points beyond (robust sigmas)", "", "none"),
    "convention": ("Parameters by", "", "the file's, else ISO 4287:1997"),
    "unit": ("Unit of plain numbers", "", "as the file says; or mm, um"),
    "spacing": ("Step of the heights", "", "as the file says; or 0.5 um"),
}
"""Options of `mixedlub profile` on the page: text, default, and the meaning of an empty input."""
CHOICES = {
    "method": ("gaussian", "robust", "spline"),
    "convention": ("", "ISO 4287:1997", "ISO 21920-2:2021", "NIST", "Mitutoyo"),
}
ROWS = (
    ("Ra", "parameters", "Ra_um", "µm"),
    ("Rq", "parameters", "Rq_um", "µm"),
    ("Rz", "parameters", "Rz_um", "µm"),
    ("Rt", "parameters", "Rt_um", "µm"),
    ("Rp", "parameters", "Rp_um", "µm"),
    ("Rv", "parameters", "Rv_um", "µm"),
    ("Rsk", "parameters", "Rsk", ""),
    ("Rku", "parameters", "Rku", ""),
    ("Rdq", "parameters", "Rdq", ""),
    ("Rk", "parameters", "Rk_um", "µm"),
    ("Rpk", "parameters", "Rpk_um", "µm"),
    ("Rvk", "parameters", "Rvk_um", "µm"),
    ("RSm", "parameters", "RSm_um", "µm"),
    ("m0", "moments", "m0_um2", "µm²"),
    ("m2", "moments", "m2", ""),
    ("m4", "moments", "m4_per_um2", "1/µm²"),
    ("long cut-off", "moments", "cutoff_mm", "mm"),
    ("short cut-off", "moments", "short_cutoff_um", "µm"),
    ("asperities", "asperities", "density_per_mm2", "1/mm²"),
    ("asperity radius", "asperities", "radius_um", "µm"),
    ("sigma of asperities", "asperities", "sigma_um", "µm"),
    ("Nayak alpha", "asperities", "nayak", ""),
)
"""Rows of the table of parameters: name, part and key of profile.json, unit."""
FIGURES = {
    "trace": "Trace",
    "probability": "Normal probability plot",
    "abbott": "Material ratio curve",
    "spectrum": "Spectrum",
}

Files = Annotated[list[UploadFile], File(description="Traces or height maps.")]
router = APIRouter()
pages = APIRouter(include_in_schema=False)


async def created(desk: Desk, files: list[UploadFile]) -> Item:
    """A new set of surfaces, with its evaluation started."""
    item = desk.store.create(PAGE, "surfaces")
    try:
        names = await desk.saved(item, files)
        more = f" and {len(names) - 1} more" if len(names) > 1 else ""
        item.update(name=names[0] + more, files=names, settings={}, error="")
        evaluate(desk, item, {})
    except BaseException:
        shutil.rmtree(item.folder, ignore_errors=True)
        raise
    return item


def evaluate(desk: Desk, item: Item, settings: dict[str, str]) -> dict[str, Any]:
    """Job of `mixedlub profile` with settings."""
    desk.refuse_open(item)
    given = {key: text.strip() for key, text in settings.items() if key in SETTINGS and text.strip()}
    item.update(settings=given, error="")
    options = [f"--{key.replace('_', '-')}={text}" for key, text in given.items()]
    files = [str(item.uploads / name) for name in item.record["files"]]
    return desk.jobs.start(
        item, ["profile", *files, *options, "--out", str(item.folder / RESULT), "--replace"], short=True
    )


def records(item: Item) -> list[dict[str, Any]]:
    """Content of `profile.json`; empty before the first result."""
    with suppress(OSError, ValueError):
        found: list[dict[str, Any]] = json.loads((item.folder / RESULT / "profile.json").read_text(encoding="utf-8"))
        return found
    return []


def consequences(path: Path, settings: dict[str, str]) -> list[dict[str, Any]]:
    """Roughness of a file at each standard long cut-off, and at the chosen one."""
    from roughness.over_cutoffs import over_cutoffs, trace_of

    how: dict[str, Any] = {key: settings[key] for key in ("form", "method", "convention") if key in settings}
    try:
        numbers = {key: float(settings[key]) for key in ("cutoff_mm", "short_cutoff_um", "outliers") if key in settings}
    except ValueError:
        return []
    if "short_cutoff_um" in numbers:
        how["short_cutoff"] = numbers["short_cutoff_um"] * 1e-6
    if "outliers" in numbers:
        how["outliers"] = numbers["outliers"]
    chosen = numbers["cutoff_mm"] * 1e-3 if "cutoff_mm" in numbers else None
    return list(over_cutoffs(trace_of(path, settings.get("unit"), settings.get("spacing")), chosen, **how))


async def _shown(desk: Desk, item: Item, error: str = "", status: int = 200) -> Response:
    found, job = records(item), desk.jobs.state(item)
    settings = item.record["settings"]
    over: list[dict[str, Any]] = []
    if found and job.get("state") not in ("waiting", "running"):
        with suppress(InputError):
            over = await desk.worker.call(consequences, Path(found[0]["file"]), settings)
    figures = item.folder / RESULT / "figures"
    names = sorted(path.name for path in figures.glob("*.svg")) if figures.is_dir() else []
    drawn = {title: [n for n in names if n.endswith(f"_{kind}.svg")] for kind, title in FIGURES.items()}
    return desk.page(
        "surface.html",
        status,
        item=desk.work(item),
        record=item.record,
        records=found,
        names=[Path(one["file"]).name for one in found],
        rows=ROWS,
        settings=SETTINGS,
        choices=CHOICES,
        figures=drawn,
        over=over,
        failed=job.get("state") == FAILED,
        error=error,
    )


@router.post("/surfaces", status_code=201, summary="Send traces or maps")
async def post(request: Request, files: Files) -> dict[str, Any]:
    """Send files and start `mixedlub profile`; returns the job."""
    desk = desk_of(request)
    item = await created(desk, files)
    return {"id": item.id, "job": desk.jobs.state(item)}


@router.get("/surfaces/{id}", summary="Parameters of surfaces")
async def get(request: Request, id: str) -> dict[str, Any]:
    """Content of `profile.json`, with the settings and the last job."""
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    return {**desk.work(item), "settings": item.record["settings"], "records": records(item)}


@router.get("/surfaces/{id}/cutoffs", summary="Consequences of the cut-off")
async def get_cutoffs(request: Request, id: str, number: int = 0) -> list[dict[str, Any]]:
    """Heights, moments and asperities of a file at each standard long cut-off."""
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    names = item.record["files"]
    if not 0 <= number < len(names):
        raise InputError("no such file", value=number)
    found: list[dict[str, Any]] = await desk.worker.call(
        consequences, item.uploads / names[number], item.record["settings"]
    )
    return found


@router.put("/surfaces/{id}/settings", status_code=202, summary="Choose filters and cut-offs")
async def put_settings(request: Request, id: str, settings: Annotated[dict[str, str], Body()]) -> dict[str, Any]:
    """Evaluate again with other options of `mixedlub profile`; returns the job."""
    desk = desk_of(request)
    return evaluate(desk, desk.store.find(PAGE, id), settings)


@pages.post("/surfaces")
async def drop(request: Request, files: Files) -> Response:
    desk = desk_of(request)
    try:
        return see(await created(desk, files))
    except InputError as error:
        return desk.page("home.html", 422, works=desk.works(), error=str(error), where=PAGE)


@pages.get("/surfaces/{id}")
async def show(request: Request, id: str) -> Response:
    desk = desk_of(request)
    return await _shown(desk, desk.store.find(PAGE, id))


@pages.post("/surfaces/{id}/settings")
async def choose(request: Request, id: str) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    sent = await request.form()
    try:
        evaluate(desk, item, {key: value for key, value in sent.items() if isinstance(value, str)})
    except InputError as error:
        return await _shown(desk, item, str(error), 422)
    return see(item)


@pages.post("/surfaces/{id}/more")
async def more(request: Request, id: str, files: Files) -> Response:
    desk = desk_of(request)
    item = desk.store.find(PAGE, id)
    try:
        desk.refuse_open(item)
        names = await desk.saved(item, files)
        item.update(files=list(dict.fromkeys([*item.record["files"], *names])))
        evaluate(desk, item, item.record["settings"])
    except InputError as error:
        return await _shown(desk, item, str(error), 422)
    return see(item)
