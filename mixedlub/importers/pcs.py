"""Text files of PCS Instruments rigs: mini and extreme traction machines, film rigs."""

from __future__ import annotations

import re
from collections.abc import Sequence, Set

import numpy as np

from mixedlub.importers.draft import Answers, Draft, Question, kind_told, questions_of, read_note, refuse_unknown
from mixedlub.importers.likely import likely_spread
from mixedlub.importers.match import COLUMNS, target_for
from mixedlub.importers.sheet import not_above_zero
from mixedlub.importers.spare import spare_notes, spare_questions
from mixedlub.importers.steps import STEP, Step, steps_of, without_gaps
from mixedlub.importers.vocabulary import BY_NAME, convert
from mixedlub.kinds import kind as kind_of
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.units import rounded, split
from profiles.errors import InputError, nearest

SAID = re.compile(r"^Number of steps (completed|in profile):\t(\d+)", re.MULTILINE)
FILM_TYPES = ("FILM",)
PROBES = {"lube": ("lube temp", "lube rtd temp"), "pot": ("pot temp", "pot rtd temp")}
DISAGREE_K = 10.0
CONDITIONS = ("load_N", "entrainment_speed_m_s", "slide_roll_ratio")
TAKEN = {
    "film": (*CONDITIONS, "film_thickness_nm"),
    "friction_history": (*CONDITIONS, "friction_coefficient"),
    "disc": (*CONDITIONS, "friction_coefficient"),
    "friction_map": ("load_N", "friction_coefficient"),
}
"""Columns of each kind that these rigs record, the reading last."""
SWEPT, SLIDING = ("entrainment_speed_m_s", "slide_roll_ratio"), "sliding_speed_m_s"
SWEPT_NOTE = (
    "speeds are swept within the steps, and taken as friction in time; --set 'kind=\"disc\"' takes the film "
    "at each into account, --set 'kind=\"friction_map\"' makes it friction against sliding speed"
)
SWEPT_KIND = Question(
    "kind",
    "Speeds are swept within the steps: kind of recording, friction_history where left open",
    '"disc"',
    needed=False,
    among=("disc", "friction_map", "friction_history"),
)
SURFACES = (
    Question("import.surface_1", "Name of the surface of the ball, as in [surfaces.NAME]", '"ball"'),
    Question("import.surface_2", "Name of the surface of the disc, as in [surfaces.NAME]", '"disc"'),
)


def matches(text: str) -> bool:
    """Whether the text is a file of these rigs: steps with a start and a type."""
    return any(STEP.match(line) for line in text.splitlines()[:200]) and "Step type\t" in text


def without_cut_line(text: str) -> tuple[str, int | None]:
    """The text less a row that breaks off at its end, and the number of that line where there is one.

    >>> without_cut_line("a\\t(b)\\tc\\n1\\t2\\t3\\n4\\t5")
    ('a\\t(b)\\tc\\n1\\t2\\t3\\n', 3)
    >>> without_cut_line("1\\t2\\n\\nAll steps completed")
    ('1\\t2\\n\\nAll steps completed', None)
    """
    before, end, last = text.rpartition("\n")
    row = before.rpartition("\n")[2]
    if not last.strip() or last.count("\t") >= row.count("\t") or not re.match(r"[-+\d.\t]", last):
        return text, None
    return before + end, text.count("\n") + 1


def _lost(text: str, name: str, cut: int | None) -> tuple[Finding, ...]:
    """What the file's own header counts and the file does not hold."""
    said = {which: int(count) for which, count in SAID.findall(text)}
    expected = said.get("completed", said.get("in profile", 0))
    held = sum(bool(STEP.match(line)) for line in text.splitlines())
    notes = []
    if held < expected:
        text = f"holds {held} of the {expected} steps that its header counts; the rest is missing"
        notes.append(finding("file_incomplete", text, name))
    if cut is not None:
        text = f"line {cut} breaks off at the end of the file and is left out"
        notes.append(finding("file_incomplete", text, name))
    return tuple(notes)


def draft(text: str, name: str, answers: Answers) -> Draft:
    """The case that a file makes: a film against speed, or friction against time, conditions or sliding speed."""
    text, cut = without_cut_line(text)
    lost = _lost(text, name, cut)
    held = steps_of(text, name)
    kind, offered = _kind(held, answers)
    quantity = TAKEN[kind][-1]
    sd_key = f"{COLUMNS}{quantity}_sd"
    refuse_unknown(answers, ("import.temperature", sd_key, *(q.key for q in SURFACES if kind == "disc")))
    if answers.get("recording.quantity", quantity) != quantity:
        rule = f"a case of kind {kind!r} from this rig records {quantity}"
        raise InputError(rule, where="recording.quantity", value=answers["recording.quantity"])
    chosen = _chosen(held, kind)
    if not chosen:
        rule = f"no step with {'films' if kind == 'film' else 'films or friction coefficients'}"
        raise InputError("; ".join([rule, *map(str, lost)]), where=name)
    types = " and ".join(dict.fromkeys(s.form for s in chosen))
    notes = [read_note(f"{len(chosen)} of {len(held)} steps with readings taken, of type {types}", name)]
    first = min(s.start for s in chosen)
    chosen, gaps = without_gaps(chosen, [*TAKEN[kind], *_beside(chosen, kind)], name)
    columns = {w: _together(chosen, w, name) for w in TAKEN[kind] if all(s.has(w) for s in chosen)}
    if kind == "film" and all(s.whole("fringe_order") for s in chosen):
        columns["fringe_order"] = _together(chosen, "fringe_order", name)
    if kind == "friction_history":
        columns = {"time_s": np.concatenate([s.since(first, name) for s in chosen]), **columns}
    if kind == "friction_map":
        columns = {"sliding_speed_m_s": _sliding_speed(chosen, name), **columns}
    temperature, questions, said = _temperature(chosen, name, answers)
    spread, offers, spread_said = _spread(chosen, quantity, name, answers)
    columns.update({**temperature, **spread})
    if kind == "disc":
        _refuse_absent({*columns, *(["oil_temperature_C"] if questions else [])}, name)
        columns.update(
            {
                q.key.removeprefix("import."): np.full(len(columns[quantity]), str(answers[q.key]))
                for q in SURFACES
                if q.key in answers
            }
        )
        questions = (*SURFACES, *questions)
    notes += [read_note(SWEPT_NOTE, name)] if offered else []
    described = kind in ("film", "disc") or any(key.startswith("contact.") for key in answers)
    system = {"contact": {"geometry": "point"}} if described else {}
    warned = [finding("rows_left_out", gap, name) for gap in gaps]
    lines = [line for s in chosen for line in s.lines]
    signed = not kind_of(kind).is_unsigned(quantity)
    low = [] if signed else not_above_zero(quantity, columns[quantity].tolist(), lines)
    every = (*lost, *warned, *spread_said, *notes, *said, *(read_note(text, name) for text in low))
    return Draft(kind, quantity, columns, system, (*questions, *offers, *questions_of(kind), *offered), every)


def _kind(held: Sequence[Step], answers: Answers) -> tuple[str, tuple[Question, ...]]:
    """The kind that is told, or that the steps make; where their speeds are swept, other kinds are offered.

    With a contact that is described, friction at swept speeds is that of a ball on a disc.
    """
    told = kind_told(answers, TAKEN)
    if told is not None:
        return told, ()
    if _chosen(held, "film"):
        return "film", ()
    if not any(s.varies(w) for s in _chosen(held, "friction_history") for w in SWEPT):
        return "friction_history", ()
    return ("disc", ()) if "contact.radius_mm" in answers else ("friction_history", (SWEPT_KIND,))


def _chosen(held: Sequence[Step], kind: str) -> tuple[Step, ...]:
    """The steps that a kind is made of; against conditions, those that sweep them."""
    if kind == "film":
        return tuple(s for s in held if s.form in FILM_TYPES and s.has("film_thickness_nm"))
    frictions = tuple(s for s in held if s.has("friction_coefficient"))
    if kind == "friction_history":
        return _most_common(tuple(s for s in frictions if s.has("time_s")))
    return tuple(s for s in frictions if any(s.varies(w) for w in SWEPT)) or _most_common(frictions)


def _beside(chosen: Sequence[Step], kind: str) -> tuple[str, ...]:
    """What a kind reads beside the columns that it takes as they stand."""
    if kind == "friction_map":
        return (SLIDING,) if all(s.has(SLIDING) for s in chosen) else SWEPT
    return ("time_s",) if kind == "friction_history" else ()


def _most_common(found: tuple[Step, ...]) -> tuple[Step, ...]:
    """The steps of the type that holds most readings: what the test was run for."""
    if not found:
        return ()
    forms = [s.form for s in found for _ in s.lines]
    main = max(sorted(set(forms)), key=forms.count)
    return tuple(s for s in found if s.form == main)


def _together(chosen: Sequence[Step], target: str, name: str) -> np.ndarray:
    return np.concatenate([s.read(target, name) for s in chosen])


def _sliding_speed(chosen: Sequence[Step], name: str) -> np.ndarray:
    """As recorded, else the slide-roll ratio times the mean speed."""
    if all(s.has(SLIDING) for s in chosen):
        return _together(chosen, SLIDING, name)
    if not all(s.has(w) for s in chosen for w in SWEPT):
        raise InputError("the steps hold no sliding speed, which a case of kind 'friction_map' needs", where=name)
    mean, ratio = (_together(chosen, w, name) for w in SWEPT)
    return rounded(mean * ratio)


def _spread(
    chosen: Sequence[Step], quantity: str, name: str, answers: Answers
) -> tuple[dict[str, np.ndarray], Sequence[Question], Sequence[Finding]]:
    """The standard deviation of the reading where a header is told, else the question about one that may hold it."""
    column = f"{quantity}_sd"
    target, told = target_for(column), answers.get(COLUMNS + column)
    reading = chosen[0].header(quantity)
    assert target is not None
    assert reading is not None
    held = [h for h in chosen[0].columns if all(h in s.columns for s in chosen)]
    if told is None:
        # Those of single readings are all zero.
        scattered: dict[str, list[str]] = {h: [] for h in held if any(np.any(s.columns[h] > 0.0) for s in chosen)}
        header = likely_spread(quantity, reading, scattered)
        spare = {} if header is None else {column: header}
        notes = [finding("column_not_taken", text, name) for text in spare_notes(spare, COLUMNS)]
        return {}, spare_questions(spare, COLUMNS), notes
    if told not in held:
        raise InputError(f"no such header; {nearest(str(told), held)}", where=COLUMNS + column, value=told)
    unit = split(str(told))[1] or ("-" if target.unit == "ratio" else "?")
    values = convert(np.concatenate([s.columns[told] for s in chosen]), unit, target, f"{name}: {told}")
    return {column: values}, (), [read_note(f"{told!r} taken as {column}", name)]


def _refuse_absent(columns: Set[str], name: str) -> None:
    absent = [w for w in (*CONDITIONS, "oil_temperature_C") if w not in columns]
    if absent:
        raise InputError(f"the steps hold no {', '.join(absent)}, which a case of kind 'disc' needs", where=name)


def _temperature(
    chosen: tuple[Step, ...], name: str, answers: Answers
) -> tuple[dict[str, np.ndarray], tuple[Question, ...], tuple[Finding, ...]]:
    """Oil temperature by the probe in the oil; a question where the two probes tell different stories."""
    probes: dict[str, np.ndarray] = {}
    for probe, words in PROBES.items():
        headers = [[h for h, v in s.columns.items() if split(h)[0] in words and np.isfinite(v).all()] for s in chosen]
        if all(headers):
            probes[probe] = np.concatenate(
                [
                    convert(s.columns[h[0]], split(h[0])[1] or "?", BY_NAME["oil_temperature_C"], f"{name}: {h[0]}")
                    for s, h in zip(chosen, headers, strict=True)
                ]
            )
    if not probes:
        return {}, (), ()
    asked = str(answers.get("import.temperature", ""))
    if asked:
        if asked not in probes:
            raise InputError(f"must be one of {', '.join(probes)}", where="import.temperature", value=asked)
        return {"oil_temperature_C": probes[asked]}, (), (read_note(f"temperature of the {asked} probe taken", name),)
    if len(probes) == 2 and abs(np.median(probes["lube"]) - np.median(probes["pot"])) > DISAGREE_K:
        middle = {p: float(np.median(v)) for p, v in probes.items()}
        text = (
            f"Probe in the oil reads {middle['lube']:.0f} degC, the pot {middle['pot']:.0f} degC: which one is right "
            "(lube or pot)"
        )
        return {}, (Question("import.temperature", text, '"pot"'),), ()
    probe = "lube" if "lube" in probes else "pot"
    return {"oil_temperature_C": probes[probe]}, (), (read_note(f"temperature of the {probe} probe taken", name),)
