"""Drafts of a case, their open questions, and checks of the answers."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.kinds import KINDS
from mixedlub.kinds import kind as kind_of
from mixedlub.running.shell import quoted
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.section import examples, table, tables
from mixedlub.schema.system_file import System
from mixedlub.schema.toml_file import toml_value
from profiles.errors import InputError, nearest

Answers = Mapping[str, Any]
"""Answers by dotted key: keys of system.toml, and keys with prefix ``import.`` for the importer."""


SHEET = "import.sheet"
"""Sheet of a workbook, or group of a binary file, to read."""
HIDDEN_ROWS = "import.hidden_rows"
"""Choice to "take" or "leave" hidden rows of a workbook."""
PART = re.compile(r'"[^"]*"|[^.]+')
"""Part of a dotted key; a name with a point is quoted."""


@dataclass(frozen=True)
class Question:
    """Fact missing in the files: key, text of the question, example in TOML.

    ``options``: possible answers, introduced by ``options_intro``. ``placeholder``: replaces an unlikely example in
    lines to copy. ``offered``: an empty reply takes the example. ``meaning``: explanation on request. ``one_value``:
    key of the answer for all rows at once.
    """

    key: str
    text: str
    example: str
    needed: bool = True
    options: tuple[str, ...] = ()
    options_intro: str = "one of"
    placeholder: str = ""
    offered: bool = False
    meaning: str = ""
    one_value: str = ""

    @property
    def choices(self) -> str:
        """Possible answers, in words."""
        return f"{self.options_intro} {', '.join(self.options)}" if self.options else ""


class Unanswered(InputError):
    """Error on missing answers: one question per line, with the setting for its answer."""

    def __init__(self, questions: Sequence[Question]) -> None:
        self.lines = tuple(listed(questions))
        count = "1 answer is" if len(questions) == 1 else f"{len(questions)} answers are"
        self.summary = f"{count} missing; give each by --set KEY=VALUE, or all in a TOML file by --answers"
        super().__init__(self.summary + ":\n" + "\n".join(self.lines), where="import")


def listed(questions: Sequence[Question]) -> Iterator[str]:
    """Lines with a question and the setting for its answer; equal choices are listed once.

    >>> print(*listed([Question("kind", "Kind of recording", '"film"', options=("film", "disc"))]), sep="\\n")
      --set 'kind="film"'  (Kind of recording: one of film, disc)
    """
    listed_choices: set[str] = set()
    for q in questions:
        words = q.text if not q.choices or q.choices in listed_choices else f"{q.text}: {q.choices}"
        listed_choices.add(q.choices)
        words += f", for example {q.example}" if q.placeholder and not q.choices else ""
        words += f"; or {q.one_value}=... if all rows have the same" if q.one_value and not q.offered else ""
        yield f"  --set {quoted(f'{q.key}={q.placeholder or q.example}')}  ({words})"


@dataclass(frozen=True)
class Draft:
    """Case before it is written: columns in case units, facts for system.toml, open questions."""

    kind: str | None
    quantity: str | None
    columns: Mapping[str, np.ndarray]
    system: Mapping[str, Any] = field(default_factory=dict)
    questions: tuple[Question, ...] = ()
    notes: tuple[Finding, ...] = ()
    runs: np.ndarray | None = None
    """Run numbers, if the file has them without repetition."""


def _question(section: str, key: str, needed: bool) -> Question:
    described = table(System, section)[key]
    values = ", ".join(f"{value}: {meaning}" for value, meaning in described.values.items())
    words = f"{described.words} ({values})" if values else described.words
    return Question(f"{section}.{key}", words[:1].upper() + words[1:], toml_value(described.example), needed)


CONTACT = (
    replace(_question("contact", "radius_mm", True), placeholder="[RADIUS, RADIUS]"),
    replace(_question("contact", "youngs_modulus_GPa", True), placeholder="[MODULUS, MODULUS]"),
    replace(_question("contact", "poisson_ratio", True), placeholder="[RATIO, RATIO]"),
)
FORMS = tuple(table(System, "contact")["geometry"].values)
FORM = replace(_question("contact", "geometry", True), options=FORMS, placeholder=f'"{" OR ".join(FORMS).upper()}"')
WIDTH = replace(_question("contact", "width_mm", True), placeholder="WIDTH")
OIL = tuple(
    _question("lubricant", key, False)
    for key in ("name", "temperature_C", "kinematic_viscosity_mm2_s", "pressure_viscosity_per_GPa")
)
EVERY = Question("import.every", "Keep one reading of how many", "10", needed=False)
NOISE = tuple(_question("recording.noise", key, False) for key in ("relative", "absolute"))


def questions_of(kind: str) -> tuple[Question, ...]:
    """Questions open in every case of a kind."""
    contact = CONTACT if "contact" in kind_of(kind).sections else ()
    oil = OIL if kind_of(kind).asks_for_oil else ()
    many = (EVERY,) if kind_of(kind).is_logged else ()
    return (*contact, *oil, *many, *NOISE)


def contact_form(kind: str, answers: Answers) -> tuple[Question, ...]:
    """Questions on form and width of the contact, if the kind has a contact and the answers lack them."""
    given = "contact.width_mm" in answers or answers.get("contact.geometry") == "point"
    if given or "contact" not in kind_of(kind).sections:
        return ()
    return (WIDTH,) if "contact.geometry" in answers else (FORM, WIDTH)


def read_note(text: str, name: str = "") -> Finding:
    """Note on the reading of a file."""
    return finding("file_read", text, name)


def open_questions(draft: Draft, answers: Answers) -> tuple[Question, ...]:
    """Required questions without an answer."""
    return tuple(q for q in draft.questions if q.needed and q.key not in answers)


def refuse_unknown(answers: Answers, known: Sequence[str]) -> None:
    """Raise an error for the first ``import.`` key without meaning for the file.

    >>> refuse_unknown({"import.evry": 10, "kind": "film"}, [])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: import.evry: key is not known for this file; nearest known: 'import.every'
    """
    keys = (EVERY.key, SHEET, HIDDEN_ROWS, *known)
    for key in answers:
        if PART.findall(key)[:1] == ["import"] and key not in keys:
            raise InputError(f"key is not known for this file; {nearest(key, keys)}", where=key)


def answered_kind(answers: Answers, possible: Collection[str]) -> str | None:
    """Kind named in the answers; raise an error if the file's reader does not support it.

    >>> answered_kind({"kind": "disc"}, ["viscosity"])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: kind: 'disc': is no kind that files of this rig make; they make viscosity
    """
    kind = answers.get("kind")
    if kind is None or kind in possible:
        return kind
    exists = kind in KINDS
    rule = f"is no kind that files of this rig make; they make {', '.join(possible)}"
    raise InputError(rule if exists else f"no such kind; {nearest(str(kind), KINDS)}", where="kind", value=kind)


def nested(answers: Answers) -> dict[str, Any]:
    """Dotted keys as tables, without the keys of the importer.

    >>> nested({"contact.radius_mm": [9.5, 20.0], "import.temperature": "pot", "kind": "film"})
    {'contact': {'radius_mm': [9.5, 20.0]}, 'kind': 'film'}
    >>> nested({'surfaces."Ra 0.4".m2': 0.003})
    {'surfaces': {'Ra 0.4': {'m2': 0.003}}}
    """
    tree: dict[str, Any] = {}
    for key, value in answers.items():
        *above, last = (part.strip('"') for part in PART.findall(key))
        if above[:1] == ["import"]:
            continue
        branch = tree
        for part in above:
            branch = branch.setdefault(part, {})
        branch[last] = value
    return tree


def flat(tree: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Tables as dotted keys; keys of the first level may be dotted already.

    >>> flat({"contact": {"radius_mm": [9.5, 20.0]}, "kind": "film"})
    {'contact.radius_mm': [9.5, 20.0], 'kind': 'film'}
    """
    dotted: dict[str, Any] = {}
    for key, value in tree.items():
        part = f'"{key}"' if above and "." in key else key
        name = f"{above}.{part}" if above else part
        dotted.update(flat(value, name) if isinstance(value, Mapping) and value else {name: value})
    return dotted


BARE = re.compile(r"[-+.\deinf]+(\s*,\s*[-+.\deinf]+)+")
"""Comma-separated numbers, as in a list typed without brackets."""


def is_list(example: str, reply: str) -> bool:
    """Whether a reply is a list without brackets and a list is expected.

    >>> is_list("[206.0, 206.0]", "206, 75"), is_list("[206.0, 206.0]", "[206, 75]"), is_list("0.1", "0,2")
    (True, False, False)
    """
    return example.startswith("[") and BARE.fullmatch(reply.strip()) is not None


def refuse_wrong(key: str, value: Any) -> None:
    """Raise an error for an answer invalid in system.toml regardless of the other answers.

    >>> refuse_wrong("contact.radius_mm", [9.5])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: contact.radius_mm: [9.5]: needs 2 entries, not 1
    """
    if key == EVERY.key and (not isinstance(value, int) or isinstance(value, bool) or value < 1):
        raise InputError("must be a whole number of at least 1", where=key, value=value)
    section, _, last = key.rpartition(".")
    described = next((t for t in tables(system_file.System) if section and t.name == section), None)
    if described is None or last not in described.model.model_fields:
        return
    try:
        toml_file.parse(described.model, {**examples(described.model), last: value}, section)
    except InputError as error:
        raise InputError(error.rule, where=key, value=value) from None
