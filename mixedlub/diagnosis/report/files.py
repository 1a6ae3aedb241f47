"""Diagnose a case and write the answer into a folder."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mixedlub.case.files import LAWS, law_files
from mixedlub.case.folder import HYPOTHESES, Case
from mixedlub.diagnosis.assessment.power_law import DescribedDiscrepancy, describe_discrepancy
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import DISCREPANCY
from mixedlub.diagnosis.report.improved import FILES, FOLDER, improved_files
from mixedlub.diagnosis.report.text import words
from mixedlub.diagnosis.report.text.answer import as_json, predictions
from mixedlub.diagnosis.search.search import Progress
from mixedlub.diagnosis.settings.assessment import FALSE_ALARM_RATE
from mixedlub.running.atomic import fill, writing
from mixedlub.running.origin import FIGURES, Origin, origin_of
from mixedlub.running.parallel import shared_out
from mixedlub.schema.toml_file import to_toml

XML = '<?xml version="1.0" encoding="utf-8" standalone="no"?>\n'
WRITTEN = ("diagnosis.json", "predictions.csv", "report.txt", "report.html")
"""Files of every answer."""
AS_USED = "case/system.toml"
"""File of the answer with the system as used."""


def diagnose(
    case_folder: Path,
    out: Path,
    predict: Path | None = None,
    exclude: Sequence[str] = (),
    level: float = FALSE_ALARM_RATE,
    progress: Progress = lambda text: None,
) -> Diagnosis:
    """Diagnose a case and write the answer into ``out``.

    The files are diagnosis.json, predictions.csv, report.txt, report.html, figures/, the system as used in case/, the
    case of the improved model in improved/, and origin.json, which names the case. They replace an earlier answer once
    all are written. The same case gives the same bytes.
    """
    origin = case_origin(case_folder)
    diagnosis = diagnose_case(case_folder, predict, exclude, level, progress)
    progress("drawing")
    write(files(diagnosis), out, origin)
    return diagnosis


def case_origin(folder: Path) -> Origin:
    """Origin of an answer: the files of its case."""
    laws = sorted(f"{HYPOTHESES}/{path.name}" for path in (folder / HYPOTHESES).glob("*.toml"))
    return origin_of(folder, ("system.toml", "recordings.csv", *laws))


def files(d: Diagnosis) -> dict[str, str | bytes]:
    """Contents of all files of the answer, by file name."""
    extra = described(d)
    return {**texts(d, extra), **drawings(d, extra)}


def texts(d: Diagnosis, extra: DescribedDiscrepancy | None) -> dict[str, str | bytes]:
    """Contents of the text and table files, by file name."""
    return {
        "diagnosis.json": json.dumps({**as_json(d), **_discrepancy_record(extra)}, indent=1, ensure_ascii=False) + "\n",
        "predictions.csv": predictions(d).to_csv(index=False, float_format="%.9g", lineterminator="\n"),
        "report.txt": _text(d, words.sections(d, extra)),
        **_as_used(d.given),
        **improved_files(d),
    }


def _as_used(case: Case) -> dict[str, str | bytes]:
    """The system as used, with the laws of the user."""
    system = case.system.model_dump(by_alias=True, exclude_unset=True)
    laws = law_files(case, system)
    return {AS_USED: to_toml(system), **{f"{AS_USED.rpartition('/')[0]}/{path}": text for path, text in laws.items()}}


def drawings(d: Diagnosis, extra: DescribedDiscrepancy | None) -> dict[str, str | bytes]:
    """Contents of the HTML page and the figures, by file name."""
    from mixedlub.diagnosis.report import html
    from mixedlub.diagnosis.report.figures import figures
    from mixedlub.diagnosis.report.figures.style import as_drawn

    drawn = figures.all_figures(d, extra)
    svgs = dict(zip(drawn, shared_out(as_drawn, list(drawn.values())), strict=True))
    page = html.render(d, words.sections(d, extra), svgs)
    return {"report.html": page, **{f"{FIGURES}/{name}.svg": XML + svg for name, svg in svgs.items()}}


def report_text(d: Diagnosis) -> str:
    """The report as plain text."""
    return _text(d, words.sections(d, described(d)))


def _text(d: Diagnosis, parts: Sequence[words.Section]) -> str:
    return words.as_text(f"Diagnosis of {d.case.name}", parts)


def described(d: Diagnosis) -> DescribedDiscrepancy | None:
    """Detailed model discrepancy if it is among the tied explanations, else None."""
    return describe_discrepancy(d.search) if DISCREPANCY in d.posterior.tied else None


def _discrepancy_record(extra: DescribedDiscrepancy | None) -> dict[str, Any]:
    """The discrepancy as an entry of diagnosis.json."""
    if extra is None:
        return {}
    law = extra.law
    return {
        "unknown": {
            "stages": [
                {"stage": s.stage, "quantity": s.quantity, "log_evidence_over_none": s.evidence} for s in extra.stages
            ],
            "empirical_form": None
            if law is None
            else {
                "text": law.text,
                "relative": law.relative,
                "coefficient": law.coefficient,
                "coefficient_sd": law.sd,
                "exponents": {name: float(b) for name, b in law.factors},
                "heldout_before": law.heldout_before,
                "heldout_after": law.heldout_after,
            },
        }
    }


def write(contents: Mapping[str, str | bytes], out: Path, origin: Origin | None = None) -> None:
    """Write all files of an answer, and the record of its origin if given, in place of an earlier answer."""
    out.mkdir(parents=True, exist_ok=True)
    with writing(out) as aside:
        fill(contents, aside)
        if origin is not None:
            origin.write_record(aside, out)
    drop_earlier(contents, out / FOLDER)


def drop_earlier(contents: Mapping[str, str | bytes], folder: Path) -> None:
    """Remove files of the improved model that only an earlier answer wrote."""
    laws = (path.relative_to(folder).as_posix() for path in (folder / LAWS).glob("*.toml"))
    for name in (*FILES, *laws):
        if f"{folder.name}/{name}" not in contents:
            (folder / name).unlink(missing_ok=True)
    for place in (folder / LAWS, folder):
        if place.is_dir() and not any(place.iterdir()):
            place.rmdir()
