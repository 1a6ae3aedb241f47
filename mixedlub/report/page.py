"""The page of a study: one self-contained HTML file; the figures are also written as files."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.report.cutoff_table import cutoff_rows
from mixedlub.report.figures import Drawn, band_words, figures
from mixedlub.report.html import PAGE as HTML
from mixedlub.report.html import drawn_all, rendered, shown, start_of
from mixedlub.report.interactive import EMBEDDING, PLACE, explorer
from mixedlub.report.laws import laws_used
from mixedlub.report.paper_figures import paper_figures
from mixedlub.report.ranking import ranking_drawn
from mixedlub.report.surfaces import (
    height_notes,
    judgement,
    not_gaussian,
    provenance,
    surface_figures,
    surface_rows,
    traced,
)
from mixedlub.schema.findings import Finding, grouped
from mixedlub.schema.section import FileTable, Key, table
from mixedlub.study import counted, factors
from mixedlub.study.checkpoint import fingerprint
from mixedlub.study.columns import OF_VALIDITY
from mixedlub.study.fits import FEWEST_PAIRINGS, over_roughness
from mixedlub.study.options import ignored
from mixedlub.study.plan import Study
from mixedlub.study.rank import ranking_tables
from mixedlub.study.record import assumed, resolved
from mixedlub.study.results import Results, versions
from mixedlub.study.schema import Options, StudyFile

if TYPE_CHECKING:
    import pandas as pd

MOST_SURFACES = 12
MOST_RANKED = 60
"""Largest number of rows of the ranking on the page."""


def write_page(
    results: Results,
    folder: Path,
    notes: Sequence[Finding],
    *,
    given: str = "",
    formats: Sequence[str] = ("svg",),
    as_in_paper: bool = False,
    ranked: Mapping[str, pd.DataFrame] | None = None,
    doing: Callable[[str], None] = lambda text: None,
) -> list[Finding]:
    """Write ``index.html`` and ``figures/`` into a folder; return the findings on the heights of the traces.

    ``given``: study file as text. ``as_in_paper``: add files of the figures in the style of the paper. ``ranked``:
    tables of the ranking, if they are known. ``doing``: called with the next step.
    """
    drawings = folder / "figures"
    drawings.mkdir()
    study = results.study
    profiles = traced(study)
    judged = judgement(profiles)
    ranked = ranking_tables(results) if ranked is None else ranked
    drawn = [*ranking_drawn(ranked), *surface_figures(study, profiles, judged), *figures(results)]
    printed = list(paper_figures(results)) if as_in_paper else []
    svgs, (chart,) = drawn_all([*drawn, *printed], drawings, formats, doing, partial(_chart, results))
    files_of = [{"file": f"{one.name}.{formats[0]}", "caption": one.caption} for one in printed]
    normal = study.plan.options.heights == "gaussian"
    of_heights = [*(not_gaussian(judged) if normal else []), *height_notes(profiles, judged, normal)]
    texts = {"notes": grouped([*notes, *of_heights]), "provenance": provenance(study)}
    texts["given"] = start_of(given, "study.toml")
    embedded = {"chart": chart, "place": PLACE, "embedding": {**EMBEDDING, "downloadFileName": study.name}}
    parts = {"figures": shown(drawn, svgs), "printed": files_of, "ranking": ranking_rows(ranked)}
    page = rendered("template.html", **content(results), **texts, **embedded, **parts)
    (folder / HTML).write_text(page, encoding="utf-8")
    return of_heights


def ranking_rows(ranked: Mapping[str, pd.DataFrame]) -> dict[str, Any] | None:
    """Ranking on the page, the best first: tables of loss and of cost; None for one pairing."""
    table = ranked["ranking"]
    if len(table) < 2:
        return None
    records: list[Any] = table.head(MOST_RANKED).to_dict("records")
    good = table["as_good_as_best"].eq("yes") if "as_good_as_best" in table else table["place"] == 1
    shown = []
    for heads in (OF_LOSS, OF_COST):
        chosen = {head: write for head, (needs, write) in heads.items() if needs in table}
        rows = [[write(row) for write in chosen.values()] for row in records]
        shown.append({"heads": list(chosen), "rows": list(zip(good, rows))})
    uncertain, costs = "place_low90" in table, "relative_cost" in table
    return {
        "tables": shown if costs else shown[:1],
        "uncertain": uncertain,
        "rows": len(records),
        "count": len(table),
        "good": int(good.sum()),
    }


Written = tuple[str, Callable[[Mapping[str, Any]], str]]
"""Column of the ranking that a head of the page needs, and the text of a row."""
OF_PAIRING: Mapping[str, Written] = {
    "place": ("place", lambda row: str(row["place"])),
    "pinion / gear": ("place", lambda row: f"{row['pinion_surface']} / {row['gear_surface']}"),
}
OF_LOSS: Mapping[str, Written] = {
    **OF_PAIRING,
    "mean loss (W)": ("place", lambda row: f"{row['mean_loss_W']:.4g}"),
    "90 % interval (W)": ("mean_loss_W_low90", lambda row: span(row, "mean_loss_W", ".4g")),
    "over first (%)": ("place", lambda row: f"{row['over_best_percent']:.1f}"),
    "places (90 %)": ("place_low90", lambda row: span(row, "place", ".0f")),
    "P(best)": ("best_probability", lambda row: f"{row['best_probability']:.2f}"),
    "P(less than first)": (
        "less_than_first_probability",
        lambda row: "" if row["place"] == 1 else f"{row['less_than_first_probability']:.2f}",
    ),
    "as good as the best": ("as_good_as_best", lambda row: row["as_good_as_best"]),
}
OF_COST: Mapping[str, Written] = {
    **OF_PAIRING,
    "relative cost": ("relative_cost", lambda row: f"{row['relative_cost']:g}"),
    "loss saved over the cheapest (%)": ("saving_percent", lambda row: f"{row['saving_percent']:.1f}"),
    "90 % interval (%)": ("saving_percent_low90", lambda row: span(row, "saving_percent", ".1f")),
    "efficient": ("efficient", lambda row: row["efficient"]),
    "P(efficient)": ("efficient_probability", lambda row: f"{row['efficient_probability']:.2f}"),
}


def span(row: Mapping[str, Any], name: str, form: str) -> str:
    """Ends of a 90 % interval in a row.

    >>> span({"place_low90": 1, "place_high90": 3}, "place", ".0f")
    '1 to 3'
    """
    low, high = (format(row[f"{name}_{end}90"], form) for end in ("low", "high"))
    return low if low == high else f"{low} to {high}"


def _chart(results: Results) -> Any:
    """Interactive chart; a process terminated meanwhile prints no foreign stack trace."""
    if multiprocessing.parent_process() is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    return explorer(results)


def content(results: Results) -> dict[str, Any]:
    """Content of the page that depends only on the results."""
    study = results.study
    file = study.file
    return {
        "title": file.title,
        "description": file.description,
        "study": study,
        "factors": factors(study),
        "counted": counted,
        "file": file,
        "levels": file.conditions,
        "findings": findings(results),
        "roughness_table": roughness_table(results),
        "loss_table": loss_table(results),
        "surfaces": surface_rows(study),
        "cutoffs": cutoff_rows(results),
        "band": band_words(results),
        "gears": input_rows(study, "gears"),
        "geometry": geometry_rows(study),
        "lubricant": input_rows(study, "lubricant"),
        "oil": oil_rows(results),
        "options": option_rows(file.options, ignored(file.options, study.plan.model())),
        "effects": [(e, study.plan.parameters[e.id]) for e in study.effects],
        "laws": list(laws_used(study.plan.model())),
        "definitions": [(c.name, c.unit, c.meaning) for c in (*results.columns, OF_VALIDITY)],
        "fingerprint": fingerprint(study.plan),
        "versions": ", ".join(f"{name} {version}" for name, version in versions().items()),
    }


def findings(results: Results) -> list[str]:
    """The result in a few sentences."""
    study, levels = results.study, results.study.file.conditions
    loss, ratio, lam = results["power_loss"], results["area_ratio"], results["film_parameter"]
    friction = results["mean_friction"]

    def where(index: int) -> str:
        p, o, t, s = np.unravel_index(index, loss.shape)
        return (
            f"{' / '.join(study.pairings[p])} at {levels.torque_Nm[t]:g} N m, {levels.speed_rpm[s]:g} rpm, "
            f"oil at {levels.oil_temperature_C[o]:g} °C"
        )

    hardest = tuple(i - 1 for i in loss.shape[2:])
    column = loss[:, 0, hardest[0], hardest[1]]
    best, worst = int(column.argmin()), int(column.argmax())
    sentences = [
        f"The largest power loss is {loss.max():.4g} W, of {where(int(loss.argmax()))}; the smallest is "
        f"{loss.min():.4g} W, of {where(int(loss.argmin()))}.",
        f"Mean friction lies between {friction.min():.3f} and {friction.max():.3f}, the boundary "
        f"area ratio between {ratio.min():.2g} and {ratio.max():.2g}, the film parameter between "
        f"{lam.min():.2g} and {lam.max():.2g}.",
    ]
    if best != worst:
        sentences.append(
            f"At {levels.torque_Nm[hardest[0]]:g} N m, {levels.speed_rpm[hardest[1]]:g} rpm and oil at "
            f"{levels.oil_temperature_C[0]:g} °C, "
            f"{' / '.join(study.pairings[best])} loses {100 * (1 - column[best] / column[worst]):.0f} % less than "
            f"{' / '.join(study.pairings[worst])}."
        )
    further = (_shared(results), _linear(results, where), _left_above_one(results))
    sentences += [text for text in further if text]
    quiet = (ratio < 1e-3).any(axis=(1, 2, 3))
    if quiet.any() and not quiet.all():
        names = [" / ".join(study.pairings[i]) for i in np.flatnonzero(quiet)[:6]]
        more = "" if quiet.sum() <= 6 else f" and {int(quiet.sum()) - 6} more"
        sentences.append(
            f"Practically free of asperity contact (area ratio below 0.001) somewhere: {', '.join(names)}{more}."
        )
    return sentences


def _shared(results: Results) -> str:
    """Sentence on the load sharing of film and asperities; empty if the film formula sets the gap."""
    if not results.study.plan.balanced:
        return ""
    share, thicker = results["mean_asperity_load_share"], results["film_over_unbalanced"]
    return (
        f"Of the load, asperities carry between {share.min():.2g} and {share.max():.3g}, mean over the path; "
        f"the film is {thicker.min():.3g} to {thicker.max():.3g} times as thick as one that carries all of it."
    )


def _linear(results: Results, where: Callable[[int], str]) -> str:
    """Sentence on the fit of the line over composite roughness; empty if any pairings would fit."""
    fits = over_roughness(results).square
    if len(results.study.pairings) < FEWEST_PAIRINGS or not np.isfinite(fits).all():
        return ""
    worst = where(int(fits.argmin())).partition(" at ")[2]
    return (
        f"A straight line of loss over composite roughness has R² of {fits.min():.3f} to {fits.max():.3f} at single "
        f"conditions, the least at {worst}."
    )


def _left_above_one(results: Results) -> str:
    """Sentence on the share of the loss difference between pairings remaining above film parameter 1, by speed."""
    loss = np.where(results["film_parameter"] >= 1.0, results["power_loss"], -np.inf).max(axis=0)
    least, most = (edge(results["power_loss"], axis=0) for edge in (np.min, np.max))
    with np.errstate(invalid="ignore", divide="ignore"):
        left = (loss - least) / (most - least)
    told = [
        f"{100 * by_speed[by_speed >= 0].mean():.0f} % at {rpm:g} rpm"
        for by_speed, rpm in zip(np.moveaxis(left, -1, 0), results.study.file.conditions.speed_rpm)
        if (by_speed >= 0).any()
    ]
    if len(results.study.pairings) < FEWEST_PAIRINGS or not 0 < len(told) <= MOST_SURFACES:
        return ""
    return (
        "Of the loss between the roughest and the smoothest pairing there is left above a film parameter of 1, mean "
        f"over torques and oil temperatures: {', '.join(told)}."
    )


def _triangle(results: Results, values: np.ndarray, form: str) -> dict[str, Any] | None:
    """Values of the pairings as a table of pinion against gear surface; None if too wide."""
    pinions = list(dict.fromkeys(a for a, _ in results.study.pairings))
    gears = list(dict.fromkeys(b for _, b in results.study.pairings))
    if max(len(pinions), len(gears)) > MOST_SURFACES:
        return None
    cells = {both: format(v, form) for both, v in zip(results.study.pairings, values)}
    return {"gears": gears, "rows": [(a, [cells.get((a, b), "") for b in gears]) for a in pinions]}


def roughness_table(results: Results) -> dict[str, Any] | None:
    """Composite roughness of each pairing (um)."""
    return _triangle(results, results["composite_roughness"][:, 0, 0, 0] * 1e6, ".3f")


def loss_table(results: Results) -> dict[str, Any] | None:
    """Power loss of each pairing at the last torque and speed (W)."""
    return _triangle(results, results["power_loss"][:, 0, -1, -1], ".1f")


def oil_rows(results: Results) -> list[tuple[str, str, str, str]]:
    """Temperature, viscosity, pressure-viscosity and Eyring stress at the study's oil temperatures."""
    levels = results.study.file.conditions.oil_temperature_C
    inputs = results.study.plan.inputs
    eta, alpha = (np.ravel(inputs[name]) for name in ("viscosity", "pressure_viscosity"))
    stress = float(inputs["eyring_stress"]) * 1e-6
    rows = zip(levels, eta, alpha)
    return [(f"{t:g}", f"{e * 1e3:.3g}", f"{a * 1e9:.3g}", f"{stress:g}") for t, e, a in rows][:MOST_SURFACES]


def input_rows(study: Study, section: str) -> list[tuple[str, str, str, str]]:
    """Keys of a section as used: name, value with unit, 'assumed' for a default, meaning."""
    used, taken = resolved(study)["inputs"][section], set(assumed(study))
    return [
        (
            name.removeprefix(f"{section}."),
            f"{_written(value)} {key.unit}".strip(),
            "assumed" if taken & {name, name.rpartition(".")[0]} else "",
            key.values.get(str(value), key.meaning),
        )
        for name, value, key in _keys(section, used)
    ]


def _keys(place: str, used: Mapping[str, Any]) -> Iterator[tuple[str, Any, Key]]:
    """Dotted name, value and description of each key with a value."""
    for key in table(StudyFile, place).fields:
        if key.name not in used:
            continue
        name, value = f"{place}.{key.name}", used[key.name]
        if isinstance(value, Mapping):
            yield from _keys(name, value)
        else:
            yield name, value, key


def _written(value: object) -> str:
    if isinstance(value, (tuple, list)):
        return " / ".join(_written(v) for v in value)
    return f"{value:.7g}" if isinstance(value, float) else str(value)


def geometry_rows(study: Study) -> list[tuple[str, str]]:
    """Derived quantities of the gear pair: name, and value with unit."""
    pair = study.pair
    rows = [
        ("transverse contact ratio", f"{pair.contact_ratio:.4f}"),
        ("overlap ratio", f"{pair.overlap_ratio:.4f}"),
        ("working transverse pressure angle", f"{np.degrees(pair.working_pressure_angle):.4f} °"),
        ("backlash at the pitch circles", f"{pair.backlash * 1e6:.4g} µm"),
        ("reduced modulus E′", f"{pair.reduced_modulus * 1e-9:.4g} GPa"),
        ("points of the mesh that are computed", str(study.mesh.position.size)),
    ]
    return rows if pair.helix_angle else [row for row in rows if row[0] != "overlap ratio"]


def option_rows(options: Options, unread: Collection[str] = ()) -> list[tuple[str, str, str, bool]]:
    """Option, choice, meaning, whether default; without the options ignored by the friction law."""
    standard = Options()
    rows = []
    for key in FileTable(Options, "", "options").fields:
        name, chosen = key.name, getattr(options, key.name)
        if name not in unread:
            meaning = key.values.get(str(chosen), key.meaning)
            rows.append((name, _chosen(chosen), meaning, chosen == getattr(standard, name)))
    return rows


def _chosen(value: Any) -> str:
    if value is None:
        return "as the load sharing needs"
    if isinstance(value, dict):
        return ", ".join(f"{name} = {number:g}" for name, number in value.items()) or "none"
    return f"{value:g}" if isinstance(value, float) else str(value)


__all__ = ["Drawn", "content", "write_page"]
