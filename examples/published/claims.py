"""Claims of four papers with numbers: paper, formulas, full solutions, and bands over what the papers do not print.

python examples/published/claims.py

writes `claims.md` from `claims.csv`; with `--compute` the numbers first: 450 solutions and two minutes of a processor.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
NUMBERS = HERE / "claims.csv"
ANY = math.inf
MODELS = ("formulas", "full", "formulas, yielding", "full, yielding")
OPEN = ("pressure viscosity", "boundary friction", "cut-off", "relief", "slopes", "viscosity")
COLUMNS = ("paper", "claim", "model", "value", "low", "high", *OPEN)
Numbers = Mapping[tuple[str, str, str], Mapping[str, float]]


@dataclass(frozen=True)
class Claim:
    """A claim: paper, words, value as stated, interval that agrees with it, and unit."""

    paper: str
    words: str
    stated: str
    low: float
    high: float
    unit: str


def _signed(value: float) -> str:
    return "0" if abs(value) < 0.5 else f"{value:+.0f}"


def change(paper: str, words: str, percent: float) -> Claim:
    """A stated change."""
    return Claim(paper, words, f"{_signed(percent)} %", percent, percent, "%")


def level(paper: str, words: str, stated: float, unit: str) -> Claim:
    """A stated level."""
    return Claim(paper, words, f"{stated:g} {unit}".removesuffix(" -"), stated, stated, unit)


A = (
    change("A", "speed 20 to 95 m/s, geometry B, ground", -28.0),
    Claim("A", "speed 20 to 95 m/s, geometry B, superfinished", "falls", -ANY, 0.0, "%"),
    change("A", "ground to superfinished, geometry B", -30.0),
    change("A", "geometry A to B, ground", -2.0),
    change("A", "torque 1900 to 4000 N m, geometry A, ground", -3.0),
    change("A", "oil 80 to 120 °C, geometry A, ground", 1.0),
)
B = (
    level("B", "largest friction, 800 rpm", 0.063, "-"),
    level("B", "largest friction, 6000 rpm", 0.040, "-"),
    change("B", "torque 78 to 141 %", 0.0),
    Claim("B", "pitch point over ends of single contact, 800 rpm", "above 1", 1.0, ANY, "-"),
    level("B", "film, 141 % torque, 6000 rpm", 0.49, "µm"),
)
C = (
    level("C", "friction of fluid A over fluid B", 0.5, "-"),
    Claim("C", "inlet 33 to 73 °C, fluid A", "rises a little", 0.0, ANY, "%"),
    Claim("C", "slide-to-roll ratio 0.6 to 1.2, fluid A", "falls", -ANY, 0.0, "%"),
    Claim("C", "rolling speed 12 to 150 inch/s, fluid A", "falls strongly", -ANY, 0.0, "%"),
)
D = (
    Claim("D", "tooth efficiency of spur gears", "well over 99 %", 99.0, 100.0, "%"),
    Claim("D", "largest difference to measured efficiency", "within 0.1 points", -0.1, 0.1, "points"),
)
CLAIMS = (*A, *B, *C, *D)


def read(path: Path = NUMBERS) -> Numbers:
    """Numbers by paper, claim and model; NaN where a model has none."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    words = ("paper", "claim", "model")
    return {
        (one["paper"], one["claim"], one["model"]): {
            name: float(value) if value else math.nan for name, value in one.items() if name not in words
        }
        for one in rows
    }


def write(rows: Iterator[Mapping[str, Any]], path: Path) -> None:
    """The numbers as a table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({name: f"{v:.5g}" if isinstance(v, float) else v for name, v in row.items()})


def inside(claim: Claim, found: Mapping[str, float]) -> bool:
    """Whether the band reaches the claim."""
    return found["low"] <= claim.high and found["high"] >= claim.low


def _shown(claim: Claim, value: float) -> str:
    if claim.unit == "%":
        return f"{value:.2f} %" if claim.low == 99.0 else f"{_signed(value)} %"
    return f"{value:.3f}" if claim.unit == "-" else f"{value:.2f}"


def _cell(claim: Claim, found: Mapping[str, float]) -> str:
    """Value with its band, in bold where the band reaches the claim."""
    if math.isnan(found["value"]):
        return "-"
    low, high = (_shown(claim, found[end]).removesuffix(" %") for end in ("low", "high"))
    text = f"{_shown(claim, found['value'])} ({low} to {high})"
    return f"**{text}**" if inside(claim, found) else text


def _of(numbers: Numbers, claim: Claim) -> list[Mapping[str, float]]:
    return [numbers[claim.paper, claim.words, model] for model in MODELS]


def bands(numbers: Numbers) -> Iterator[tuple[str, ...]]:
    """Rows of the table of bands."""
    for claim in CLAIMS:
        cells = (_cell(claim, one) for one in _of(numbers, claim))
        yield f"{claim.paper}: {claim.words}", claim.stated, *cells


def moves(numbers: Numbers) -> Iterator[tuple[str, ...]]:
    """Rows of the table of moves of the formulas: by each open number alone, and by each change of physics."""
    for claim in CLAIMS:
        formulas, full, yielding, _ = _of(numbers, claim)
        alone = [formulas[name] for name in OPEN]
        physics = [one["value"] - formulas["value"] for one in (full, yielding)]
        largest = max((abs(x) for x in (*alone, *physics) if not math.isnan(x)), default=0.0)
        yield f"{claim.paper}: {claim.words}", *(_move(claim, x, largest) for x in (*alone, *physics))


def _move(claim: Claim, value: float, largest: float) -> str:
    if math.isnan(value):
        return ""
    small = "0" if abs(value) < 5e-4 else f"{value:+.3f}"
    text = _signed(value) if claim.unit == "%" and claim.low != 99.0 else small
    return f"**{text}**" if abs(value) == largest > 0.0 else text


def page(numbers: Numbers) -> str:
    """The tables in their text."""
    text = (HERE / "claims_text.md").read_text(encoding="utf-8")
    for word, rows in (("BANDS", bands(numbers)), ("MOVES", moves(numbers))):
        text = text.replace(word, "\n".join("| " + " | ".join(row) + " |" for row in rows))
    for number in range(len(MODELS)):
        reached = [c for c in CLAIMS if not math.isnan(_of(numbers, c)[number]["value"])]
        count = sum(inside(c, _of(numbers, c)[number]) for c in reached)
        text = text.replace(f"COUNT{number}", f"{count} of {len(reached)}")
    return text


def drawn(numbers: Numbers, path: str | Path) -> None:
    """Bands of the claims with the stated values: changes in per cent, and levels over the stated level."""
    from mixedlub.report.style import legend_above, panels, save, shades, styled

    changes = [claim for claim in CLAIMS if claim.unit == "%" and claim.low != 99.0]
    levels = [claim for claim in CLAIMS if claim.unit in ("-", "µm")]
    with styled():
        figure, axes, _ = panels(2, 1, height=2.9, sharex=False, sharey=False)
        for axis, claims in zip(axes, (changes, levels), strict=True):
            for row, claim in enumerate(claims):
                stated = [end for end in (claim.low, claim.high) if math.isfinite(end)]
                scale = stated[0] if claims is levels else 1.0
                for number, (found, colour) in enumerate(zip(_of(numbers, claim), shades(len(MODELS)), strict=True)):
                    at = row + 0.16 * (number - 1.5)
                    axis.plot(
                        [found["low"] / scale, found["high"] / scale], [at, at], color=colour, label=MODELS[number]
                    )
                    axis.plot(found["value"] / scale, at, "o", color=colour)
                for end in {x / scale for x in stated}:
                    mark = "|" if claim.low == claim.high else ("<" if claim.high == end else ">")
                    size = 11 if mark == "|" else 6
                    axis.plot(end, row, mark, color="black", markersize=size, label="paper")
            axis.set_yticks(range(len(claims)), [f"{claim.paper}: {claim.words}" for claim in claims])
            axis.invert_yaxis()
            axis.set_xlabel("change (%)" if claims is changes else "level over the stated one, or over 1 (-)")
        handles, labels = axes[0].get_legend_handles_labels()
        once = {label: handle for handle, label in zip(handles, labels, strict=True)}
        legend_above(figure, (list(once.values()), list(once)), "", 5)
    save(figure, Path(path))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--compute", action="store_true", help="compute the numbers first")
    if parser.parse_args().compute:
        from claim_models import computed  # of the same folder

        papers = {paper: [one.words for one in CLAIMS if one.paper == paper] for paper in "ABCD"}
        write(computed(papers), NUMBERS)
    (HERE / "claims.md").write_text(page(read()), encoding="utf-8")
